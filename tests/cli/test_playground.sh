#!/bin/sh
# SPDX-License-Identifier: MIT
# test_playground.sh: every route of the playground uses what it is named after: modes, events and places in the table
# of its steps. What the numbers come from is the level's geometry (bindings/cli/rides.c).
. "$(dirname "$0")/support.sh"
routes="$here/../scenes/routes"

# go ROUTE: its steps are in $work/csv.
go() {
    route=$1
    tahr run --route "$routes/$route.json" --seconds 12 --check all --json --csv "$work/csv"
    expect 0
    [ "$(value stuck)$(value hung)$(value fell_out)$(value tunnels)$(value query_caps)" = 00000 ] || fail "$route: $(cat "$work/out")"
}

# modes NAMES: the modes it goes through, from when it first stands.
modes() {
    seen=$(awk -F, 'NR > 1 && (stood || $10 != "falling") { stood = 1; if ($10 != last) printf "%s%s", last ? " " : "", $10; last = $10 }' \
        "$work/csv")
    [ "$seen" = "$1" ] || fail "$route went through '$seen' instead of '$1'"
}

# events TYPE COUNT: so many of them.
events() {
    seen=$(sed -n "s/^    \"$1\": \([0-9]*\),*\$/\1/p" "$work/out")
    [ "$seen" = "$2" ] || fail "$route: $seen events '$1' instead of $2"
}

# holds CONDITION: an awk condition of t (s), x, y, z (m), mode and name (of events) that some step must fulfil.
holds() {
    awk -F, 'NR > 1 { t = $2; x = $4; y = $5; z = $6; mode = $10; name = $NF; if ('"$1"') found = 1 } END { exit !found }' \
        "$work/csv" || fail "$route: in no step $1"
}

# never CONDITION: that none may.
never() {
    awk -F, 'NR > 1 { t = $2; x = $4; y = $5; z = $6; mode = $10; name = $NF; if ('"$1"') found = 1 } END { exit found }' \
        "$work/csv" || fail "$route: in some step $1"
}

# The table's 12 digits and the clearance of 10 to 15 mm: a foot at height h stands at h + 0.9 + 0.009 to h + 0.9 +
# 0.016.
go lift
modes walking
events left_ground 0
events crushed 0
holds 't > 4.2 && t < 4.3 && x < -26 && z > 3.92 && z < 3.936'  # up: top of the lift at 0.05 + 2.97 m
holds 't > 11.9 && x > -24.98 && z > 3.909 && z < 3.916'        # on the tower of 3 m

go turntable
holds 't > 1.5 && t < 7.9 && x > -12.5 && y > 25'
holds 't > 1.5 && t < 7.9 && x < -13.5 && y > 25' # round about (-13, 25)
never 't > 1.7 && t < 7.9 && sqrt((x + 13)^2 + (y - 25)^2) > 0.7918 + 1e-3'
never 't > 1.7 && t < 7.9 && sqrt((x + 13)^2 + (y - 25)^2) < 0.7918 - 1e-3'
holds 't > 8.5 && z < 0.916'

go shuttle
modes walking
holds 't > 4.6 && t < 5.4 && x > -8 - 1e-6 && x < -8 + 1e-6'      # 9 m on
holds 't > 9.2 && t < 9.8 && x > -17 - 1e-6 && x < -17 + 1e-6'    # and back, to the place it came from
never 'z < 1.259 || z > 1.266'

go pool
modes "walking falling swimming walking"
events overlap_begin 1
events overlap_end 1
holds 'mode == "swimming" && z < -1.4'        # dives
never 'z < -3 + 0.9 + 0.009'                  # not through the bed at 3 m
holds 'mode == "walking" && x < 12 && z < 0'  # its feet on the beach
holds 't > 11.9 && x > 12 && z > 0.909 && z < 0.916'

go pool_rim
modes "walking falling swimming falling walking"
events jumped 1
holds 'mode == "swimming" && y > 29.6' # at the wall
holds 't > 11.9 && y > 30 && z > 0.909 && z < 0.916'

go crawl
modes walking
events shape 2
never 'x > 14 && x < 18.65 && t > 1.3 && z > 0.567' # the slab: 1.3 m, from x = 14 to 19
holds 't > 11.9 && x > 19.35 && z > 0.909 && z < 0.916'

go shaft
modes "walking falling walking"
events wall_jumped 4
events jumped 1
holds 't > 11.9 && x > 23.6 && z > 4.909 && z < 4.916' # the platform at 4 m

go hang
modes "walking falling hanging walking"
events grabbed 1
holds 'mode == "hanging" && z > 3.1 - 1e-5 && z < 3.1 + 1e-5' # its head at the edge
holds 't > 11.9 && x > 23.6 && z > 4.909 && z < 4.916'

go conveyor
modes walking
events left_ground 0
events jumped 0
# 2 m/s without a wish
awk -F, 'NR > 1 { if ($2 > 0.999 && !a) { a = $2; xa = $4 } if ($2 > 2.999 && !b) { b = $2; xb = $4 } }
    END { v = (xb - xa) / (b - a); exit !(v > 2 - 1e-6 && v < 2 + 1e-6) }' "$work/csv" || fail "conveyor: not at 2 m/s"
holds 't > 11.9 && x > 21 && z < 0.916'

go press
holds 't > 3.4 && t < 3.6 && name ~ /crushed/' # closed to 0.4 m from 3 to 4 s
never 't > 5.4 && name ~ /crushed/'
never 't < 2.5 && name ~ /crushed/'
holds 't > 7 && y < 22'                        # free, and off

go flying
modes "flying falling walking"
holds 'mode == "flying" && z > 8'
holds 't > 11.9 && z > 0.909 && z < 0.916'
finish
