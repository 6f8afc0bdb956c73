#!/bin/sh
# SPDX-License-Identifier: MIT
# test_octree.sh: a map of voxels is walked on the fcl backend, from both kinds of file the same; other backends and
# broken files get a message. MAKE_VOXELS writes the map.
. "$(dirname "$0")/support.sh"

if [ -z "${MAKE_VOXELS:-}" ]; then
    echo "SKIP: cli_octree: built without the fcl backend"
    exit 77
fi
hash=
for kind in bt ot; do
    "$MAKE_VOXELS" "$work/room.$kind" >/dev/null || fail "cannot write room.$kind"
    tahr run --level "$work/room.$kind" --backend fcl --characters 8 --seconds 6 --check all --json
    expect 0
    [ "$(value level)" = "room.$kind" ] && [ "$(value backend)" = fcl ] || fail "wrong facts about room.$kind"
    for key in tunnels stuck hung bad_states fell_out; do
        [ "$(value $key)" = 0 ] || fail "room.$kind: $key $(value $key)"
    done
    [ "$(value steps_climbed)" -gt 0 ] || fail "room.$kind: nobody climbed a voxel"
    [ -z "$hash" ] || [ "$(value state_hash)" = "$hash" ] || fail "the two files of one map differ"
    hash=$(value state_hash)
done
tahr run --level "$work/room.bt" --seconds 1
expect 2 "room.bt" "map of voxels" "native" "--backend fcl"
head -c 200 "$work/room.bt" >"$work/short.bt"
tahr run --level "$work/short.bt" --backend fcl --seconds 1
expect 2 "short.bt" "byte 200" "ends early"
tahr run --level "$work/none.bt" --backend fcl --seconds 1
expect 2 "none.bt" "cannot be opened"
finish
