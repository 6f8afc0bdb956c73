#!/bin/sh
# SPDX-License-Identifier: MIT
# test_levels.sh: the playground and real levels are walked on every backend without tunnelling, overlaps or a character
# stuck for good. LEVELS is the directory of the real ones; what is not there is skipped by name.
. "$(dirname "$0")/support.sh"

levels=${LEVELS:-$here/../../../shared/levels}
backends solid >"$work/backends"
[ -s "$work/backends" ] || fail "no backends listed"

# walk NAME OPTIONS...: with every backend
walk() {
    name=$1
    shift
    while read -r backend; do
        tahr run "$@" --backend "$backend" --characters 32 --seconds 5 --check all --json
        expect 0
        [ "$(value level)" = "$name" ] && [ "$(value backend)" = "$backend" ] || fail "wrong facts about $name on $backend"
        for key in tunnels stuck hung bad_states; do
            [ "$(value $key)" = 0 ] || fail "$name on $backend: $key $(value $key)"
        done
    done <"$work/backends"
}

walk playground
for level in dungeon.obj nav_test.obj; do
    if [ -f "$levels/$level" ]; then
        walk "$level" --level "$levels/$level"
    else
        echo "SKIP: cli_levels: $level is not in $levels"
    fi
done
finish
