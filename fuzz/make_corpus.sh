#!/bin/sh
# SPDX-License-Identifier: MIT
# make_corpus.sh: writes the seeds of fuzz/corpus: short texts, of which every byte is a decision (see scene.c, tape.c).
# Run from the root of the sources. What fuzzers found lies beside them under names that begin with found_.
set -eu
seed() {
    mkdir -p "fuzz/corpus/$1"
    printf "$3" >"fuzz/corpus/$1/seed_$2"
}
# The words are read as numbers modulo small ones: any text is some scene, shape and way through it.
for target in steps engines; do
    seed $target empty ''
    seed $target plain 'a floor, and somebody who walks over it to the right and jumps twice before the end'
    seed $target boxes 'Qxyzzy boxes in a lattice: 0123456789 and again 9876543210, turned and touching, walked around for a while, up and down'
    seed $target mesh 'GGmesh of triangles that share their corners ABCDEFGHIJKLMNOPQRSTUVWXYZ abcdefghijklmnopqrstuvwxyz 0123456789 and so on and so forth, with holes'
    seed $target scaled '@@@@ tiny or huge, far or near: the same room again !!!! with a sensor, a lift and a pool of water ~~~~ and a swim through it'
    seed $target wild '\377\376\375 launches, drives and impulses \360\361\362\363\364\365\366\367 in all directions \340\350\370\377 until nothing is left'
done
seed liar honest '\003aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa'
seed liar mixed '\037whatever is asked, something else is answered: 0123456789 \377\376\375 and never the same twice \377\377'
seed liar overlaps '\001oooooooo~~~~nnnn////____oooo~~~~ in and out of walls that are not there \016\036\056 forever'
seed route walk '{"start": [0, 0, 1], "inputs": [{"time": 0, "move": [1, 0, 0]}, {"time": 1, "jump": true}]}'
seed route all '{"inputs": [{"time": 0, "facing": [0, 1, 0], "crouch": true, "launch": [0, 0, 5], "mode": "flying"}]}'
seed route broken '{"inputs": [{"time": -1, "move": [1, 0]}, 7, {"jump": "yes"}]}'
seed level quad 'zz\001\001\001\001\001\002\001\001\002\003\001\002\004\160\163\001\002\003\166\001\002\003\004'
seed level words 'yv 0 1 2 f 1 2 3 and much more of it, with bad numbers xyz and corners that there are not 0123456789'
seed level map '{"type":"map","version":"1.10","orientation":"orthogonal","width":2,"height":2,"tilewidth":16,"tileheight":16,"infinite":false,"tilesets":[],"layers":[{"type":"objectgroup","name":"solid","visible":true,"opacity":1,"x":0,"y":0,"id":1,"objects":[{"id":1,"x":0,"y":16,"width":32,"height":16,"rotation":0,"name":"","type":"","visible":true}]}]}'
seed trace text 'this is no trace, and the reader says at which byte that shows'
seed trace empty ''
echo "corpus: $(find fuzz/corpus -type f | wc -l) files"
