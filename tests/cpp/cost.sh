#!/bin/sh
# cost.sh: what a step costs through the C++ headers beside the same step in C: the difference of two runs by callgrind,
# so that all around the steps drops out. Usage: cost.sh PROGRAM BUILD-TYPE
set -eu
command -v valgrind >/dev/null || { echo "SKIP: cpp_cost: valgrind is not installed"; exit 77; }
[ "$2" = Release ] || { echo "SKIP: cpp_cost: cost is that of an optimised build, this one is of type '$2'"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# instructions LANGUAGE KIND STEPS
instructions() {
    valgrind --tool=callgrind --callgrind-out-file="$folder/out" "$1" "$2" "$3" "$4" >"$folder/log" 2>&1 ||
        { cat "$folder/log" >&2; exit 1; }
    awk '/Collected :/ {print $4}' "$folder/log"
}
status=0
for kind in asleep walk; do
    for language in c cpp; do
        few=$(instructions "$1" $language $kind 1000)
        many=$(instructions "$1" $language $kind 11000)
        eval "$language=$(((many - few) / 100))"
    done
    echo "cpp_cost: 100 steps ($kind) take $c instructions in C, $cpp in C++"
    # The handle is read from the mover in every step: one instruction by gcc, two by clang; and one to spare.
    [ "$c" -gt 0 ] && [ "$cpp" -le $((c + 300)) ] ||
        { echo "that is more than three instructions a step above C"; status=1; }
done
exit $status
