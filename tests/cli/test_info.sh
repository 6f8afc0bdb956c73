#!/bin/sh
# SPDX-License-Identifier: MIT
# test_info.sh: help, version and info say what they should.
. "$(dirname "$0")/support.sh"

tahr help
expect 0 "usage: tahr" "run" "info"
tahr
expect 2 "usage: tahr"
tahr --version
expect 0 "tahr 0.1.0"
tahr run --help
expect 0 --level --up --characters --seconds --rate --seed --preset --backend --route --csv --plot --check --json "native"
tahr help run
expect 0 --level

tahr info
expect 0 "ABI 0.1" "native" "capsule" "mesh" "precise"
tahr info --json
expect 0 '"version": "0.1.0"' '"native"' '"bit_identical"'
is_json || fail "info --json is no JSON"
tahr info --nonsense
expect 2 "--nonsense"
tahr info --json more
expect 2 "more"

# Of a level: one triangle mesh of two triangles in a file of ours, Y up.
printf 'v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\nf 1 2 3\nf 1 3 4\n' >"$work/two.obj"
tahr info --level "$work/two.obj"
expect 0 "level 'two.obj', hash " "native, 3D" "1 static bodies" "body 0: "
tahr info --level "$work/two.obj" --json --backend native
expect 0 '"scene"' "native, 3D"
is_json || fail "info --level --json is no JSON"
tahr info --up=z --level="$work/two.obj" --backend native
expect 0 "1 static bodies"
# Without a file it is a bundled level, as of run.
tahr info --backend native
expect 0 "native, 3D" "meshes" "boxes"
tahr info --2d
expect 0 "native, 3D" "spheres" "two dimensions" "one outline, without seams" "drawn out along z"
tahr info --2d --json
expect 0 '"scene"'
is_json || fail "info --2d --json is no JSON"
tahr info --backend ccd
case $code in 0) expect 0 "ccd, 3D" "path: the tree of bodies" ;; *) expect 2 ccd ;; esac
tahr info --2d --level "$here/../../bindings/cli/levels/side.tmj" --tiles separate
expect 0 "native, 3D" "a body each (--tiles separate)"
tahr info --level "$here/../../bindings/cli/levels/side.tmj"
expect 2 "side.tmj" "--2d"
tahr info --tiles separate
expect 2 "--tiles" "--2d"
tahr info --2d --up z
expect 2 "--up z"
tahr info --backend
expect 2 "--backend"
tahr info --backend nosuch
expect 2 "nosuch"
tahr info --level "$work/nowhere.obj"
expect 2 "nowhere.obj"
tahr info --level "$work/two.obj" --characters 3
expect 2 "--characters"

# Every command explains itself, in both ways; a command that does not exist has no help.
for command in run replay level info selftest; do
    tahr help $command
    expect 0 "usage: tahr $command"
    cp "$work/out" "$work/help"
    tahr $command --help
    expect 0
    cmp -s "$work/out" "$work/help" || fail "'tahr $command --help' differs from 'tahr help $command'"
done
tahr help fly
expect 2 "unknown command 'fly'"
tahr --version loud
expect 2 "loud"
tahr level side.tmj tour.json
expect 2 "tour.json"
if [ -w /dev/full ]; then
    for arguments in "level side.tmj" info help; do
        code=0
        "$TAHR" $arguments >/dev/full 2>"$work/err" || code=$?
        expect 1 "cannot write to standard output"
    done
fi
finish
