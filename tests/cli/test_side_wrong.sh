#!/bin/sh
# SPDX-License-Identifier: MIT
# test_side_wrong.sh: a broken map of Tiled ends with code 2 and a message that names the file, the place in it and what
# was expected.
. "$(dirname "$0")/support.sh"
. "$(dirname "$0")/side_map.sh"

# wrong WORDS WORDS...: the map on standard input is refused with these words.
wrong() {
    cat >"$work/map.tmj"
    tahr run --2d --level "$work/map.tmj" --seconds 0.1 --characters 1
    expect 2 "$work/map.tmj" "$@"
    [ -s "$work/out" ] && fail "$*: wrote to standard output"
}

good=$(tiles 4 4 "$(floor 4)")
map 4 4 "$good, $start" >"$work/good.tmj"
tahr run --2d --level "$work/good.tmj" --seconds 0.1 --characters 1
expect 0

# No JSON, or not all of it: line and column.
tahr run --2d --level "$work/none.tmj" --seconds 0.1
expect 2 "$work/none.tmj" "No such file"
tahr run --2d --level "$work" --seconds 0.1
expect 2 "$work" "is a folder"
: | wrong "line 1" "near end of file"
head -c 300 "$work/good.tmj" | wrong "line " "column "
printf '<?xml version="1.0"?>\n<map/>\n' | wrong "XML" ".tmj"
sed 's/"tilewidth": 16/"tilewidth": NaN/' "$work/good.tmj" | wrong "line 1, column" "NaN"
printf '{"layers": [],\n "layers": []}' | wrong "line 2" "duplicate"

# Another thing, or a part missing.
echo '[]' | wrong "expected a map of Tiled"
echo '{"type": "tileset", "tilewidth": 16}' | wrong "expected a map of Tiled"
map 4 4 "" | wrong "holds nothing to stand on"
sed 's/"layers"/"layer"/' "$work/good.tmj" | wrong "missing layers"
sed 's/"layers": \[/"layers": [7, /' "$work/good.tmj" | wrong "layers[0]" "expected a layer"
for orientation in isometric staggered hexagonal; do
    sed "s/\"orthogonal\"/\"$orientation\"/" "$work/good.tmj" | wrong "'$orientation'" "expected orthogonal"
done
for key in tilewidth tileheight height; do
    sed "1s/\"$key\": [0-9]*/\"$key\": \"many\"/" "$work/good.tmj" | wrong "$key" "expected a number"
done
sed '1s/"tilewidth": 16/"tilewidth": 0/' "$work/good.tmj" | wrong tilewidth "from 1"
map 4 4 '{"type": "wall"}' | wrong "layers[0]" "'wall'" "expected tilelayer"
map 4 4 '{"type": "objectgroup"}' | wrong "layers[0].objects" "missing"
map 4 4 '{"type": "group", "layers": 3}' | wrong "layers[0]" "expected a list"
awk 'BEGIN { for (i = 0; i < 40; i++) a = a "{\"type\": \"group\", \"layers\": ["; for (i = 0; i < 40; i++) b = b "]}"; print a b }' \
    >"$work/deep"
map 4 4 "$(cat "$work/deep")" | wrong "nested deeper"

# Tile layers.
map 4 4 "$(tiles 4 4 '[1, 1, 1]')" | wrong "layers[0]" "3 numbers" "expected 16"
map 4 4 "$(tiles 4 4 '[]')" | wrong "0 numbers" "expected 16"
map 4 4 "$(tiles 4 1 '[1, 1.5, 1, 1]')" | wrong "data[1]" "whole number"
map 4 4 "$(tiles 4 1 '[1, -1, 1, 1]')" | wrong "data[1]" "whole number"
map 4 4 "$(tiles 4 1 '[1, "x", 1, 1]')" | wrong "data[1]" "whole number"
map 4 4 "$(tiles 4 1 '[1, 1, 99, 1]')" | wrong "layers[0].data[2]" "tile 99" "1 to 3"
map 4 4 "$(tiles 0 1 '[]')" | wrong "layers[0].width" "from 1"
map 4 4 "$(tiles 4000 4000 '[]')" | wrong "4000 by 4000" "at most"
map 4 4 '{"type": "tilelayer", "width": 4, "height": 4}' | wrong "layers[0]" "missing data"
map 4 4 "$(tiles 4 1 '"AAAA"')" | wrong "data" "expected a list"
map 4 4 "$(tiles 4 1 '[1, 1, 1, 1]' '"encoding": "base64",')" | wrong "data" "expected a text"
map 4 4 "$(tiles 4 1 '"AQAAAAEA"' '"encoding": "base64",')" | wrong "6 bytes" "expected 16"
map 4 4 "$(tiles 4 1 '"AQ!AAA=="' '"encoding": "base64",')" | wrong "character 3" "no base64"
map 4 4 "$(tiles 4 1 '"AAAA"' '"encoding": "morse",')" | wrong "encoding 'morse'" "csv or base64"
map 4 4 "$(tiles 4 1 '"AAAA"' '"encoding": "base64", "compression": "zstd",')" | wrong "compression 'zstd'" "zlib"
map 4 4 "$(tiles 4 1 '"AAAA"' '"encoding": "base64", "compression": "zlib",')" | wrong "layers[0]"
map 4 4 '{"type": "tilelayer", "chunks": [{"x": 0, "y": 0, "width": 2, "height": 1, "data": [1]}]}' |
    wrong "layers[0].chunks[0]" "1 numbers" "expected 2"
map 4 4 '{"type": "tilelayer", "chunks": [{"x": 0, "y": -0.5, "width": 1, "height": 1, "data": [1]}]}' |
    wrong "layers[0].chunks[0]" "y -0.5" "expected a whole number"
map 4 4 '{"type": "tilelayer", "chunks": 5}' | wrong "chunks" "expected a list"

# Tilesets.
map 4 4 "$good" '{"firstgid": 0}' | wrong "tilesets[0].firstgid" "from 1"
map 4 4 "$good" '{"firstgid": 1}' | wrong "tilesets[0].tilecount" "missing"
map 4 4 "$good" '{"firstgid": 1, "tilecount": 2, "tilewidth": 16, "tileheight": 16, "tiles": {}}' | wrong "tiles" "a list"
map 4 4 "$good" '{"firstgid": 1, "tilecount": 2, "tilewidth": 16, "tileheight": 16, "tiles": [{"id": 2}]}' |
    wrong "tilesets[0].tiles[0].id" "0 to 1"
map 4 4 "$good" '{"firstgid": 1, "tilecount": 2, "tilewidth": 16, "tileheight": 16}' | wrong "collision shape"
map 4 4 "$good" '{"firstgid": 1, "source": "none.tsj"}' >"$work/map.tmj"
tahr run --2d --level "$work/map.tmj" --seconds 0.1
expect 2 "$work/none.tsj" "No such file"
mkdir "$work/none.tsj"
tahr run --2d --level "$work/map.tmj" --seconds 0.1
expect 2 "$work/none.tsj" "is a folder"
rmdir "$work/none.tsj"
echo '<tileset/>' >"$work/none.tsj"
tahr run --2d --level "$work/map.tmj" --seconds 0.1
expect 2 "$work/none.tsj" "XML" ".tsj"
echo '{"tilecount": "two"}' >"$work/none.tsj"
tahr run --2d --level "$work/map.tmj" --seconds 0.1
expect 2 "$work/none.tsj" "tilecount" "expected a number"

# Objects.
object() {
    object=$1
    shift
    map 4 4 "$good, {\"type\": \"objectgroup\", \"objects\": [$object]}" | wrong "layers[1].objects[0]" "$@"
}
object 7 "expected an object"
object '{"y": 0, "width": 1, "height": 1}' "x: missing"
object '{"x": 1e9, "y": 0, "width": 1, "height": 1}' ".x" "from -4e+06"
object '{"x": 0, "y": 0, "width": 0, "height": 0}' "above 0"
object '{"x": 0, "y": 0, "polygon": [{"x": 0, "y": 0}, {"x": 1, "y": 0}]}' "at least 3 points"
object '{"x": 0, "y": 0, "polygon": [{"x": 0, "y": 0}, {"x": 1, "y": 0}, {"x": 2, "y": 0}]}' "without area"
object '{"x": 0, "y": 0, "polyline": [{"x": 0, "y": 0}, {"x": "one", "y": 0}]}' "polyline[1].x" "expected a number"
object '{"x": 0, "y": 0, "template": "a.tx"}' "template"
object '{"x": 0, "y": 0, "capsule": true, "width": 1, "height": 2}' "capsule"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "properties": [{"name": "one_way", "value": "yes"}]}' "true or false"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "properties": [{"name": "period", "value": 0}]}' "period" "from 0.01"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "properties": {"one_way": true}}' "expected a list"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "properties": [{"value": 1}]}' "without a name"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "type": "mover", "properties": [{"name": "period", "value": 2},
    {"name": "pause", "value": 1}]}' "pause" "less than half"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "ellipse": true, "type": "mover"}' "mover" "rectangle"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "ellipse": true, "type": "water"}' "rectangle"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "ellipse": true, "type": "one_way"}' "polyline"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "type": "start"}' "start" "expected a point"
object '{"x": 0, "y": 0, "width": 9, "height": 9, "gid": 77}' "tile 77"

# Options.
usage() {
    words=$1
    shift
    tahr run "$@"
    expect 2 "$words"
}
usage "only with --2d" --tour
usage "only with --2d" --tiles separate
usage "only with --2d" --pixels-per-metre 16
usage "expected joined or separate" --2d --tiles apart
usage "'0'" --2d --pixels-per-metre 0
usage "capsule, box or sphere" --2d --shape cube
usage "--up z" --2d --level "$work/good.tmj" --up z
usage "neither --level nor --route" --2d --tour --level "$work/good.tmj"
usage "drives one character" --2d --tour --characters 2
backends plane | while read -r backend; do
    tahr run --backend "$backend" --seconds 0.1
    expect 2 "expected --2d"
done
tahr run --preset platformer
expect 2 "--preset platformer" "--2d"
tahr run --level "$work/map.tmj"
expect 2 "$work/map.tmj" "--2d"

tahr level nonsense
expect 2 "'nonsense'" side.tmj

# Routes.
route() {
    printf '%s' "$2" >"$work/route.json"
    usage "$1" --2d --seconds 0.1 --route "$work/route.json"
}
route "one of time, after" '[{"time": 0, "after": 1}]'
route "'after'" '[{"after": -1}]'
route "'at_x'" '[{"at_x": "far"}]'
route "'drop'" '[{"time": 0, "drop": 1}]'
route "two numbers" '[{"time": 0, "move": [1]}]'
finish
