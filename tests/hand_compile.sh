#!/bin/sh
# hand_compile.sh: the core compiles by hand, without this build, and without a warning: also optimised, when compilers see
# more (what may be read uninitialised, for one). Usage: hand_compile.sh COMPILER
set -eu
compiler=$1
if ! command -v "$compiler" >/dev/null 2>&1; then
    echo "SKIP: house_hand_compile_$compiler: $compiler is not installed"
    exit 77
fi
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
compile() {
    "$compiler" -std=c11 -I"$root/include" -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -c "$@"
}
case $compiler in
# Optimised where nobody else looks: the build itself is gcc's as a rule, and musl-gcc is gcc with another libc.
clang) levels=-O2 ;;
*) levels=-O0 ;;
esac
if [ "$compiler" = gcc ] && ! "${CC:-gcc}" --version 2>/dev/null | grep -q 'Free Software Foundation'; then
    levels="-O0 -O2"
fi
for optimise in $levels; do
    compile "$optimise" "$root"/src/*.c
    # The build itself looks at the rest with its own compiler; clang sees other things.
    [ "$compiler" != clang ] ||
        compile "$optimise" -ffp-contract=off "$root"/backends/common/*.c "$root"/backends/native/*.c
done
echo "hand_compile: $(ls -- *.o | wc -l) objects with $compiler, no warning"
