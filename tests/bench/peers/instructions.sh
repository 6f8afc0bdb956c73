#!/bin/sh
# instructions.sh: instructions per character step by callgrind, of every method on the courses named: slower than a
# clock, but the same on every machine and whatever else that does. Warm-up counts too.
# Usage: tests/bench/peers/instructions.sh FOLDER COURSE..., after tests/bench/peers/build.sh FOLDER
set -eu
folder=${1:?usage: tests/bench/peers/instructions.sh FOLDER COURSE...}
shift
characters=${CHARACTERS:-32} ticks=${TICKS:-200}
command -v valgrind >/dev/null 2>&1 || {
    echo "instructions: valgrind is missing"
    exit 1
}

# count COURSE METHOD FUNCTION: FUNCTION is the method's step, with all that it calls.
count() {
    log=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect="$3" "$folder/tahr_peers" \
        --peers "$folder/lib" --csv "$folder/instructions.csv" --course "$1" --method "$2" \
        --characters $characters --ticks $ticks 2>&1) || true
    if ! printf '%s\n' "$log" | grep -q "^$1 *$2 *[0-9]"; then # left out, of another dimension, or too new for valgrind
        printf '%s\n' "$log" | grep -q 'unhandled instruction' && printf '%-11s %-12s %10s\n' "$1" "$2" unknown
        return 0
    fi
    collected=$(printf '%s\n' "$log" | sed -n 's/.*Collected : \([0-9]*\).*/\1/p')
    printf '%-11s %-12s %10d\n' "$1" "$2" $((collected / (characters * ticks)))
}

printf '%-11s %-12s %10s\n' course method 'per step'
for course; do
    for method in tahr tahr-box2d box2d; do
        count "$course" $method step
    done
    for method in jolt bullet; do
        count "$course" $method '(anonymous namespace)::step*'
    done
    for method in rapier physx; do
        count "$course" $method 'tahr_peers::method::step*'
    done
done
