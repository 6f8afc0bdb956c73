#!/bin/sh
# SPDX-License-Identifier: MIT
# test_selftest.sh: the conformance kit from the shell: table, JSON, a choice of cases, and what is wrong usage.
. "$(dirname "$0")/support.sh"

tahr selftest native
expect 0 "overlap_at_start" "pass" "not supported" "expected" "actual" " 0 failed"
grep -qE '^native [^ ]+: [0-9]+ passed, 0 failed, [0-9]+ not supported$' "$work/out" || fail "no summary line"
grep -q 'FAIL' "$work/out" && fail "a case of native failed"
[ "$(printf '\033')" != "" ] && grep -q "$(printf '\033')" "$work/out" && fail "colours in the table"

tahr selftest native --only grazing_
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

# Every backend of this shell, whole: nothing fails, and who says that a case is not supported is its README's business.
"$TAHR" info --json | sed -n 's/^      "name": "\(.*\)",$/\1/p' >"$work/names"
[ -s "$work/names" ] || fail "info names no backend"
# tested FOLDER: the last call passed, and the README says with which counts.
tested() {
    expect 0 " 0 failed"
    echo "self-test: $(tail -n 1 "$work/out")"
    counts=$(sed -n 's/^.*: \([0-9]*\) passed, 0 failed, \([0-9]*\) not supported$/\1 pass, \2 are not supported/p' "$work/out")
    grep -qF "$counts" "$here/../../backends/$1/README.md" || fail "backends/$1/README.md does not say '$counts'"
}
while read -r name; do
    tahr selftest "$name"
    case $name in
    box2d-2) tested box2d ;;
    *) tested "$name" ;;
    esac
done <"$work/names"

# Every plugin of the build, where the build's folder is known (ctest runs beside it).
plugins=$(dirname "$TAHR")/../lib
for plugin in native ccd fcl box2d template; do
    [ -f "$plugins/libtahr_$plugin.so" ] || continue
    tahr selftest "$plugins/libtahr_$plugin.so" --only rest_
    grep -q "not supported here" "$work/err" && echo "SKIP: cli_selftest: this platform loads no plugins" && break
    expect 0 "rest_at_margin" " 0 failed" "$plugin "
done
if [ -f "$plugins/libtahr_template.so" ] && ! grep -q "not supported here" "$work/err"; then
    tahr selftest "$plugins/libtahr_template.so"
    tested template
fi
# A replay is no backend without its file, and what is broken is not loaded.
if [ -f "$plugins/libtahr_trace.so" ]; then
    tahr selftest "$plugins/libtahr_trace.so"
    expect 1 "nothing was tested" "0 passed, 0 failed"
fi
while read -r broken words; do
    [ -f "$plugins/../tests/plugins/$broken.so" ] || continue
    tahr selftest "$plugins/../tests/plugins/$broken.so"
    expect 1 "cannot load '$plugins/../tests/plugins/$broken.so'" "$words"
done <<END
no_symbol no function tahr_backend_v1
tiny_struct struct_size
bad_major backend.abi_major and abi_minor are 1.1, expected 0.1
null_slot is NULL, expected a function
null_name name
END
finish
