#!/bin/sh
# SPDX-License-Identifier: MIT
# make_corpus.sh: writes the seeds of fuzz/corpus: short texts, of which every byte is a decision (see scene.c, tape.c).
# Run from the root of the sources; set TAHR to the shell if it is not build/bin/tahr. What fuzzers found lies beside
# them under names that begin with found_.
set -eu
seed() {
    mkdir -p "fuzz/corpus/$1"
    printf "$3" >"fuzz/corpus/$1/seed_$2"
}
# The words are read as numbers modulo small ones: any text is some scene, shape and way through it.
for target in steps engines crowd; do
    seed $target empty ''
    seed $target plain 'a floor, and somebody who walks over it to the right and jumps twice before the end'
    seed $target boxes 'Qxyzzy boxes in a lattice: 0123456789 and again 9876543210, turned and touching, walked around for a while, up and down'
    seed $target mesh 'GGmesh of triangles that share their corners ABCDEFGHIJKLMNOPQRSTUVWXYZ abcdefghijklmnopqrstuvwxyz 0123456789 and so on and so forth, with holes'
    seed $target scaled '@@@@ tiny or huge, far or near: the same room again !!!! with a sensor, a lift and a pool of water ~~~~ and a swim through it'
    seed $target wild '\377\376\375 launches, drives and impulses \360\361\362\363\364\365\366\367 in all directions \340\350\370\377 until nothing is left'
done
# Of engines, two dimensions: the first byte modulo four is two.
seed engines flat_boxes 'r3 boxes, turned, on a lattice of a plane, and somebody with a skin who passes between them 0123456789 ABCDEFGHIJ'
seed engines flat_chains 'bA\002\004\010chains of a few corners \200\201\202\203 open and closed; who comes from behind is stopped too, zigzag 9876543210 !!!!'
seed crowd throng 'AAAA a throng of many who come ABCDEFG one by one 0123456 and go, are put elsewhere, into each other 6666 or out of order $$$$ and walk all the same to the end of all that is written here, some of them with a budget :::: and some of them without'
seed liar honest '\003aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa'
seed liar mixed '\037whatever is asked, something else is answered: 0123456789 \377\376\375 and never the same twice \377\377'
seed liar overlaps '\001oooooooo~~~~nnnn////____oooo~~~~ in and out of walls that are not there \016\036\056 forever'
seed route walk '{"start": [0, 0, 1], "inputs": [{"time": 0, "move": [1, 0, 0]}, {"time": 1, "jump": true}]}'
seed route all '{"inputs": [{"time": 0, "facing": [0, 1, 0], "crouch": true, "launch": [0, 0, 5], "mode": "flying"}]}'
seed route broken '{"inputs": [{"time": -1, "move": [1, 0]}, 7, {"jump": "yes"}]}'
seed level quad 'zz\001\001\001\001\001\002\001\001\002\003\001\002\004\160\163\001\002\003\166\001\002\003\004'
seed level words 'yv 0 1 2 f 1 2 3 and much more of it, with bad numbers xyz and corners that there are not 0123456789'

# Maps of Tiled: objects of every kind; tiles, turned and joined; an endless one, packed.
map() {
    mkdir -p fuzz/corpus/map
    cat >"fuzz/corpus/map/seed_$1"
}
printf '{"type":"map","width":2,"height":2,"tilewidth":16,"tileheight":16,"layers":[{"type":"objectgroup","objects":[{"x":0,"y":16,"width":32,"height":16}]}]}' | map small
map objects <<'END'
{"type":"map","orientation":"orthogonal","width":20,"height":8,"tilewidth":16,"tileheight":16,"properties":[{"name":"pixels_per_metre","type":"float","value":16}],
"tilesets":[{"firstgid":1,"tilecount":1,"tilewidth":16,"tileheight":16,"tiles":[{"id":0,"objectgroup":{"objects":[{"x":0,"y":0,"width":16,"height":16}]}}]}],
"layers":[{"type":"group","offsetx":0,"offsety":0,"layers":[{"type":"objectgroup","objects":[
{"type":"start","point":true,"x":24,"y":96},{"x":0,"y":112,"width":320,"height":16},
{"x":64,"y":112,"polygon":[{"x":0,"y":0},{"x":32,"y":-16},{"x":64,"y":0}]},{"type":"one_way","x":32,"y":80,"polyline":[{"x":0,"y":0},{"x":48,"y":0}]},
{"x":160,"y":96,"width":16,"height":16,"ellipse":true},{"x":200,"y":96,"width":24,"height":16,"ellipse":true,"rotation":30},
{"type":"water","x":240,"y":96,"width":32,"height":16},{"type":"sensor","name":"bell","x":120,"y":80,"width":16,"height":32},
{"type":"goal","x":300,"y":80,"width":16,"height":32},{"gid":2147483649,"x":16,"y":64,"width":32,"height":8,"rotation":45},
{"type":"mover","x":96,"y":64,"width":32,"height":8,"properties":[{"name":"swing_x","value":64},{"name":"period","value":4},{"name":"pause","value":1},{"name":"one_way","value":true}]},
{"x":280,"y":110,"width":16,"height":4,"properties":[{"name":"belt","value":2}]},{"text":{"text":"hello"},"name":"hello","x":8,"y":8}]}]}]}
END
map tiles <<'END'
{"type":"map","orientation":"orthogonal","width":4,"height":4,"tilewidth":16,"tileheight":16,"tilesets":[{"firstgid":1,"tilecount":5,"tilewidth":16,"tileheight":16,"tiles":[
{"id":0,"objectgroup":{"objects":[{"x":0,"y":0,"width":16,"height":16}]}},
{"id":1,"objectgroup":{"objects":[{"x":0,"y":0,"polygon":[{"x":0,"y":16},{"x":16,"y":0},{"x":16,"y":16}]}]}},
{"id":2,"type":"one_way","objectgroup":{"objects":[{"x":0,"y":0,"width":16,"height":4}]}},
{"id":3,"type":"water"},{"id":4,"properties":[{"name":"belt","value":-1.5},{"name":"solid","value":true}]}]}],
"layers":[{"type":"tilelayer","width":4,"height":4,"data":[0,0,3,3,0,2,1,2147483650,4,4,5,5,1,1,1073741826,1]},
{"type":"tilelayer","width":2,"height":2,"encoding":"base64","data":"AAAAAAIAAAABAAAAAQAAAA=="},
{"type":"imagelayer"},{"type":"tilelayer","class":"decoration","width":1,"height":1,"data":[1]}]}
END
map chunks <<'END'
{"type":"map","infinite":true,"width":0,"height":0,"tilewidth":8,"tileheight":8,"tilesets":[{"firstgid":1,"tilecount":3,"tilewidth":8,"tileheight":16,"tileoffset":{"x":0,"y":2},"tiles":[{"id":1,"type":"sensor"}]}],
"layers":[{"type":"tilelayer","properties":[{"name":"solid","value":true}],"encoding":"base64","compression":"zlib","offsetx":4,"chunks":[{"x":-4,"y":0,"width":4,"height":2,"data":"eNpjYGBgYITgBiYgzYzggzEAC0QAiw=="}]}]}
END
# Three bytes and more for each thing that is done to a recording: what, and to which message.
seed log whole ''
seed log losses '\000\000\020\000\001\030\001\000\150\002\000\002\000\000\377'
seed log lift '\000\000\122\000\001\101'
seed log first_event '\000\000\042\000\000\137'
seed log twice '\003\000\020\004\000\040\003\001\002\004\000\207'
seed log spoiled '\005\000\005\010\001\005\000\012\004\103\006\000\100\013\377\006\000\001\022\020'
seed log damaged '\007\000\000\000\100\000\252\001\000\020\377\000\377\000\000'
seed trace text 'this is no trace, and the reader says at which byte that shows'
seed trace empty ''
# A walk of three steps, if the shell was built: a trace is of one version of the structs in it.
tahr=${TAHR:-build/bin/tahr}
if [ -x "$tahr" ]; then
    folder=$(mktemp -d)
    printf 'v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3\nf 1 3 4\n' >"$folder/floor.obj"
    "$tahr" run --level "$folder/floor.obj" --up z --characters 1 --seconds 0.05 --trace fuzz/corpus/trace/seed_walk >/dev/null
    "$tahr" run --characters 1 --seconds 0.03 --trace fuzz/corpus/trace/seed_playground >/dev/null
    rm -r "$folder"
else
    echo "corpus: $tahr is not built, the recorded traces stay as they are"
fi
echo "corpus: $(find fuzz/corpus -type f | wc -l) files"
