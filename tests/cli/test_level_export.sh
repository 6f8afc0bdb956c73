#!/bin/sh
# SPDX-License-Identifier: MIT
# test_level_export.sh: `tahr level` writes the bundled level; `tahr run` reads it, and a user's Bullet world walks it.
. "$(dirname "$0")/support.sh"

tahr level "$work/playground.obj"
expect 0 triangles
count=$(sed -n 's/.*: \([0-9]*\) triangles/\1/p' "$work/out")
[ "$(grep -c '^f ' "$work/playground.obj")" = "$count" ] || fail "not $count faces in the file"
tahr run --level "$work/playground.obj" --characters 4 --seconds 2
expect 0

tahr level
expect 2 "usage: tahr level FILE.obj"
tahr level a b
expect 2 "usage: tahr level FILE.obj"
tahr level "$work/no/such/folder.obj"
expect 2 "cannot write" "folder.obj"

bullet=$(dirname "$TAHR")/../tests/example_bullet_playground
if [ -x "$bullet" ]; then
    "$bullet" "$work/playground.obj" >"$work/out" 2>&1 || fail "the Bullet example on the playground: $(cat "$work/out")"
    printf 'v 1 2 3\nf 1 2 3\n' >"$work/broken.obj"
    code=0
    "$bullet" "$work/broken.obj" >"$work/out" 2>"$work/err" || code=$?
    expect 2 "no triangles"
else
    echo "    SKIP: the Bullet example on the playground: it was not built"
fi
finish
