#!/bin/sh
# SPDX-License-Identifier: MIT
# test_level_export.sh: `tahr level` writes the bundled level; `tahr run` reads it, and a user's Bullet world walks it.
. "$(dirname "$0")/support.sh"

tahr level playground.obj
expect 0 "playground"
cp "$work/out" "$work/playground.obj"
[ "$(grep -c '^v ' "$work/playground.obj")" = "$((3 * $(grep -c '^f ' "$work/playground.obj")))" ] || fail "not three corners a face"
tahr run --level "$work/playground.obj" --characters 4 --seconds 2
expect 0

bullet=$(dirname "$TAHR")/../tests/example_bullet_playground
if [ -x "$bullet" ]; then
    "$bullet" "$work/playground.obj" >"$work/out" 2>&1 || fail "the Bullet example on the playground: $(cat "$work/out")"
    printf 'v 1 2 3\nf 1 2 3\n' >"$work/broken.obj"
    code=0
    "$bullet" "$work/broken.obj" >"$work/out" 2>"$work/err" || code=$?
    expect 2 "no triangles"
else
    echo "SKIP: cli_level_export: the Bullet example was not built"
fi
finish
