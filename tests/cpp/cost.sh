#!/bin/sh
# cost.sh: what a step costs through the C++ header beside the same step in C: the difference of two runs by callgrind,
# so that all around the steps drops out. Usage: cost.sh PROGRAM BUILD-TYPE
set -eu
command -v valgrind >/dev/null || { echo "SKIP: cpp_cost: valgrind is not installed"; exit 77; }
[ "$2" = Release ] || { echo "SKIP: cpp_cost: cost is that of an optimised build, this one is of type '$2'"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# instructions KIND STEPS
instructions() {
    valgrind --tool=callgrind --callgrind-out-file="$folder/out" "$1" "$2" "$3" >"$folder/log" 2>&1 ||
        { cat "$folder/log" >&2; exit 1; }
    awk '/Collected :/ {print $4}' "$folder/log"
}
for kind in c cpp; do
    few=$(instructions "$1" $kind 10000)
    many=$(instructions "$1" $kind 110000)
    eval "$kind=$(((many - few) / 1000))"
done
echo "cpp_cost: 100 steps asleep take $c instructions in C, $cpp in C++"
# A branch on the sign of the status, which C makes too; one instruction a step is all there is room for.
[ "$c" -gt 0 ] && [ "$cpp" -le $((c + 100)) ] || { echo "more than one instruction a step above C"; exit 1; }
