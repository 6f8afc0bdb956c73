#!/bin/sh
# no_cxx.sh: everything that is shipped configures and builds where there is no C++ compiler. Unoptimised and without
# debug information: it is about what the build asks for. Then golden/run.sh on the unoptimised library.
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
[ ! -f "$BUILD/lib/libtahr_ccd.a" ] || parts="$parts -DTAHR_BACKEND_CCD=ON"
[ ! -f "$BUILD/bin/tahr" ] || parts="$parts -DTAHR_CLI=ON"
# Box2D 3 is C. A package of it is found again; its sources must be named again.
box2d_3=$(sed -n 's/^TAHR_BOX2D3_DIR:[A-Z]*=//p' "$BUILD/CMakeCache.txt" 2>/dev/null)
[ ! -f "$BUILD/lib/libtahr_box2d_3.a" ] || parts="$parts -DTAHR_BACKEND_BOX2D=ON"
# shellcheck disable=SC2086
log env CXX=/nonexistent cmake -S . -B "$folder/build" $generator $parts -DTAHR_BOX2D3_DIR="$box2d_3" \
    -DCMAKE_C_COMPILER="${CC:-cc}" -DCMAKE_CXX_COMPILER=/nonexistent -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
grep -qF 'TAHR_BACKEND_FCL: no (there is no C++ compiler)' "$folder/log" ||
    { echo "no_cxx: the configuration does not say that FCL is left out, and why"; cat "$folder/log"; exit 1; }
log cmake --build "$folder/build" --parallel 2 --target tahr_product
if [ -f "$BUILD/bin/tahr" ]; then
    backends=native
    [ ! -f "$BUILD/lib/libtahr_ccd.a" ] || backends="$backends ccd"
    [ ! -f "$BUILD/lib/libtahr_box2d_3.a" ] || backends="$backends box2d"
    for backend in $backends; do
        log "$folder/build/bin/tahr" selftest "$backend"
    done
    echo "no_cxx: self-tests of $backends pass"
fi
# An unoptimised library of gcc is at hand now, which the golden test needs as well.
if "${CC:-cc}" --version | grep -q 'Free Software Foundation'; then
    LIBRARY="$folder/build/lib/libtahr.a" sh tests/golden/run.sh gcc-O0
else
    sh tests/golden/run.sh gcc-O0
fi
echo "no_cxx: built$parts without a C++ compiler"
