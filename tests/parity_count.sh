#!/bin/sh
# parity_count.sh: every row of the table of numbers that the unreal preset must give is tested, and green, in one of
# test_unit_parity_*. BUILD: the build folder. Prints the rows by group.
set -eu

# The groups of the table, and how many rows each has.
groups='IsWalkable W 8
IsWithinEdgeTolerance E 5
TwoWallAdjust,_base T 6
TwoWallAdjust,_character U 6
SlideAlongSurface,_base S 5
SlideAlongSurface,_character C 4
GetValidPerchRadius P 5
ShouldComputePerchResult H 5
ComputePerchResult K 4
FloorSweepTest G 4
ComputeFloorDist D 9
FindFloor F 5
AdjustFloorHeight A 7
PullBack B 2
MoveUpdatedComponent M 6
GetPenetrationAdjustment R 4
ResolvePenetration Z 4
SafeMoveUpdatedComponent V 3
scopes_and_events X 4
ComputeGroundMovementDelta Q 5
loops L 5'

green=
red=
for test in "$BUILD"/tests/test_unit_parity_*; do
    if ! out=$("$test" 2>&1); then
        printf '%s\n' "$out"
        red="$red ${test##*/}"
    fi
    green="$green $(printf '%s\n' "$out" | sed -n 's/^parity ([^)]*)://p' | tr '\n' ' ')"
done

# A row is tested where any table has it; it is green if every table that has it is, for which a red table fails above.
rows=$(printf '%s\n' $green | grep -E '^[A-Z][0-9]+$' | sort -u)
have=0
wanted=0
missing=
shown=
while read -r name letter count; do
    found=0
    for number in $(seq "$count"); do
        if printf '%s\n' "$rows" | grep -qx "$letter$number"; then
            found=$((found + 1))
        else
            missing="$missing $letter$number"
        fi
    done
    have=$((have + found))
    wanted=$((wanted + count))
    shown="$shown, $(echo "$name" | tr _ ' ') $found"
done <<EOF
$groups
EOF
[ "$wanted" -eq 106 ] || { echo "parity: $wanted rows are wanted here; the table has 106"; exit 1; }
echo "parity: $have of $wanted rows green (${shown#, })"
if [ -n "$missing" ]; then
    echo "parity: not green:$missing"
fi
if [ -n "$red" ]; then
    echo "parity: failed:$red"
fi
[ -z "$missing$red" ]
