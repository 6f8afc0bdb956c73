#!/bin/sh
# SPDX-License-Identifier: MIT
# test_run.sh: the playground is walked, the summary is complete, the same seed gives the same bits, files are written.
. "$(dirname "$0")/support.sh"

run="run --seconds 4 --characters 24 --check all --json"
tahr $run --csv "$work/a.csv" --plot "$work/a.svg"
expect 0
is_json || fail "run --json is no JSON"
for key in level backend preset characters steps ns_median ns_p99 sweeps_per_step triangle_tests_per_step grounded \
    steps_climbed jumps fell_out stuck hung tunnels deepest_penetration state_hash; do
    [ -n "$(value $key)" ] || fail "no key '$key' in the summary"
done
[ "$(value level)" = playground ] && [ "$(value backend)" = native ] && [ "$(value steps)" = 5760 ] || fail "wrong facts"
[ "$(value tunnels)" = 0 ] && [ "$(value bad_states)" = 0 ] && [ "$(value fell_out)" = 0 ] || fail "trouble: $(cat "$work/out")"
[ "$(value checked)" = 5760 ] || fail "--check all looked at $(value checked) of 5760 steps"
[ "$(value steps_climbed)" -gt 0 ] && [ "$(value jumps)" -gt 0 ] || fail "nobody climbed or nobody jumped"
hash=$(value state_hash)

[ "$(wc -l <"$work/a.csv")" -eq 5761 ] || fail "the CSV has $(wc -l <"$work/a.csv") lines"
[ "$(awk -F, '{print NF}' "$work/a.csv" | sort -u)" = 21 ] || fail "rows of different length in the CSV"
head -n 1 "$work/a.csv" | grep -q '^step,time,character,x,y,z,vx,vy,vz,mode,' || fail "wrong CSV header"
grep -q '<svg' "$work/a.svg" || fail "the plot is no SVG"

tahr $run
[ "$(value state_hash)" = "$hash" ] || fail "the same seed gave another state_hash"
tahr $run --check off
[ "$(value state_hash)" = "$hash" ] || fail "checking changed the state_hash"
tahr $run --seed 2
[ "$(value state_hash)" != "$hash" ] || fail "another seed gave the same state_hash"
tahr $run --backend native --rate 30
expect 0

tahr run --seconds 1 --plot "$work/a.png"
expect 0 "playground: 16 characters" "wrote" "no tunnelling" "hash"
[ "$(head -c 4 "$work/a.png" | tail -c 3)" = PNG ] || fail "the plot is no PNG"
[ -s "$work/err" ] && fail "a piped run wrote to standard error: $(cat "$work/err")"
[ "$(value characters)" = "" ] || fail "words and JSON mixed"
finish
