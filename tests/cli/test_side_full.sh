#!/bin/sh
# SPDX-License-Identifier: MIT
# test_side_full.sh: more than 100 000 steps of wanderers on the bundled side-scroller, with every backend, with round
# and with flat feet, over outlines and over separate tiles: nobody tunnels, sinks through a platform, overlaps anything
# or is stuck for good, and nobody hangs in the air.
. "$(dirname "$0")/support.sh"

backends all >"$work/backends"
while read -r backend; do
    for options in "" "--shape box" "--tiles separate" "--rate 30 --seconds 40" "--rate 144 --seconds 10"; do
        # shellcheck disable=SC2086
        tahr run --2d --backend "$backend" --characters 100 --seconds 20 --check all --json $options
        expect 0
        for key in tunnels stuck hung bad_states fell_out query_caps unknown; do
            [ "$(value $key)" = 0 ] || fail "$backend $options: $key $(value $key)"
        done
    done
done <"$work/backends"
finish
