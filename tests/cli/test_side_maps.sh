#!/bin/sh
# SPDX-License-Identifier: MIT
# test_side_maps.sh: what Tiled can write is read alike: lists, base64, packed base64, chunks, tilesets in files of
# their own, flipped tiles, groups, objects; and a row of 1000 separate tiles is run over at full speed.
. "$(dirname "$0")/support.sh"
. "$(dirname "$0")/side_map.sh"

printf '[{"time": 0, "move": [1, 0]}]' >"$work/right.json"

# run_right FILE OPTIONS...: runs to the right from the start for a second; $got: where the centre is at the end.
run_right() {
    file=$1
    shift
    rm -f "$work/a.csv"
    tahr run --2d --level "$file" --route "$work/right.json" --seconds 1 --check all --csv "$work/a.csv" --json "$@"
    expect 0
    got=$(tail -n 1 "$work/a.csv" | cut -d, -f4,5)
}

# A run of t seconds from rest at acceleration a = 40 m/s2 to v = 5 m/s goes v t - v^2 / 2 a = 5 t - 0.3125 m.
map 1010 4 "$(tiles 1010 4 "$(floor 1010)"), $start" >"$work/row.tmj"
backends all >"$work/backends"
while read -r backend; do
    for shape in capsule box; do
        for rate in 30 60 144; do
            tahr run --2d --level "$work/row.tmj" --tiles separate --route "$work/right.json" --seconds 200 --check off \
                --backend "$backend" --shape $shape --rate $rate --csv "$work/a.csv" --json
            expect 0
            [ "$(value bodies)" = 1010 ] || fail "$(value bodies) bodies instead of 1010"
            tail -n 1 "$work/a.csv" | awk -F, '{ exit !($4 > 1.5 + 0.999 * 999.6875 && $4 < 1.5 + 999.6885) }' ||
                fail "$backend $shape $rate Hz: got to $(tail -n 1 "$work/a.csv")"
            grep -q "hit@" "$work/a.csv" && fail "$backend $shape $rate Hz: hit something on a flat row"
        done
        case $backend in native | box2d) ;; *) break ;; esac # the others are slow: one shape of them, at the last rate
    done
done <"$work/backends"
tahr run --2d --level "$work/row.tmj" --route "$work/right.json" --seconds 1 --json
[ "$(value bodies)" = 1 ] || fail "1010 neighbours were joined to $(value bodies) bodies"

# The same floor of 8 tiles, 4 bytes each, in every way it can be written.
map 8 4 "$(tiles 8 4 "$(floor 8)"), $start" >"$work/list.tmj"
run_right "$work/list.tmj"
plain=$got
[ "${plain%,*}" = 6.1875 ] || fail "ended at $plain instead of 1.5 + 5 - 0.3125"
same() {
    run_right "$1"
    [ "$got" = "$plain" ] || fail "$1: ended at $got instead of $plain"
}
zeros=AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA # 48 bytes
ones=AQAAAAEAAAABAAAAAQAAAAEAAAABAAAAAQAAAAEAAAA=                      # 8 numbers 1
map 8 4 "$(tiles 8 4 "\"$zeros$zeros$ones\"" '"encoding": "base64", "compression": "",'), $start" >"$work/base64.tmj"
same "$work/base64.tmj"
if command -v python3 >/dev/null 2>&1; then
    for kind in zlib gzip; do
        python3 -c "import base64, gzip, sys, zlib
data = b'\0' * 96 + b'\1\0\0\0' * 8
print(base64.b64encode((zlib if sys.argv[1] == 'zlib' else gzip).compress(data)).decode())" $kind >"$work/packed"
        map 8 4 "$(tiles 8 4 "\"$(cat "$work/packed")\"" "\"encoding\": \"base64\", \"compression\": \"$kind\","), $start" \
            >"$work/packed.tmj"
        tahr run --2d --level "$work/packed.tmj" --seconds 0.1 --characters 1
        if [ "$code" = 2 ]; then
            expect 2 "without zlib"
            echo "SKIP: cli_side_maps: packed layers: this shell was built without zlib"
        else
            same "$work/packed.tmj"
        fi
    done
else
    echo "SKIP: cli_side_maps: packed layers: python3 is not there to pack one"
fi
printf '{"type": "tileset", %s' "${tileset#\{\"firstgid\": 1, }" >"$work/set.tsj"
map 8 4 "$(tiles 8 4 "$(floor 8)"), $start" '{"firstgid": 1, "source": "set.tsj"}' >"$work/external.tmj"
same "$work/external.tmj"
map 8 4 "{\"type\": \"group\", \"layers\": [$(tiles 8 4 "$(floor 8)")]}, $start" >"$work/group.tmj"
same "$work/group.tmj"
map 8 4 "{\"type\": \"objectgroup\", \"objects\": [{\"x\": 0, \"y\": 48, \"width\": 128, \"height\": 16}]}, $start" \
    >"$work/object.tmj"
same "$work/object.tmj"
map 8 4 "{\"type\": \"objectgroup\", \"objects\": [{\"x\": 0, \"y\": 64, \"width\": 128, \"height\": 16, \"gid\": 1}]},
    $start" >"$work/tile_object.tmj"
same "$work/tile_object.tmj"
map 8 4 "{\"type\": \"objectgroup\", \"objects\": [{\"x\": 0, \"y\": 64, \"width\": 16, \"height\": 128,
    \"rotation\": 270}, {\"x\": 0, \"y\": 48, \"width\": 20, \"height\": 9}]}, $start" >"$work/turned.tmj"
same "$work/turned.tmj"
map 8 4 "$(tiles 8 4 "$(floor 8)" '"class": "solid",'), $start" \
    '{"firstgid": 1, "tilecount": 1, "tilewidth": 16, "tileheight": 16}' >"$work/class.tmj"
same "$work/class.tmj"
# Pixels of 8 to the metre: everything is twice as large, and the run as long as before.
map 8 4 "$(tiles 8 4 "$(floor 8)"), $start" "" '"properties": [{"name": "pixels_per_metre", "value": 8}],' \
    >"$work/large.tmj"
run_right "$work/large.tmj"
[ "${got%,*}" = 7.6875 ] || fail "pixels_per_metre of the map does not count"
run_right "$work/large.tmj" --pixels-per-metre 16
[ "${got%,*}" = 6.1875 ] || fail "--pixels-per-metre does not count"
# An endless map: chunks, and y = 0 where Tiled has it.
map 8 4 "{\"type\": \"tilelayer\", \"width\": 8, \"height\": 4, \"chunks\": [{\"x\": -2, \"y\": 3, \"width\": 4,
    \"height\": 1, \"data\": [1, 1, 1, 1]}, {\"x\": 2, \"y\": 3, \"width\": 8, \"height\": 1, \"data\": [1, 1, 1, 1, 1, 1,
    1, 1]}]}, $start" "" '"infinite": true,' >"$work/chunks.tmj"
run_right "$work/chunks.tmj"
[ "${got%,*}" = 6.1875 ] || fail "over chunks it ended at $got"
[ "$(value bodies)" = 1 ] || fail "chunks were not joined: $(value bodies) bodies"
# A collection of images: each tile is as large as its own, and numbers of images that were taken out are free.
images='{"firstgid": 1, "tilecount": 2, "columns": 0, "tilewidth": 48, "tileheight": 64, "tiles": [
    {"id": 2, "image": "large.png", "imagewidth": 48, "imageheight": 64},
    {"id": 7, "image": "small.png", "imagewidth": 16, "imageheight": 16}]}'
map 8 4 "$(tiles 8 4 "$(floor 8 | sed 's/1/8/g')" '"class": "solid",'), $start" "$images" >"$work/images.tmj"
same "$work/images.tmj"
# A tile object that its tileset holds by the upper left corner; and what is none of ours, whatever form it has.
map 8 4 "{\"type\": \"objectgroup\", \"objects\": [{\"gid\": 1, \"x\": 0, \"y\": 48, \"width\": 128, \"height\": 16},
    {\"type\": \"enemy\", \"x\": 40, \"y\": 40, \"width\": 0, \"height\": 0},
    {\"type\": \"enemy\", \"x\": 40, \"y\": 40, \"width\": 8, \"height\": 16, \"capsule\": true}]}, $start" \
    "{\"objectalignment\": \"topleft\", ${tileset#\{}" >"$work/objects.tmj"
same "$work/objects.tmj"
# A ramp of 45 degrees: walked up as it is, and flipped along its diagonal (bit 29), which leaves it as it is; a wall
# where it is flipped left to right (bit 31).
for flip in 0 2147483648 536870912; do
    map 8 4 "$(tiles 8 4 "[0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0, 0,0,0,$((flip + 2)),0,0,0,0, 1,1,1,1,1,1,1,1]"), $start" \
        >"$work/flip.tmj"
    run_right "$work/flip.tmj"
    if [ "$flip" = 2147483648 ]; then
        awk -v x="${got%,*}" 'BEGIN { exit !(x > 2.6399 && x < 2.6401) }' ||
            fail "not stopped by the wall that a flipped ramp is, a radius and a skin before it: $got"
    else
        awk -F, '$5 > top { top = $5 } END { exit !(top > 2.5) }' "$work/a.csv" || fail "did not walk up ramp $flip: $got"
    fi
done
finish
