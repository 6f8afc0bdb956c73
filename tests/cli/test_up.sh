#!/bin/sh
# SPDX-License-Identifier: MIT
# test_up.sh: Y up and Z up files of the same level, and a glTF with node transforms, are the same level.
. "$(dirname "$0")/support.sh"

# A floor of 20 x 20 m, and the same turned.
printf 'v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nf 1 2 3 4\n' >"$work/z.obj"
printf 'v -10 0 10\nv 10 0 10\nv 10 0 -10\nv -10 0 -10\nf 1 2 3 4\n' >"$work/y.obj"
tahr run --level "$work/z.obj" --up z --seconds 1 --json
expect 0
hash=$(value state_hash)
tahr run --level "$work/y.obj" --seconds 1 --json
[ "$(value state_hash)" = "$hash" ] || fail "Y up and Z up of the same level differ"

# The same as glTF: a square of 2 x 2 m, ten times larger by its node.
cat >"$work/square.gltf" <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"scale": [10, 10, 10], "children": [1]}, {"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
               {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
 "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AACAvwAAAAAAAIA/AACAPwAAAAAAAIA/AACAPwAAAAAAAIC/AACAvwAAAAAAAIC/AAABAAIAAAACAAMA"}]}
GLTF
tahr run --level "$work/square.gltf" --seconds 1 --json
expect 0
[ "$(value state_hash)" = "$hash" ] || fail "glTF with node transforms differs from the OBJ"
finish
