#!/bin/sh
# SPDX-License-Identifier: MIT
# test_route.sh: a route is followed: up the stairs of the playground with a jump on the landing.
. "$(dirname "$0")/support.sh"

cat >"$work/stairs.json" <<'JSON'
{
  "start": [-29, 14.5, 0.9125],
  "inputs": [
    {"time": 0, "move": [1, 0, 0], "facing": [1, 0, 0]},
    {"time": 1.1},
    {"time": 1.501, "jump": true},
    {"time": 1.502}
  ]
}
JSON
tahr run --route "$work/stairs.json" --seconds 3 --check all --json --csv "$work/a.csv" --plot "$work/a.svg"
expect 0
[ "$(value characters)" = 1 ] || fail "a route drives $(value characters) characters"
# How many rises the round foot makes of one step of the stairs is not the shell's affair: all 8 have to be climbed.
[ "$(value steps_climbed)" -ge 8 ] || fail "climbed $(value steps_climbed) of 8 steps"
[ "$(value jumps)" = 1 ] || fail "a press shorter than a step made $(value jumps) jumps"
# At the end it stands on the landing: feet at 2.4 m, centre 0.9 m and the clearance above.
tail -n 1 "$work/a.csv" | awk -F, '{exit !($6 > 3.309 && $6 < 3.3151 && $10 == "walking" && $7 == 0)}' ||
    fail "ended at $(tail -n 1 "$work/a.csv")"

printf '[{"time": 0.5, "move": [0, 1, 0]}]' >"$work/list.json"
tahr run --route "$work/list.json" --seconds 1 --json
expect 0
finish
