#!/bin/sh
# no_cxx.sh: everything that is shipped configures and builds where there is no C++ compiler. Unoptimised: it is about what
# the build asks for.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
generator=
if command -v ninja >/dev/null 2>&1; then generator="-G Ninja"; fi
log() {
    "$@" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
}
# What the build at hand has must be had here too, so that nothing drops out unseen.
parts=
for part in TAHR_BACKEND_CCD TAHR_CLI; do
    case $part in
    TAHR_BACKEND_CCD) made=$BUILD/lib/libtahr_ccd.a ;;
    TAHR_CLI) made=$BUILD/bin/tahr ;;
    esac
    if [ -f "$made" ]; then parts="$parts -D$part=ON"; fi
done
# shellcheck disable=SC2086
log env CXX=/nonexistent cmake -S . -B "$folder/build" $generator $parts -DCMAKE_C_COMPILER="${CC:-cc}" \
    -DCMAKE_CXX_COMPILER=/nonexistent -DCMAKE_BUILD_TYPE=Debug -DTAHR_TESTS=OFF
log cmake --build "$folder/build" --parallel 2 --target tahr_product
"$folder/build/bin/tahr" info >/dev/null 2>&1 || [ ! -f "$BUILD/bin/tahr" ] || { echo "no_cxx: the shell does not run"; exit 1; }
echo "no_cxx: built$parts without a C++ compiler"
