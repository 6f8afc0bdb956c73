#!/bin/sh
# test_constants.sh: every constant of the headers that a message speaks of is in its type, with the same number, and no
# other. Run from the root of the sources.
set -eu

# in_header FILE PREFIX: "NAME number" of TAHR_PREFIX_NAME = number or 1 << number.
in_header() {
    awk -v prefix="TAHR_$2_" '{
        line = $0
        sub(/\/\*.*/, "", line)
        while (match(line, prefix "[A-Z_]+ = [0-9]+( << [0-9]+)?")) {
            text = substr(line, RSTART + length(prefix), RLENGTH - length(prefix))
            line = substr(line, RSTART + RLENGTH)
            count = split(text, word, " ")
            print word[1], (count > 3 ? word[3] * 2 ^ word[5] : word[3])
        }
    }' "$1" | sort
}

# in_type FILE PREFIX: the same of PREFIXNAME = number.
in_type() {
    sed 's|//.*||' "backends/lcm/types/$1" | tr ',;' '\n\n' |
        sed -nE "s/^(.*[ ])?$2([A-Z_]+) = ([0-9]+) *\$/\\2 \\3/p" | sort
}

failed=0
# same HEADER PREFIX TYPE ITS_PREFIX LEAST: at least so many, or one of the two lists was not read.
same() {
    header=$(in_header "include/tahr/$1" "$2" | grep -v '^COUNT ' || true)
    type=$(in_type "$3" "$4")
    if [ "$header" != "$type" ] || [ "$(printf '%s\n' "$header" | wc -l)" -lt "$5" ]; then
        printf '%s and %s differ in TAHR_%s_*:\n%s\n--\n%s\n' "$1" "$3" "$2" "$header" "$type"
        failed=1
    fi
}
same report.h EVENT event_t.lcm "" 21
same state.h MODE state_t.lcm MODE_ 7
same state.h STATE state_t.lcm FLAG_ 11
same sink.h STEP input_t.lcm STEP_ 2
same sink.h CHANGE body_t.lcm "" 4
[ $failed = 0 ] && echo "constants: the types of the messages have those of the headers"
exit $failed
