#!/bin/sh
# quick_start.sh: the quick start of the README, compiled as it stands and run against the library just built.
set -eu
if ! grep -q '^```c$' README.md 2>/dev/null; then
    echo "SKIP: house_quick_start: README.md has no C block"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
awk -f tests/support/quick_start.awk README.md >"$folder/quick_start.c"
flags=
if nm "$BUILD/lib/libtahr.a" | grep -q '__asan_'; then flags=-fsanitize=address,undefined; fi
# shellcheck disable=SC2086
"${CC:-cc}" -std=c11 -Wall -Wextra -Wpedantic -Werror $flags -Iinclude "$folder/quick_start.c" "$BUILD/lib/libtahr.a" -lm \
    -o "$folder/quick_start"
"$folder/quick_start" | sh tests/support/quick_start_check.sh
