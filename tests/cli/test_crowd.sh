#!/bin/sh
# SPDX-License-Identifier: MIT
# test_crowd.sh: run --threads gives the bits of a run without it, run --crowd keeps characters apart.
. "$(dirname "$0")/support.sh"

tahr run --seconds 0.1 --characters 1 --threads 2
if grep -q "built without threads" "$work/err"; then
    echo "SKIP: cli_crowd: this tahr was built without threads"
    exit 77
fi
usage() {
    first=$1
    second=$2
    shift 2
    tahr "$@"
    expect 2 "$first" "$second"
    [ -s "$work/out" ] && fail "tahr $*: wrote to standard output"
}
for number in 0 -1 1.5 x "" 257 99999999999999999999; do
    usage "--threads '$number'" "whole number from 1 to 256" run --threads "$number"
done
usage "--trace" "not with --threads" run --threads 2 --trace "$work/a.trace"
usage "--trace" "not with --crowd" run --crowd --trace "$work/a.trace"
tahr run --help
expect 0 "--threads T" "--crowd"

run="run --seconds 2 --characters 60 --check all --json"
tahr $run
alone=$(value state_hash)
for threads in 1 2 5; do
    tahr $run --threads $threads
    expect 0
    [ "$(value state_hash)" = "$alone" ] || fail "--threads $threads gave another state_hash"
    [ "$(value threads)" = $threads ] || fail "the summary says $(value threads) threads of $threads"
done

# 300 on the playground meet each other: then some go elsewhere, none into another one, and no thread changes a bit.
run="run --seconds 3 --characters 300 --check all --json --crowd"
tahr $run
expect 0
crowd=$(value state_hash)
[ "$crowd" != "$alone" ] && [ "$(value crowd)" = true ] || fail "--crowd changed nothing"
awk -v apart="$(value least_apart)" 'BEGIN { exit !(apart >= -1e-6 && apart < 0.05) }' ||
    fail "closest to each other: $(value least_apart)"
tahr $run --threads 3
expect 0
[ "$(value state_hash)" = "$crowd" ] || fail "--threads 3 gave another crowd"
tahr run --seconds 2 --characters 300 --crowd --threads 2 --csv "$work/a.csv"
expect 0 "closest to each other" "hash"
[ "$(wc -l <"$work/a.csv")" -eq 36001 ] || fail "the CSV has $(wc -l <"$work/a.csv") lines"
tahr run --2d --seconds 2 --characters 30 --crowd --threads 2
expect 0 "hash"
finish
