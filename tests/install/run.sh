#!/bin/sh
# run.sh: installs into an empty folder, moves it elsewhere, and uses it there as a stranger would: the README's quick
# start, in C and in C++, and every backend, by hand with pkg-config (shared and static), in a CMake project with
# find_package(tahr) (with and without C++), and as plugins. BUILD is the build.
set -eu
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cmake --install "$BUILD" --prefix "$folder/first" >/dev/null
mv "$folder/first" "$folder/prefix"
prefix=$folder/prefix
for header in include/tahr/*.h bindings/cpp/*.hpp; do
    cmp "$header" "$prefix/include/tahr/${header##*/}" || { echo "install: $header is missing or differs"; exit 1; }
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
# Only the archives are left in this one, so that -ltahr is libtahr.a.
archives=$folder/archives
mkdir -p "$archives/$LIBDIR"
cp -r "$prefix/include" "$archives/include"
cp -r "$prefix/$LIBDIR/pkgconfig" "$prefix/$LIBDIR"/*.a "$archives/$LIBDIR"
pc_static() {
    PKG_CONFIG_PATH=$archives/$LIBDIR/pkgconfig pkg-config --static --cflags --libs "$@"
}
# shellcheck disable=SC2046,SC2086
${CC:-cc} -std=c11 "$folder/program.c" $(pc_static tahr) -o "$folder/static"
"$folder/static" | $checker

# Which backends were built, and what a program that has all of them prints: the way to the cube is half of the ray.
backends=
expected="native 0.500"
for backend in ccd fcl box2d trace template; do
    [ -e "$prefix/$LIBDIR/libtahr_$backend.a" ] || continue
    backends="$backends $backend"
    case $backend in
    trace) answer=trace ;;
    *) answer="$backend 0.500" ;;
    esac
    expected="$expected
$answer"
done
# runs WHAT COMMAND...: the program asks every backend that it was linked with.
runs() {
    what=$1
    shift
    out=$("$@") && [ "$out" = "$expected" ] || { printf 'install: %s prints\n%s\n' "$what" "$out"; exit 1; }
    echo "install: $what runs with native$backends"
}
packages=tahr
defines=
for backend in $backends; do
    packages="tahr_$backend $packages"
    defines="$defines -DHAVE_$(echo "$backend" | tr a-z A-Z)"
done
# shellcheck disable=SC2046,SC2086
${CC:-cc} -std=c11 $defines tests/install/project/backends.c $(pc_static $packages) -o "$folder/all_static"
runs "the program by pkg-config --static" "$folder/all_static"
plugins=
for plugin in "$prefix/$LIBDIR"/libtahr_*.so; do
    [ ! -e "$plugin" ] || plugins="$plugins $plugin"
done
if [ -e "$prefix/$LIBDIR/libtahr.so" ]; then
    # shellcheck disable=SC2046,SC2086
    ${CC:-cc} -std=c11 $defines tests/install/project/backends.c $(pkg-config --cflags --libs $packages) \
        -o "$folder/all_shared"
    runs "the program by pkg-config" env LD_LIBRARY_PATH="$prefix/$LIBDIR" "$folder/all_shared"
    # shellcheck disable=SC2046,SC2086
    ${CC:-cc} -std=c11 tests/install/project/backends.c $(pc_static tahr) -o "$folder/loader"
    # shellcheck disable=SC2086
    loaded=$("$folder/loader" $plugins | sort -u)
    [ "$loaded" = "$(printf '%s\n' "$expected" | sort -u)" ] ||
        { printf 'install: the plugins print\n%s\n' "$loaded"; exit 1; }
    echo "install: every plugin loads by its path"
fi

# The C++ headers, which come with the library, and the quick start of their README.
with_cxx=
if command -v "${CXX:-c++}" >/dev/null 2>&1; then
    with_cxx=ON
    awk -v code=cpp -f tests/support/quick_start.awk bindings/cpp/README.md >"$folder/program.cpp"
    # shellcheck disable=SC2046
    "${CXX:-c++}" -std=c++17 "$folder/program.cpp" $(pc_static tahr) -o "$folder/cpp_static"
    cpp_checker="env README=bindings/cpp/README.md CODE=cpp sh tests/support/quick_start_check.sh"
    "$folder/cpp_static" | $cpp_checker
fi

# The pool of threads and telemetry, by pkg-config, with the examples that a new user would begin with.
if [ -e "$prefix/$LIBDIR/libtahr_threads.a" ]; then
    # shellcheck disable=SC2046
    ${CC:-cc} -std=c11 -DTAHR_HAVE_THREADS tests/examples/crowd.c $(pc_static tahr_threads) -o "$folder/crowd"
    meet=$("$folder/crowd")
    echo "install: a crowd runs on threads: $meet"
    # shellcheck disable=SC2046
    ${CC:-cc} -std=c11 tests/examples/telemetry.c $(pc_static tahr_threads) -o "$folder/telemetry"
    told=$("$folder/telemetry")
    echo "install: telemetry tells: $(printf '%s\n' "$told" | tail -n 1)"
fi

# The sink on LCM: the same, with the example that listens to itself; the types of the messages for C and for Python.
if [ -e "$prefix/$LIBDIR/libtahr_lcm.a" ]; then
    # shellcheck disable=SC2046
    ${CC:-cc} -std=c11 tests/examples/telemetry_lcm.c $(pc_static tahr_lcm) -o "$folder/telemetry"
    heard=$("$folder/telemetry")
    echo "install: telemetry is heard over LCM: $(printf '%s\n' "$heard" | tail -n 1)"
    for type in backends/lcm/types/*.lcm; do
        name=$(basename "$type" .lcm)
        cmp "$type" "$prefix/share/tahr/lcm/$name.lcm" && [ -e "$prefix/include/tahr_lcm/tahr_$name.h" ] &&
            [ -e "$prefix/share/tahr/lcm/python/tahr/$name.py" ] ||
            { echo "install: the type $name is not there for everybody"; exit 1; }
    done
fi

# find_package: every exported target, in a project without C++ and in one with it; the backends beside the library, all
# static, all shared, and mixed, whose shared code must not clash.
cp -r tests/install/project "$folder/project"
cp "$folder/program.c" "$folder/project/program.c"
cp tests/examples/crowd.c tests/examples/telemetry.c tests/examples/telemetry_lcm.c "$folder/project"
[ ! "$with_cxx" ] || cp "$folder/program.cpp" "$folder/project/program.cpp"
for cxx in OFF $with_cxx; do
    made=$folder/project/build_$cxx
    cmake -S "$folder/project" -B "$made" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="${CC:-cc}" \
        -DWITH_CXX=$cxx >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
    cmake --build "$made" --parallel 2 >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
    for kind in shared static mixed; do
        runs "backends_$kind (C++ $cxx)" "$made/backends_$kind"
    done
    for kind in tahr tahr_static; do
        "$made/program_$kind" | $checker
        [ $cxx = OFF ] || "$made/program_cpp_$kind" | $cpp_checker
    done
    if [ -e "$prefix/$LIBDIR/libtahr_threads.a" ]; then
        [ "$("$made/crowd")" = "$meet" ] || { echo "install: the crowd by find_package goes elsewhere"; exit 1; }
        for kind in tahr tahr_static; do
            [ "$("$made/telemetry_$kind")" = "$told" ] ||
                { echo "install: the telemetry by find_package, on $kind, tells something else"; exit 1; }
        done
    fi
    if [ -e "$prefix/$LIBDIR/libtahr_lcm.a" ]; then
        [ "$("$made/telemetry")" = "$heard" ] || { echo "install: other telemetry by find_package"; exit 1; }
    fi
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
