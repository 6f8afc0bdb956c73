#!/bin/sh
# SPDX-License-Identifier: MIT
# test_side.sh: the bundled side-scroller is toured on every backend at 30, 60 and 144 Hz: every watched place is come
# to, and what has to be done on the way is done as often as the level asks for it.
. "$(dirname "$0")/support.sh"

# place NAME: when it was first come to
place() {
    sed -n "s/^    \"$1\": \(.*\)\$/\1/p" "$work/out" | sed 's/,$//'
}

tour() {
    tahr run --2d --tour --check all --json --csv "$work/a.csv" "$@"
    expect 0
    # One look at the summary: every number that has to be zero, and the 15 watched places.
    awk -F': ' '
        /^  "(tunnels|stuck|hung|bad_states|fell_out|crushed|query_caps)": / && $2 != "0," { print $0; bad = 1 }
        /^  "places"/ { inside = 1; next }
        /^  }/ { inside = 0 }
        inside { known++; if ($2 !~ /^[0-9]/) { print "never came to" $1; bad = 1 } }
        END { if (known != 15) { print known " places"; bad = 1 } exit bad }' "$work/out" >"$work/bad" ||
        fail "tour $*: $(cat "$work/bad")"
}

backends all >"$work/backends"
while read -r backend; do
    for rate in 30 60 144; do
        tour --backend "$backend" --rate "$rate"
        # Three jumps up through the planks, one onto the shuttle and one off it, three over gaps, one under the low
        # ceiling, one for the corner, one over the kerb, one into the shaft; two off its walls.
        [ "$(value jumps)" = 12 ] || fail "$backend at $rate Hz: $(value jumps) jumps"
        [ "$(place wall_jumped)" = 2 ] || fail "$backend at $rate Hz: $(place wall_jumped) wall jumps"
    done
    # Flat feet, and one body per tile, whose seams are run over also under ceilings too low to step up below them.
    tour --backend "$backend" --shape box
    tour --backend "$backend" --tiles separate
    [ "$(value bodies)" -gt 500 ] || fail "separate tiles are $(value bodies) bodies"
done <"$work/backends"
tour --tiles separate --shape box

# Two presses take it from the third plank (feet at 8.5 m) onto the first (5.5 m), by way of the second (7 m): centres
# are 0.91 to 0.92 m above feet.
tour
awk -F, '$4 > 31 && $4 < 35 && $10 == "walking" { feet = int(($5 - 0.9) * 100) / 100; if (feet != last) print feet
    last = feet }' "$work/a.csv" | tr '\n' ' ' >"$work/feet"
case "$(cat "$work/feet")" in
"4.01 5.51 7.01 8.51 7.01 5.51 ") ;;
*) fail "stood at $(cat "$work/feet")" ;;
esac
# It rides the lift: stands, at rest, while it rises from 4 to 9 m.
awk -F, '$4 > 62 && $4 < 66 && $10 == "walking" && $7 == 0 && $5 > 6 && $5 < 8 { rising++ } END { exit !(rising > 30) }' \
    "$work/a.csv" || fail "did not ride the lift"
# The crawl space is 1 m high: only who crouches gets in.
[ "$(place shape)" = 2 ] || fail "changed its height $(place shape) times"
"$TAHR" level tour.json | sed 's/, "crouch": true//' >"$work/upright.json"
tahr run --2d --route "$work/upright.json" --seconds 60 --json
expect 0
[ "$(place crawl)" = null ] && [ "$(place "lift top")" != null ] || fail "came into the crawl space upright"
# Without the presses of drop it stays on top of the stack, and walks off its end.
"$TAHR" level tour.json | sed 's/, "drop": true//' >"$work/kept.json"
tahr run --2d --route "$work/kept.json" --seconds 12 --json --csv "$work/b.csv"
expect 0
awk -F, '$2 > 10.3 && $2 < 11 && !($5 > 9.4) { bad = 1 } END { exit bad }' "$work/b.csv" || fail "fell through by itself"

# No z anywhere.
awk -F, 'NR > 1 && ($6 != 0 || $9 != 0) { bad = 1 } END { exit bad }' "$work/a.csv" || fail "left the plane"

# Wanderers.
while read -r backend; do
    tahr run --2d --backend "$backend" --characters 32 --seconds 10 --check all --json
    expect 0
    [ "$(value jumps)" -gt 20 ] || fail "$backend: 32 wanderers jumped $(value jumps) times"
done <"$work/backends"
# UNREAL sweeps without a margin: what a box then touches must not hold it in the air.
tahr run --2d --preset unreal --shape box --rate 30 --seed 3 --characters 81 --json
expect 0
[ "$(value hung)" = 0 ] || fail "boxes of UNREAL: hung $(value hung)"
tahr run --2d --characters 3 --seconds 1 --plot "$work/a.png"
expect 0 "places" "a.png"
tahr run --2d --tour --seconds 1 --plot "$work/a.svg"
expect 0
grep -q "<svg" "$work/a.svg" || fail "no SVG"

# Levels are there without the sources.
tahr level
expect 0 side.tmj side.png tour.json
tahr level side.tmj
expect 0 '"type": "map"'
cp "$work/out" "$work/side.tmj"
tahr level tour.json
cp "$work/out" "$work/tour.json"
tahr run --2d --tour --seconds 20 --json
hash=$(value state_hash)
tahr run --2d --level "$work/side.tmj" --route "$work/tour.json" --seconds 20 --json
[ "$(value state_hash)" = "$hash" ] || fail "the level written out runs differently"
tahr run --help
expect 0 --2d --tour --tiles --pixels-per-metre --shape drop at_x
finish
