# SPDX-License-Identifier: MIT
# side_map.sh: small maps of Tiled for the tests of --2d, put together from parts.

full='{"id": 0, "objectgroup": {"objects": [{"x": 0, "y": 0, "width": 16, "height": 16}]}}'
ramp='{"id": 1, "objectgroup": {"objects": [{"x": 0, "y": 0, "width": 0, "height": 0,
       "polygon": [{"x": 0, "y": 16}, {"x": 16, "y": 0}, {"x": 16, "y": 16}]}]}}'
plank='{"id": 2, "type": "one_way", "objectgroup": {"objects": [{"x": 0, "y": 0, "width": 16, "height": 4}]}}'
tileset="{\"firstgid\": 1, \"tilecount\": 3, \"tilewidth\": 16, \"tileheight\": 16, \"tiles\": [$full, $ramp, $plank]}"
start='{"type": "objectgroup", "objects": [{"type": "start", "point": true, "x": 24, "y": 48}]}'

# map WIDTH HEIGHT LAYERS [TILESETS] [MORE KEYS]: a map of tiles of 16 pixels, which are a metre.
map() {
    printf '{"type": "map", "orientation": "orthogonal", "width": %s, "height": %s, "tilewidth": 16, "tileheight": 16,%s
 "layers": [%s],\n "tilesets": [%s]}\n' "$1" "$2" "${5:-}" "$3" "${4:-$tileset}"
}

# tiles WIDTH HEIGHT DATA [MORE KEYS]: a tile layer.
tiles() {
    printf '{"type": "tilelayer", "width": %s, "height": %s,%s "data": %s}' "$1" "$2" "${4:-}" "$3"
}

# floor WIDTH: four rows, the lowest full.
floor() {
    awk -v n="$1" 'BEGIN { printf "["; for (i = 0; i < 4 * n; i++) printf "%s%d", (i ? "," : ""), (i >= 3 * n); printf "]" }'
}
