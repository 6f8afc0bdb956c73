#!/bin/sh
# SPDX-License-Identifier: MIT
# test_lcm.sh: what runs leave over LCM is proven by taking it again, on every kind of level and with all that a run can
# do; nothing that is published changes a run; wrong usage of run --lcm, listen, record and replay is named.
. "$(dirname "$0")/support.sh"

tahr listen --help
if grep -q "built without LCM" "$work/err"; then
    echo "SKIP: cli_lcm: this tahr was built without LCM"
    exit 77
fi
log=$work/a.lcmlog

# proven STEPS "OPTIONS OF THE LEVEL" OPTIONS... : a run that is recorded is the same run, and its log proves it.
proven() {
    steps=$1
    level=$2
    shift 2
    # shellcheck disable=SC2086
    tahr run $level "$@" --check off --json
    hash=$(value state_hash)
    # shellcheck disable=SC2086
    tahr run $level "$@" --check off --json --lcm "file://$log"
    expect 0
    [ "$(value state_hash)" = "$hash" ] || fail "publishing changed the run $level $*"
    [ "$(value lcm_open) $(value lcm_dropped) $(value lcm_failed)" = "true 0 0" ] || fail "$level $*: $(cat "$work/out")"
    # shellcheck disable=SC2086
    (cd / && "$TAHR" replay "$log" --verify ${level%% --back*}) >"$work/out" 2>"$work/err" ||
        fail "not proven: $level $*: $(cat "$work/out" "$work/err")"
    grep -q "proven     $steps steps" "$work/out" || fail "not all of $level $*: $(cat "$work/out")"
    grep -q "not proven" "$work/out" && fail "$level $*: $(cat "$work/out")"
}

proven 19200 "" --seconds 20
proven 3900 "--2d" --tour
backends all >"$work/backends"
while read -r backend; do
    case $backend in
    box2d*) proven 2400 "--2d --backend $backend" --characters 8 --seconds 5 --shape box ;;
    *) proven 720 "--backend $backend" --characters 4 --seconds 3 --rate 60 ;;
    esac
done <"$work/backends"
proven 2400 "--2d" --characters 8 --seconds 5 --preset platformer
proven 2880 "" --seconds 3 --preset unreal
proven 7200 "" --seconds 3 --characters 40 --crowd
tahr run --seconds 0.1 --threads 2
if ! grep -q "built without threads" "$work/err"; then
    proven 5760 "" --seconds 6 --threads 2
    proven 7200 "" --seconds 3 --characters 40 --crowd --threads 3
fi

# A level from a file is known again, and another one is refused.
printf 'v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nv 5 -3 0\nv 5 3 0\nv 5 3 3\nv 5 -3 3\nf 1 2 3 4\nf 5 6 7 8\n' \
    >"$work/level.obj"
proven 1920 "--level $work/level.obj --up z" --seconds 2
tahr replay "$log" --verify
expect 2 "was recorded in level" "with hash" "--level"
tahr replay "$log" --verify --level "$work/nowhere.obj"
expect 2 "$work/nowhere.obj"

# As JSON: all is equal; of a file that is cut off, what of it is.
tahr replay "$log" --verify --json --level "$work/level.obj" --up z
expect 0 '"verdict": "ok"' '"proven": 1920,' '"gaps": []' '"backend": "native"'
is_json || fail "replay --verify --json is no JSON"
head -c 100000 "$log" >"$work/cut.lcmlog"
tahr replay "$work/cut.lcmlog" --verify --json --level "$work/level.obj" --up z
expect 1 '"verdict": "not proven"' '"damages": 1' "cut off"
is_json || fail "replay --verify --json of a damaged file is no JSON"

# Thinned out, states are fewer and inputs are not.
tahr run --seconds 2 --characters 2 --lcm "file://$log" --lcm-rate 10 --lcm-prefix robot_
expect 0 "messages to file://$log; 0 dropped, 0 failed"
tahr listen --lcm "file://$log?speed=0" --channel 'robot_TAHR_STATE' # due at 0, 0.1, ... 2 s
[ "$(grep -c '^robot_TAHR_STATE' "$work/out")" = 42 ] || fail "--lcm-rate 10: $(wc -l <"$work/out") states"
tahr listen --lcm "file://$log?speed=0" --channel '*INPUT' --json
[ "$(grep -c '^{"channel":"robot_TAHR_INPUT"' "$work/out")" = 240 ] || fail "inputs are thinned out"
if command -v python3 >/dev/null 2>&1; then
    python3 -c 'import json, sys; [json.loads(line) for line in open(sys.argv[1])]' "$work/out" || fail "no JSON lines"
fi

# Wrong usage.
usage() {
    first=$1
    second=$2
    shift 2
    tahr "$@"
    expect 2 "$first" "$second"
    [ -s "$work/out" ] && fail "tahr $*: wrote to standard output: $(cat "$work/out")"
}
usage "unknown scheme 'bogus'" "--lcm 'bogus://x'" run --lcm bogus://x
usage "--lcm 'tcpq://x'" "waits for ever" run --lcm tcpq://x
usage "--lcm 'file://$work/none/a'" "No such file" run --lcm "file://$work/none/a"
usage "--lcm" "needs a value" run --lcm
usage "--lcm-rate '0'" "number from" run --lcm "file://$log" --lcm-rate 0
usage "--lcm-rate" "only with --lcm" run --lcm-rate 5
usage "--lcm-prefix" "only with --lcm" run --lcm-prefix a
usage "--fast" "only with --lcm" run --fast
usage "prefix is not of up to 32" "letters" run --lcm "file://$log" --lcm-prefix "$(printf '%040d' 0)"
for command in listen record; do
    more=
    [ $command = listen ] || more=$work/b.lcmlog
    # shellcheck disable=SC2086
    {
        usage "unknown option '--nonsense'" "--channel" $command --nonsense $more
        usage "--seconds 'x'" "number" $command --seconds x $more
        usage "--lcm 'bogus://x'" "expected udpm://" $command --lcm bogus://x $more
        usage "memq" "heard only by who publishes" $command --lcm memq:// $more
        usage "'1.2.3.4' is no multicast group" "--lcm" $command --lcm udpm://1.2.3.4:7667 $more
        usage "$work/none" "No such file" $command --lcm "file://$work/none" $more
        usage "expected an LCM event log" "--lcm" $command --lcm "file://$0" $more
    }
done
[ -e "$work/b.lcmlog" ] && fail "record that could not begin left a file"
usage "--count '0'" "whole number" listen --count 0
usage "unexpected argument 'x'" "--lcm URL" listen x
usage "expected the name of one file" "record --help" record
usage "expected the name of one file" "record --help" record a b
usage "$work/none/b" "cannot write" record --lcm "file://$log" "$work/none/b"
usage "--speed '-1'" "number from 0" replay "$log" --speed -1
usage "expected udpm://" "--lcm 'memq://'" replay "$log" --lcm memq://
usage "--verify" "not with --lcm" replay "$log" --verify --speed 2
usage "--json" "only with --verify" replay "$log" --json
usage "--level" "only with --verify" replay "$log" --level "$work/level.obj"
usage "--trace '$log'" "an LCM event log" replay --trace "$log"
usage "--backend ccd" "was recorded on backend 'native'" replay "$log" --verify --backend ccd
usage "no trace" "no LCM event log" replay "$0" --verify
tahr run --seconds 1 --trace "$work/a.trace"
usage "is a trace" "--verify" replay "$work/a.trace" --verify
if [ -w /dev/full ]; then
    tahr record --lcm "file://$log?speed=0" /dev/full
    expect 1 "'/dev/full': cannot write" "No space"
    tahr run --seconds 10 --lcm file:///dev/full
    expect 0 "messages to file:///dev/full" # the run itself is well; what was lost is said
    grep -q "; 0 dropped, 0 failed" "$work/out" && fail "a full disk lost nothing: $(grep lcm "$work/out")"
fi
for command in listen record replay; do
    tahr help $command
    expect 0 "usage: tahr $command"
done
tahr help
expect 0 "listen " "record FILE"
tahr nonsense
expect 2 "listen, record, replay"
finish
