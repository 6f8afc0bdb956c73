#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh BUILD SECONDS: every fuzzer of BUILD/bin for SECONDS seconds each, from the corpus, one line each. What they
# find is kept as BUILD/found/TARGET-*; what they learn as BUILD/corpus/TARGET. Ends with 1 if there was a find.
set -u
build=$1
seconds=$2
root=$(cd "$(dirname "$0")/.." && pwd)
failed=0
mkdir -p "$build/found"
export ASAN_OPTIONS="${ASAN_OPTIONS:-detect_leaks=1}" LSAN_OPTIONS="suppressions=$root/fuzz/leaks.txt:print_suppressions=0"
ran=0
for fuzzer in "$build"/bin/fuzz_*; do
    [ -x "$fuzzer" ] || continue
    name=$(basename "$fuzzer" | sed 's/^fuzz_//')
    ran=$((ran + 1))
    mkdir -p "$build/corpus/$name"
    seeds=$root/fuzz/corpus/$name
    [ -d "$seeds" ] || seeds=
    words=
    [ -f "$root/fuzz/dict/$name.dict" ] && words="-dict=$root/fuzz/dict/$name.dict"
    # shellcheck disable=SC2086
    "$fuzzer" -max_total_time="$seconds" -max_len=8192 -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 $words \
        -artifact_prefix="$build/found/$name-" "$build/corpus/$name" $seeds >"$build/found/$name.log" 2>&1
    code=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$build/found/$name.log")
    edges=$(grep -o 'cov: [0-9]*' "$build/found/$name.log" | tail -n 1)
    if [ $code = 0 ]; then
        echo "fuzz $name: ${runs:-0} inputs in $seconds s, ${edges:-cov: 0}, nothing found"
    else
        failed=1
        echo "fuzz $name: FOUND something after ${runs:-?} inputs, see $build/found/$name.log"
        grep -E 'FIND:|ERROR: |runtime error|Test unit written' "$build/found/$name.log" | head -n 5
    fi
done
[ $ran -gt 0 ] || { echo "fuzz: no fuzzers in $build/bin"; exit 2; }
exit $failed
