#!/bin/sh
# subproject.sh: the sources inside somebody else's CMake build (add_subdirectory, FetchContent): the library and
# nothing more, with the stranger's own output folders and compiler flags left alone.
set -eu
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp tests/install/version.c "$folder/program.c"
cat >"$folder/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.21)
project(stranger LANGUAGES C)
add_subdirectory("$root" tahr EXCLUDE_FROM_ALL)
add_executable(program program.c)
target_link_libraries(program PRIVATE tahr::tahr_static)
END
# Unoptimised: this is about the build, not about the code.
cmake -S "$folder" -B "$folder/build" -DCMAKE_C_COMPILER="${CC:-cc}" -DCMAKE_C_FLAGS=-O0 >"$folder/log" 2>&1 &&
    cmake --build "$folder/build" >>"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
"$folder/build/program"
for unwanted in bin/tahr tests; do
    [ ! -e "$folder/build/tahr/$unwanted" ] || { echo "subproject: $unwanted was built too"; exit 1; }
done
