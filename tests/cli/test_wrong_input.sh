#!/bin/sh
# SPDX-License-Identifier: MIT
# test_wrong_input.sh: wrong usage ends with code 2 and a message that names the option and the value.
. "$(dirname "$0")/support.sh"

# usage MESSAGE-WORD MESSAGE-WORD ARGUMENTS...
usage() {
    first=$1
    second=$2
    shift 2
    tahr "$@"
    expect 2 "$first" "$second"
    [ -s "$work/out" ] && fail "tahr $*: wrote to standard output"
}

usage walk "unknown command" walk
usage --nonsense "unknown option" run --nonsense
usage --level "unknown option" run --nonsense
usage --plt "unknown option" run --plt=x
usage --level "needs a value" run --level
usage somewhere "unexpected argument" run somewhere
for number in 0 -1 1.5 x "" 100001 99999999999999999999; do
    usage --characters "'$number'" run --characters "$number"
done
for number in 0 -1 nan inf -inf x "" 1e99 5s; do
    usage --rate "'$number'" run --rate "$number"
    usage --seconds "'$number'" run --seconds "$number"
done
usage --seed "'-3'" run --seed -3
usage --seed "'1x'" run --seed 1x
usage "--preset 'sloppy'" precise run --preset sloppy
usage "--backend 'bullet'" native run --backend bullet
usage "--backend 'bullet'" "path of a shared object" run --backend bullet
usage "--check 'some'" sampled run --check some
usage "--up 'x'" "y or z" run --level nowhere.obj --up x
usage --up playground run --up y
usage --plot .svg run --plot picture.jpg
usage --plot .svg run --plot svg
usage "--characters 3" --route run --characters 3 --route nowhere.json
usage "$work/same.svg" "both write" run --csv "$work/same.svg" --plot "$work/same.svg"

# Files that cannot be written are found out before the run and left as they are.
usage "--csv '$work/none/a.csv'" "No such file" run --csv "$work/none/a.csv"
usage "--plot '$work/none/a.svg'" "No such file" run --plot "$work/none/a.svg"
usage "--csv '$work'" "directory" run --csv "$work"
echo kept >"$work/kept.csv"
usage "$work/nowhere.obj" "No such file" run --csv "$work/kept.csv" --level "$work/nowhere.obj"
[ "$(cat "$work/kept.csv")" = kept ] || fail "a run that could not start emptied the file of --csv"

# A full disk is noticed.
if [ -w /dev/full ]; then
    tahr run --seconds 1 --csv /dev/full
    expect 1 "--csv" "/dev/full" "No space"
fi

# Levels.
: >"$work/empty.obj"
echo 'not a level' >"$work/text.txt"
printf 'glTF\002\000\000\000\377\377\377\377junk' >"$work/broken.glb"
echo '{ "asset": {"version": "2.0"}, "meshes": 7 }' >"$work/broken.gltf"
printf 'v 0 0 0\nv 1 0 0\n' >"$work/no_faces.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 9\n' >"$work/bad_index.obj"
printf 'v 0 0 0\nv nan 0 0\nv 0 0 1\nf 1 2 3\n' >"$work/nan.obj"
printf 'v 0 0 0\nv 1e30 0 0\nv 0 0 1\nf 1 3 2\n' >"$work/far.obj"
printf 'v 0 0 0\nv 0 9 0\nv 0 0 9\nv 0 9 9\nf 1 2 4 3\n' >"$work/wall.obj"
for level in empty.obj text.txt broken.glb broken.gltf no_faces.obj bad_index.obj nan.obj far.obj; do
    usage "$work/$level" "$level" run --seconds 0.1 --level "$work/$level"
done
usage "$work" directory run --level "$work"
usage wall.obj "no walkable place" run --seconds 0.1 --level "$work/wall.obj"

# Routes.
route() {
    words=$1
    printf '%s' "$2" >"$work/route.json"
    usage "$work/route.json" "$words" run --seconds 0.1 --route "$work/route.json"
}
usage "$work/none.json" "No such file" run --route "$work/none.json"
route "line 1" '[{"time": 0,]'
route "expected a list" '{"start": [0, 0, 1]}'
route "at least one" '[]'
route "'begin'" '{"begin": [0, 0, 1], "inputs": [{"time": 0}]}'
route "'start'" '{"start": [0, 0], "inputs": [{"time": 0}]}'
route "inputs[1]" '[{"time": 0}, 7]'
route "'time'" '[{"move": [1, 0, 0]}]'
route "inputs[1], key 'time'" '[{"time": 1}, {"time": 0.5}]'
route "'time'" '[{"time": "now"}]'
route "'time'" '[{"time": -1}]'
route "inputs[0], key 'move'" '[{"time": 0, "move": [1, 0]}]'
route "'move'" '[{"time": 0, "move": [1, 0, "up"]}]'
route "'jump'" '[{"time": 0, "jump": 1}]'
route "'crawl'" '[{"time": 0, "crawl": true}]'
finish
