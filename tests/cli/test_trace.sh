#!/bin/sh
# SPDX-License-Identifier: MIT
# test_trace.sh: a run recorded on one backend is repeated from its file alone; files that are no longer what they were
# are told apart; backends are taken from shared objects.
. "$(dirname "$0")/support.sh"
plugins=$(dirname "$TAHR")/../lib

"$TAHR" info >"$work/info"
# recorded BACKEND OPTIONS... : a run is the same while it is recorded, and its file repeats it from anywhere. Leaves
# what the replay says in $work/out and the file in $work/BACKEND.trace.
recorded() {
    backend=$1
    shift
    tahr run "$@" --backend "$backend" --check off --json
    expect 0
    hash=$(value state_hash)
    tahr run "$@" --backend "$backend" --check off --json --trace "$work/$backend.trace"
    expect 0
    [ "$(value state_hash)" = "$hash" ] || fail "recording changed the state_hash on $backend, $*"
    (cd / && "$TAHR" replay "$work/$backend.trace") >"$work/out" 2>"$work/err" || fail "replay of $backend, $*: $(cat "$work/err")"
    name=${backend%-double}
    grep -q "backend ${name%-2} " "$work/out" || fail "the replay does not name its backend: $(cat "$work/out")"
}

backends solid >"$work/solid"
while read -r backend; do
    recorded "$backend" --seconds 4 --characters 12
    grep -q "repeated   2880 steps of 12 characters" "$work/out" || fail "not all was repeated: $(cat "$work/out")"
    bytes=$(wc -c <"$work/$backend.trace")
    echo "trace: $backend: $((bytes / 2880)) bytes per step"
    [ $((bytes / 2880)) -lt 1000 ] || fail "a step of $backend takes $((bytes / 2880)) bytes"
done <"$work/solid"
cp "$work/native.trace" "$work/whole.trace"

# From the side: the whole tour, which fits into a mail, and wanderers of other shapes.
backends all >"$work/all"
while read -r backend; do
    recorded "$backend" --2d --tour
    grep -q "repeated   3900 steps of 1 character," "$work/out" || fail "not the whole tour: $(cat "$work/out")"
    bytes=$(wc -c <"$work/$backend.trace")
    [ "$bytes" -lt 20000000 ] || fail "the tour on $backend takes $bytes bytes"
    recorded "$backend" --2d --characters 4 --seconds 2 --shape box
    recorded "$backend" --2d --characters 4 --seconds 2 --shape sphere --tiles separate
done <"$work/all"
[ -s "$work/solid" ] && [ -s "$work/all" ] || fail "no backends"
mv "$work/whole.trace" "$work/native.trace"

# A route, and what the summary says of the file.
printf '[{"time": 0, "move": [1, 0, 0]}, {"time": 1, "jump": true}]' >"$work/route.json"
tahr run --seconds 2 --route "$work/route.json" --trace "$work/route.trace"
expect 0 "wrote" "$work/route.trace" "bytes per step"
tahr replay "$work/route.trace"
expect 0 "repeated   120 steps of 1 character," "ok"
for named in "--trace $work/route.trace" "--trace=$work/route.trace"; do
    tahr replay $named
    expect 0 "repeated   120 steps of 1 character," "ok"
done

# Cut off, spoiled, no trace at all.
size=$(wc -c <"$work/native.trace")
head -c $((size / 2)) "$work/native.trace" >"$work/half.trace"
tahr replay "$work/half.trace"
expect 1 "the file is cut off, expected" "byte $((size / 2)):" "FAILED"
head -c 50 "$work/native.trace" >"$work/head.trace"
tahr replay "$work/head.trace"
expect 2 "byte 50: the file is cut off, expected its head"
{ head -c $((size / 2)) "$work/native.trace"; printf 'XXXXXXXX'; tail -c +$((size / 2 + 9)) "$work/native.trace"; } >"$work/spoiled.trace"
tahr replay "$work/spoiled.trace"
expect 1 "checksum" "expected" "broken     after step" "FAILED"
echo 'not a trace' >"$work/text.trace"
tahr replay "$work/text.trace"
expect 2 "byte 0: no trace" "cannot replay '$work/text.trace'"
: >"$work/empty.trace"
tahr replay "$work/empty.trace"
expect 2 "byte 0: "
tahr replay "$work/nowhere.trace"
expect 2 "$work/nowhere.trace"
tahr replay "$work"
expect 2 "$work"
tahr replay
expect 2 "expected the name of one file"
tahr replay one two
expect 2 "expected the name of one file"
tahr replay --trace
expect 2 "expected the name of one file"
tahr replay --csv "$work/route.trace"
expect 2 "unknown option '--csv'" "--trace"
tahr replay --help
expect 0 "usage: tahr replay [--trace] FILE"
tahr help replay
expect 0 "usage: tahr replay [--trace] FILE"

# Files that cannot be written.
tahr run --seconds 1 --trace "$work/none/a.trace"
expect 2 "--trace '$work/none/a.trace'" "No such file"
tahr run --seconds 1 --trace "$work/same" --csv "$work/same"
expect 2 "both write '$work/same'"
if [ -w /dev/full ]; then
    tahr run --seconds 1 --trace /dev/full
    expect 1 "--trace '/dev/full'" "cannot write"
fi

# Backends from shared objects: the same run as with the linked one, or a message that says why not.
for backend in native ccd fcl box2d; do
    [ -f "$plugins/libtahr_$backend.so" ] && grep -q "^  $backend " "$work/info" || continue
    flat=
    [ $backend != box2d ] || flat=--2d
    tahr run $flat --backend $backend --seconds 1 --json
    hash=$(value state_hash)
    tahr run $flat --backend "$plugins/libtahr_$backend.so" --seconds 1 --json --trace "$work/plugin.trace"
    expect 0
    [ "$(value state_hash)" = "$hash" ] || fail "libtahr_$backend.so walks differently from $backend"
    [ "$(value backend)" = $backend ] || fail "the summary does not name the backend of libtahr_$backend.so"
    tahr replay "$work/plugin.trace"
    expect 0
done
if [ -f "$plugins/libtahr_box2d.so" ]; then
    tahr run --backend "$plugins/libtahr_box2d.so" --seconds 1 # a level of three dimensions
    expect 2 "two dimensions" "--2d"
fi
while read -r broken words; do
    [ -f "$plugins/../tests/plugins/$broken.so" ] || continue
    tahr run --backend "$plugins/../tests/plugins/$broken.so" --seconds 1
    expect 2 "--backend '$plugins/../tests/plugins/$broken.so'" "$words"
done <<END
no_symbol no function tahr_backend_v1
null_table tahr_backend_v1 returned NULL
small_struct backend.struct_size is
bad_major backend.abi_major and abi_minor are 1.1, expected 0.1
bad_minor backend.abi_major and abi_minor are 0.2, expected 0.1
null_slot is NULL, expected a function
END
tahr run --backend "$work/text.trace"
expect 2 "does not load" "--backend '$work/text.trace'"
tahr run --backend nowhere.so
expect 2 "./nowhere.so does not load" "No such file"
finish
