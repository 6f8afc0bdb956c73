#!/bin/sh
# quick_start.sh: the C++ blocks of bindings/cpp/README.md: each is a program, compiled as it stands, and run; the first
# is the quick start, whose output the README shows. Usage: quick_start.sh FOLDER, that of <tahr/tahr.hpp>
set -eu
readme=bindings/cpp/README.md
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags=
if nm "$BUILD/lib/libtahr.a" | grep -q '__asan_'; then flags=-fsanitize=address,undefined; fi
block=1
while :; do
    awk -v code=cpp -v block=$block -f tests/support/quick_start.awk $readme >"$folder/block_$block.cpp"
    [ -s "$folder/block_$block.cpp" ] || break
    # shellcheck disable=SC2086
    "${CXX:-c++}" -std=c++17 -Wall -Wextra -Wpedantic -Werror $flags -I"$1" -Iinclude "$folder/block_$block.cpp" \
        "$BUILD/lib/libtahr.a" -lm -ldl -o "$folder/program"
    "$folder/program" >"$folder/out"
    if [ $block = 1 ]; then README=$readme CODE=cpp sh tests/support/quick_start_check.sh <"$folder/out"; fi
    cat "$folder/out"
    block=$((block + 1))
done
[ $block -gt 1 ] || { echo "quick start: $readme has no C++ block"; exit 1; }
