#!/bin/sh
# headers.sh: every C++ header compiles alone; all of them twice included compile without a warning by gcc and clang, as
# C++17 and C++20, with exceptions and RTTI and without; none leaves a symbol behind; and two files that use them link.
# Usage: headers.sh FOLDER, that of <tahr/tahr.hpp>
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
include="-I$1 -Iinclude"
warnings="-pedantic-errors -Wall -Wextra -Wconversion -Wshadow -Wsign-conversion -Wold-style-cast -Werror"
: "${CXX:=c++}"
other=clang++
if "$CXX" --version | grep -q clang; then other=g++; fi
command -v $other >/dev/null 2>&1 || other=

# compiles COMPILER OPTIONS HEADER...: twice each, and no symbol of it is left; local ones are the standard library's.
compiles() {
    compiler=$1 options=$2
    shift 2
    for header in "$@" "$@"; do echo "#include <tahr/${header##*/}>"; done >"$folder/only.cpp"
    # shellcheck disable=SC2086
    "$compiler" $options $warnings $include -c "$folder/only.cpp" -o "$folder/only.o"
    symbols=$(nm "$folder/only.o" | grep -E ' [A-Z] |tahr' || true)
    [ -z "$symbols" ] || { printf '%s leaves symbols behind:\n%s\n' "$*" "$symbols"; exit 1; }
}
for header in bindings/cpp/*.hpp; do
    compiles "$CXX" -std=c++17 "$header"
done
for compiler in "$CXX" $other; do
    for language in c++17 c++20; do
        for kind in "" "-fno-exceptions -fno-rtti" "-DTAHR_CPP_NO_EXCEPTIONS"; do
            compiles "$compiler" "-std=$language $kind" bindings/cpp/*.hpp
        done
    done
done

# Both files use everything; one of them may be without exceptions.
flags=
if nm "$BUILD/lib/libtahr.a" | grep -q '__asan_'; then flags=-fsanitize=address,undefined; fi
# shellcheck disable=SC2086
"$CXX" -std=c++17 $warnings $flags $include -DONE -c tests/cpp/two_files.cpp -o "$folder/one.o"
for kind in "" -fno-exceptions; do
    # shellcheck disable=SC2086
    "$CXX" -std=c++17 $kind $warnings $flags $include -DTWO -c tests/cpp/two_files.cpp -o "$folder/two.o"
    # shellcheck disable=SC2086
    "$CXX" $flags "$folder/one.o" "$folder/two.o" "$BUILD/lib/libtahr.a" -lm -ldl -o "$folder/program"
    "$folder/program"
done
echo "headers: no warning, no symbol, and two files link"
