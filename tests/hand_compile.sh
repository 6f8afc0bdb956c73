#!/bin/sh
# hand_compile.sh: the core compiles by hand, without this build. Usage: hand_compile.sh COMPILER
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
compile "$root"/src/*.c
# The build itself looks at the rest with its own compiler, gcc as a rule; clang sees other things.
[ "$compiler" != clang ] || compile -ffp-contract=off "$root"/backends/common/*.c "$root"/backends/native/*.c
echo "hand_compile: $(ls -- *.o | wc -l) objects with $compiler, no warning"
