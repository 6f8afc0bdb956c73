#!/bin/sh
# run.sh: installs into an empty folder, moves it elsewhere, and uses it there as a stranger would: the README's quick
# start by hand with pkg-config (shared and static), and a CMake project with find_package(tahr). BUILD is the build.
set -eu
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cmake --install "$BUILD" --prefix "$folder/first" >/dev/null
mv "$folder/first" "$folder/prefix"
prefix=$folder/prefix
for header in include/tahr/*.h; do
    cmp "$header" "$prefix/$header" || { echo "install: $header is missing or differs"; exit 1; }
done
if grep -rlF "$root" "$prefix/lib"*/pkgconfig "$prefix"/lib*/*/pkgconfig "$prefix"/lib*/cmake 2>/dev/null; then
    echo "install: these files name the folder of the sources"
    exit 1
fi
PKG_CONFIG_PATH=$prefix/$LIBDIR/pkgconfig
export PKG_CONFIG_PATH
pkg-config --exists --print-errors tahr
[ "$(pkg-config --modversion tahr)" = "$(sed -nE 's/^project\(tahr VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)" ] ||
    { echo "install: tahr.pc has another version than CMakeLists.txt"; exit 1; }

# The README's program if there is one; otherwise the smallest that calls into the library.
if grep -q '^```c$' README.md 2>/dev/null; then
    awk -f tests/support/quick_start.awk README.md >"$folder/program.c"
    checker="sh tests/support/quick_start_check.sh"
else
    cp tests/install/version.c "$folder/program.c"
    checker="grep -x $(pkg-config --modversion tahr)"
fi

# shellcheck disable=SC2046,SC2086
if [ -e "$prefix/$LIBDIR/libtahr.so" ]; then
    ${CC:-cc} -std=c11 "$folder/program.c" $(pkg-config --cflags --libs tahr) -o "$folder/shared"
    LD_LIBRARY_PATH=$prefix/$LIBDIR "$folder/shared" | $checker
fi
# shellcheck disable=SC2046,SC2086
${CC:-cc} -std=c11 "$folder/program.c" $(pkg-config --cflags tahr) "$prefix/$LIBDIR/libtahr.a" -lm \
    -o "$folder/static"
"$folder/static" | $checker

# find_package: every exported target, in a project without C++; the second backend beside the library, both static and
# both shared, whose shared code must not clash.
cp -r tests/install/project "$folder/project"
cp "$folder/program.c" "$folder/project/program.c"
cmake -S "$folder/project" -B "$folder/project/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="${CC:-cc}" \
    >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
cmake --build "$folder/project/build" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
for program in "$folder"/project/build/program_*; do
    [ -x "$program" ] && [ -f "$program" ] || continue
    "$program" | $checker
    echo "install: ${program##*/} runs"
done
for program in "$folder"/project/build/backends_*; do
    [ -x "$program" ] && [ -f "$program" ] || continue
    [ "$("$program")" = "native ccd" ] || { echo "install: ${program##*/} does not name both backends"; exit 1; }
    echo "install: ${program##*/} runs"
done

# Versions: an equal minor number fits, another does not.
mkdir "$folder/other"
printf '%s\n' 'cmake_minimum_required(VERSION 3.21)' 'project(other LANGUAGES C)' 'find_package(tahr 0.2 CONFIG QUIET)' \
    'if(tahr_FOUND)' 'message(FATAL_ERROR "tahr 0.1 was taken for 0.2")' 'endif()' >"$folder/other/CMakeLists.txt"
cmake -S "$folder/other" -B "$folder/other/build" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/log" 2>&1 ||
    { cat "$folder/log"; exit 1; }

if [ -x "$prefix/bin/tahr" ]; then
    "$prefix/bin/tahr" info >/dev/null || { echo "install: bin/tahr info fails"; exit 1; }
fi
echo "install: done"
