#!/bin/sh
# count_steps.sh: counts the instructions of a step on fixed scenes with callgrind and compares them with
# counts.txt: a rise of more than 3 % fails. The counts are those of gcc 12 at -O3 on a processor with AVX2; with another
# compiler or build they are printed and not compared. Usage: count_steps.sh PROGRAM COMPILER-VERSION BUILD-TYPE [--write]
set -eu
[ $# -ge 3 ] || { echo "usage: count_steps.sh PROGRAM COMPILER-VERSION BUILD-TYPE [--write]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
program=$1 version=$2 build=$3 write=${4:-}

command -v valgrind >/dev/null || { echo "SKIP: bench_counts: valgrind is not installed"; exit 77; }
# Why these counts may differ from those recorded, or nothing.
other=
case $version in
"GNU 12."*) ;;
*) other="recorded with gcc 12, this is $version" ;;
esac
[ "$build" = Release ] || other="recorded of a Release build, this is '$build'"
grep -q -w avx2 /proc/cpuinfo 2>/dev/null || other="recorded on a processor with AVX2"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
for scene in flat hills wall stairs asleep free_fall crowd crowd_asleep; do
    case $scene in crowd*) step=tahr_crowd_step ;; *) step=tahr_mover_step ;; esac
    steps=$(valgrind --tool=callgrind --toggle-collect=$step --callgrind-out-file="$work/out" \
        "$program" "$scene" 2>"$work/log") || { cat "$work/log"; exit 1; }
    total=$(awk '/Collected :/ {print $4}' "$work/log")
    now=$((total / steps))
    if [ "$write" = --write ]; then
        echo "$scene $now" >>"$work/counts"
        continue
    fi
    then=$(awk -v s="$scene" '$1 == s {print $2}' "$here/counts.txt")
    echo "bench_counts: $scene: $now instructions a step, ${then:-none} recorded"
    [ -n "$then" ] && [ $((now * 100)) -le $((then * 103)) ] || { echo "more than 3 % above"; status=1; }
done
if [ "$write" = --write ]; then
    { echo "# Instructions of a step: sh tests/bench/counts/count_steps.sh, --write (gcc 12 -O3, AVX2, callgrind)"; cat "$work/counts"; } \
        >"$here/counts.txt"
    cat "$here/counts.txt"
fi
[ -z "$other" ] || { echo "SKIP: bench_counts: not compared: $other"; exit 77; }
exit $status
