#!/bin/sh
# state_diagram.sh [--print]: the README's state diagram is the table of transitions in src/modes.c, line by line.
# --print: shows what should stand in the README. Run from the root of the sources.
set -eu

diagram() {
    printf 'stateDiagram-v2\n    [*] --> falling\n'
    sed -n 's/^    {TAHR_MODE_\([A-Z]*\), TAHR_MODE_\([A-Z]*\), "\([^"]*\)"},$/\1 \2 \3/p' src/modes.c |
        while read -r from to why; do
            printf '    %s --> %s: %s\n' "$(echo "$from" | tr A-Z a-z)" "$(echo "$to" | tr A-Z a-z)" "$why"
        done
}

wanted=$(diagram)
[ "$(printf '%s\n' "$wanted" | wc -l)" -gt 8 ] || { echo "no transitions found in src/modes.c"; exit 1; }
if [ "${1:-}" = --print ]; then
    printf '%s\n' "$wanted"
    exit 0
fi
found=$(awk '/^```mermaid$/ { inside = 1; next } /^```$/ { inside = 0 } inside' README.md)
if [ "$wanted" != "$found" ]; then
    echo "README.md shows another state diagram than src/modes.c has (sh tests/state_diagram.sh --print):"
    printf '%s\n' "$wanted" >"${TMPDIR:-/tmp}/wanted.$$"
    printf '%s\n' "$found" | diff - "${TMPDIR:-/tmp}/wanted.$$" || true
    rm -f "${TMPDIR:-/tmp}/wanted.$$"
    exit 1
fi
