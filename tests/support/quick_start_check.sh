#!/bin/sh
# quick_start_check.sh: compares standard input with the output that the README shows for its quick start; without one,
# with its form only. README: another file; CODE: the language of its blocks.
set -eu
got=$(cat)
want=$(awk -v want=output -v code="${CODE:-c}" -f tests/support/quick_start.awk "${README:-README.md}")
if [ -n "$want" ]; then
    [ "$got" = "$want" ] || { echo "quick start: got '$got', the README shows '$want'"; exit 1; }
else
    printf '%s\n' "$got" | grep -qxE '(walking|falling) at [0-9]+\.[0-9]{3} m' ||
        { echo "quick start: unexpected output '$got'"; exit 1; }
fi
echo "quick start: $got"
