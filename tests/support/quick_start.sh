#!/bin/sh
# quick_start.sh: the C blocks of the README: the quick start, compiled as it stands and run against the library just
# built, and the level geometry and the telemetry, within the few declarations that they leave to the reader.
set -eu
if ! grep -q '^```c$' README.md 2>/dev/null; then
    echo "SKIP: house_quick_start: README.md has no C block"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags=
more=
if nm "$BUILD/lib/libtahr.a" | grep -q '__asan_'; then flags=-fsanitize=address,undefined; fi
build() {
    # shellcheck disable=SC2086
    "${CC:-cc}" -std=c11 -Wall -Wextra -Wpedantic -Werror $flags -Iinclude "$@" "$BUILD/lib/libtahr.a" -lm $more -o "$folder/program"
}
awk -f tests/support/quick_start.awk README.md >"$folder/quick_start.c"
build "$folder/quick_start.c"
"$folder/program" | sh tests/support/quick_start_check.sh

awk -v block=2 -f tests/support/quick_start.awk README.md >"$folder/level.inc"
if [ -s "$folder/level.inc" ]; then
    build -DREADME_LEVEL="\"$folder/level.inc\"" tests/support/quick_start/level.c
    "$folder/program"
fi

# The first block is the quick start, the second the level geometry, the third the trace.
awk -v block=4 -f tests/support/quick_start.awk README.md >"$folder/telemetry.inc"
if [ -e "$BUILD/lib/libtahr_lcm.a" ]; then
    more="-llcm -pthread"
    build -DREADME_TELEMETRY="\"$folder/telemetry.inc\"" tests/support/quick_start/telemetry.c \
        "$BUILD/lib/libtahr_lcm.a" "$BUILD/lib/libtahr_threads.a"
    LCM_DEFAULT_URL=memq:// "$folder/program"
fi
