#!/bin/sh
# SPDX-License-Identifier: MIT
# test_lcm_network.sh: runs, listeners, recorders and LCM's own tools on a network of their own (a private namespace:
# nothing leaves it): lcm-logger keeps what `tahr replay --verify` proves, lcm-logplayer plays what `tahr record` kept.
. "$(dirname "$0")/support.sh"

skip() {
    echo "SKIP: cli_lcm_network: $1"
    exit 77
}
if [ -z "${TAHR_TEST_NETWORK:-}" ]; then
    "$TAHR" listen --help 2>&1 | grep -q "built without LCM" && skip "this tahr was built without LCM"
    command -v unshare >/dev/null 2>&1 && command -v ip >/dev/null 2>&1 || skip "unshare or ip was not found"
    map=
    [ "$(id -u)" = 0 ] || map=-r
    own="-n -p -f --kill-child"
    up='ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo'
    # With a /proc of its own, which the sanitizers look into, where that is permitted.
    # shellcheck disable=SC2086
    if unshare $map $own --mount-proc true >/dev/null 2>&1; then
        own="$own --mount-proc"
    fi
    # shellcheck disable=SC2086
    unshare $map $own sh -c "$up" >"$work/why" 2>&1 || skip "no private network is permitted: $(cat "$work/why")"
    export TAHR_TEST_NETWORK=1
    code=0
    # shellcheck disable=SC2086
    unshare $map $own sh "$0" || code=$?
    exit $code
fi

url='udpm://239.255.76.67:7667?ttl=0'
unset LCM_DEFAULT_URL
ip link set lo up

# Without a way for multicast a run goes on, and who listens is told.
tahr run --seconds 0.2 --lcm "$url"
expect 0 "no way to multicast group 239.255.76.67" "the run goes on without it" "NOT THERE: nothing went to $url"
for command in "listen --seconds 1" "record --seconds 1 $work/none.lcmlog"; do
    # shellcheck disable=SC2086
    tahr $command
    expect 2 "no way to multicast group 239.255.76.67"
done
ip link set lo multicast on
ip route add 224.0.0.0/4 dev lo

# One message to see whether a listener is there, and one that comes after all others.
for name in ready last; do
    tahr run --seconds 0.1 --characters 1 --lcm "file://$work/all.lcmlog" --lcm-prefix ${name}_
    expect 0
    tahr record --lcm "file://$work/all.lcmlog?speed=0" --channel '*WORLD' "$work/$name.lcmlog"
    expect 0
done

# call NAME FILE: sends that message until it is in the file of who listens (which others may hear too).
call() {
    calls=0
    until grep -qaF "${1}_TAHR_WORLD" "$2" 2>/dev/null; do
        calls=$((calls + 1))
        [ $calls -lt 300 ] || { fail "nobody writes $2"; return; }
        "$TAHR" replay "$work/$1.lcmlog" --speed 0 >/dev/null 2>&1 # LCM's own URL is ours
        sleep 0.05
    done
}

# Ends a process of ours, by a signal, and leaves its exit code in $code.
end() {
    kill -s "$1" "$2"
    code=0
    wait "$2" || code=$?
}

# heard_by_all: a run of four seconds, heard by three at once, at a rate that lcm-logger keeps up with on a busy machine
# (liblcm keeps 30 messages for it). 1: something was lost on the way all the same.
heard_by_all() {
    rm -f "$work"/*.heard
    "$TAHR" record "$work/ours.heard" >"$work/record.out" 2>&1 &
    recorder=$!
    "$TAHR" listen --json >"$work/json.heard" 2>"$work/listen.err" &
    listener=$!
    logger=
    if command -v lcm-logger >/dev/null 2>&1; then
        lcm-logger --lcm-url="$url" "$work/theirs.heard" >"$work/logger.out" 2>&1 &
        logger=$!
        call ready "$work/theirs.heard"
    fi
    call ready "$work/ours.heard"
    call ready "$work/json.heard"
    tahr run --seconds 4 --rate 15 --characters 2 --lcm "$url" --json
    expect 0
    [ "$(value lcm_open) $(value lcm_dropped) $(value lcm_failed)" = "true 0 0" ] || fail "$(grep lcm "$work/out")"
    awk -v wall="$(value wall_seconds)" 'BEGIN { exit !(wall > 3.8) }' || fail "a run to a network is not paced"
    for file in ours.heard json.heard ${logger:+theirs.heard}; do
        call last "$work/$file"
    done
    end INT $recorder
    [ $code = 0 ] || fail "record ended with $code: $(cat "$work/record.out")"
    end TERM $listener
    [ $code = 0 ] || fail "listen ended with $code: $(cat "$work/listen.err")"
    if [ -n "$logger" ]; then
        end TERM $logger
        "$TAHR" replay "$work/theirs.heard" --verify --channel 'TAHR_*' | grep -q '^  lost ' && return 1
    fi
    grep -q "of them lost on the way 0," "$work/record.out" && grep -q "; 0 lost on the way" "$work/listen.err"
}
tries=0
until heard_by_all; do
    tries=$((tries + 1))
    [ $tries -lt 5 ] || { fail "lost in every try: $(cat "$work/record.out" "$work/listen.err")"; break; }
done
for file in ours theirs; do
    [ -e "$work/$file.heard" ] || { echo "cli_lcm_network: lcm-logger was not found: its part is left out"; continue; }
    tahr replay "$work/$file.heard" --verify --channel 'TAHR_*'
    expect 0 "proven     120 steps of 2 characters" "ok"
done
grep -qF '{"channel":"TAHR_SNAPSHOT"' "$work/json.heard" || fail "no snapshot was heard"

# played COMMAND... : what it plays is recorded again. 1: a datagram was lost on the way.
played() {
    rm -f "$work/again.heard"
    "$TAHR" record "$work/again.heard" >"$work/record.out" 2>&1 &
    recorder=$!
    call ready "$work/again.heard"
    "$@" >"$work/play.out" 2>&1 || fail "$*: $(cat "$work/play.out")"
    call last "$work/again.heard"
    end INT $recorder
    [ $code = 0 ] || fail "record ended with $code: $(cat "$work/record.out")"
    grep -q "of them lost on the way 0," "$work/record.out"
}

# What was recorded is played again, by ours and by LCM's player, and proves what it proved before.
tahr record --lcm "file://$work/ours.heard?speed=0" --channel 'TAHR_*' "$work/run.lcmlog"
expect 0
for player in "$TAHR replay $work/run.lcmlog --speed 4" "lcm-logplayer --lcm-url=$url --speed=4 $work/run.lcmlog"; do
    command -v "${player%% *}" >/dev/null 2>&1 || { echo "cli_lcm_network: ${player%% *} was not found"; continue; }
    tries=0
    # shellcheck disable=SC2086
    until played $player; do
        tries=$((tries + 1))
        [ $tries -lt 5 ] || { fail "lost in every try: $(cat "$work/record.out")"; break; }
    done
    tahr replay "$work/again.heard" --verify --channel 'TAHR_*'
    expect 0 "proven     120 steps of 2 characters" "ok"
done

# A table on a terminal, and a run that is ended in the middle.
if command -v script >/dev/null 2>&1; then
    "$TAHR" run --seconds 1000 --characters 3 --lcm "$url" >"$work/run.out" 2>&1 &
    run=$!
    script -qec "stty cols 120 rows 20; $TAHR listen --count 2000 --seconds 100" "$work/table" >/dev/null 2>&1 ||
        fail "no table"
    end INT $run
    [ $code = 0 ] || fail "a run ended by Ctrl-C ended with $code: $(cat "$work/run.out")"
    grep -q "ended      by a signal after" "$work/run.out" || fail "no summary: $(cat "$work/run.out")"
    grep -qa "level 'playground' on native, 3 characters" "$work/table" || fail "the table has no level"
    grep -qaE '^ +2 (walking|falling)' "$work/table" || fail "the table has no third character"
    grep -qaE 'heard [0-9]+ messages' "$work/table" || fail "the table has no summary"
    [ "$(tr '\033' '\n' <"$work/table" | grep -cE '^\[[0-9]+A')" -gt 1 ] || fail "the table is not drawn over itself"
fi
finish
