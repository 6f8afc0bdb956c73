#!/bin/sh
# SPDX-License-Identifier: MIT
# test_options.sh: tahr_bench and tahr_stability say what is wrong with what they are asked for, before they measure.
# Environment: BENCH, STABILITY (the programs).
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# refuses CODE WORDS PROGRAM OPTIONS...
refuses() {
    wanted=$1 words=$2
    shift 2
    "$@" >"$work/out" 2>&1
    code=$?
    [ $code -eq "$wanted" ] && grep -qF -- "$words" "$work/out" && return
    echo "FAILED: $*: exit code $code, expected $wanted and '$words': $(head -n 5 "$work/out")"
    failed=1
}

bench() { refuses "$1" "$2" "$BENCH" --csv "$work/bench.csv" $3; }
bench 2 "no such world: 'nowhere'" "--world nowhere"
bench 2 "no such backend: 'nobody'" "--backend nobody"
bench 2 "world 'plane' has no backend 'box2d'" "--world plane --backend box2d"
bench 2 "world 'asleep' has no backend 'ccd'" "--world asleep --backend ccd"
bench 2 "--characters '0': expected a whole number from 1 to 100000" "--characters 0"
bench 2 "--characters '-3': expected a whole number from 1 to 100000" "--characters -3"
bench 2 "'--fast' is no option" "--fast 1"
bench 2 "'--world' is no option or lacks its value" "--world"
refuses 1 "nowhere/bench.csv' cannot be written" "$BENCH" --csv "$work/nowhere/bench.csv" --world plane

stability() { refuses "$1" "$2" "$STABILITY" --csv "" --svg "" $3; }
stability 2 "--family: 'nowhere' is not known" "--family nowhere"
stability 2 "--backend: 'nobody' is not known" "--backend nobody"
stability 2 "--preset: 'any' is not known" "--preset any"
stability 2 "--seeds '0': expected a whole number from 1 to" "--seeds 0"
stability 2 "--seed '-1': expected a whole number from 1 to" "--family wedge --backend native --preset precise --seed -1"
stability 2 "--jobs '65': expected a whole number from 1 to 64" "--jobs 65"
stability 2 "--seed needs --family, --backend and --preset" "--seed 3"
stability 2 "'--seeds' is no option or lacks its value" "--seeds"
stability 2 "its case is made of triangles" "--family slivers --preset platformer"
refuses 1 "nowhere/s.csv' cannot be written" "$STABILITY" --quick --csv "$work/nowhere/s.csv" --svg ""
refuses 1 "nowhere/s.svg' cannot be written" "$STABILITY" --quick --csv "" --svg "$work/nowhere/s.svg"
exit $failed
