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
levels="-O0 -O2"
[ "$compiler" != musl-gcc ] || levels=-O0 # gcc with another libc: it sees nothing more
for optimise in $levels; do
    compile "$optimise" "$root"/src/*.c
    # The build itself looks at the rest with its own compiler, gcc as a rule; clang sees other things.
    [ "$compiler" != clang ] ||
        compile "$optimise" -ffp-contract=off "$root"/backends/common/*.c "$root"/backends/native/*.c
done
echo "hand_compile: $(ls -- *.o | wc -l) objects with $compiler, no warning"
