#!/bin/sh
# run.sh: compiles the library from its sources by hand, without the build and without a warning, with one compiler and
# one set of flags, runs golden_hash.c on it, with and without lanes and the gather cache, and compares every line with
# hash.txt. Usage: run.sh LABEL; LABEL is one of those below. BUILD: the build; if it is gcc's and a Release, its
# libtahr.a is what gcc-O3 makes. LIBRARY: what there is of the label already. Prints the difference on failure.
set -eu
label=$1
emulator=
case $label in
gcc-O0) compiler=gcc flags=-O0 ;;
gcc-O3) compiler=gcc flags=-O3 ;;
gcc-O3-native) compiler=gcc flags="-O3 -march=native" ;;
clang-O0) compiler=clang flags=-O0 ;;
clang-O3) compiler=clang flags=-O3 ;;
musl-gcc-O0) compiler=musl-gcc flags="-O0 -static" ;; # gcc with another libc: what it optimises is looked at above
aarch64-gcc-O2) compiler=aarch64-linux-gnu-gcc flags=-O2 emulator="qemu-aarch64 -L /usr/aarch64-linux-gnu" ;;
*) echo "run.sh: unknown label '$label'" >&2; exit 2 ;;
esac
# shellcheck disable=SC2086
for tool in $compiler ${emulator%% *}; do
    command -v "$tool" >/dev/null 2>&1 && continue
    echo "SKIP: golden_$label: $tool is not installed"
    exit 77
done
if [ ! -f tests/golden/golden_hash.c ]; then
    echo "SKIP: golden_$label: there is no tests/golden/golden_hash.c"
    exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
library="src/*.c backends/common/*.c backends/native/*.c"
if [ "$label" != clang-O3 ]; then # it walks without the self-test; that this compiles, one of them looks at
    # shellcheck disable=SC2086
    library=$(ls $library | grep -v '^src/selftest')
fi
cache=${BUILD:-}/CMakeCache.txt
if [ "$label" = gcc-O3 ] && "${CC:-gcc}" --version 2>/dev/null | grep -q 'Free Software Foundation' &&
    grep -qx 'CMAKE_BUILD_TYPE:[A-Z]*=Release' "$cache" 2>/dev/null; then
    library=$BUILD/lib/libtahr.a
fi
library=${LIBRARY:-$library}
# shellcheck disable=SC2086
"$compiler" -std=c11 -ffp-contract=off -fno-math-errno $flags -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror \
    -Iinclude -Ibackends tests/golden/golden_hash.c $library -o "$folder/golden_hash" -lm
failed=0
run() {
    # shellcheck disable=SC2086
    $emulator "$folder/golden_hash" "$@" >"$folder/hash"
    if ! diff tests/golden/hash.txt "$folder/hash"; then
        echo "golden_$label $*: other bits than tests/golden/hash.txt (left: expected, right: this build)"
        failed=1
    fi
    cat "$folder/hash"
}
run
if [ -z "$emulator" ]; then # slow; what it ran is its own lanes, against the bits of this machine's
    run --scalar
    run --no-cache
fi
exit $failed
