#!/bin/sh
# SPDX-License-Identifier: MIT
# test_selftest.sh: the conformance kit from the shell: table, JSON, a choice of cases, and what is wrong usage.
. "$(dirname "$0")/support.sh"

tahr selftest native
expect 0 "overlap_at_start" "pass" "not supported" "expected" "actual" " 0 failed"
grep -qE '^native [^ ]+: [0-9]+ passed, 0 failed, [0-9]+ not supported$' "$work/out" || fail "no summary line"
grep -q 'FAIL' "$work/out" && fail "a case of native failed"
[ "$(printf '\033')" != "" ] && grep -q "$(printf '\033')" "$work/out" && fail "colours in the table"

tahr selftest native-double --only grazing_
expect 0 "grazing_1_degree" "grazing_0.1_degree" ": 2 passed, 0 failed, 0 not supported"

tahr selftest native --only tie_ --json
expect 0 '"case": "tie_by_body"' '"verdict": "pass"' '"expected"' '"actual"'
is_json || fail "selftest --json is no JSON"
[ "$(value passed)" = 2 ] || fail "passed is $(value passed) instead of 2"
[ "$(value failed)" = 0 ] || fail "failed is $(value failed) instead of 0"

# A tolerance that nothing can keep: what fails says so, with the exit code.
tahr selftest native --only far_origin_1e6 --gap 1e-12
expect 1 "FAIL" "expected" "actual" ": 0 passed, 1 failed"

tahr selftest --help
expect 0 "usage: tahr selftest" "--only" "--json"
tahr selftest native --help
expect 0 "usage: tahr selftest"
tahr help selftest
expect 0 "usage: tahr selftest"
tahr selftest
expect 2 "which backend"
tahr selftest nonsense
expect 2 "nonsense" "tahr info"
tahr selftest native --only no_such_case
expect 2 "desc.only"
tahr selftest native --only
expect 2 "--only needs a value"
tahr selftest native --gap much
expect 2 "--gap" "much"
tahr selftest native more
expect 2 "more"
tahr selftest "$work/no_such_file.so"
expect 1 "no_such_file.so"
echo "this is no library" >"$work/text.so"
tahr selftest "$work/text.so"
expect 1 "text.so"

# Every plugin of the build, where the build's folder is known (ctest runs beside it).
for plugin in "$(dirname "$TAHR")"/../lib/libtahr_ccd.so "$(dirname "$TAHR")"/../lib/libtahr_native.so; do
    [ -f "$plugin" ] || continue
    tahr selftest "$plugin" --only rest_
    grep -q "not supported here" "$work/err" && echo "SKIP: cli_selftest: this platform loads no plugins" && break
    expect 0 "rest_at_margin" " 0 failed"
done
finish
