# SPDX-License-Identifier: MIT
# support.sh: what the tests of the shell share. TAHR is the path of the binary.
: "${TAHR:?set TAHR to the path of the tahr binary}"
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/tahr-cli.XXXXXX")
trap 'rm -rf "$work"' EXIT
failures=0
LSAN_OPTIONS="suppressions=$here/leaks.txt:print_suppressions=0"
export LSAN_OPTIONS

fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
    : >"$work/failed" # a pipe's end is another shell, whose variables are lost
}

# Runs tahr; leaves its output in $work/out and $work/err and its exit code in $code.
tahr() {
    code=0
    "$TAHR" "$@" >"$work/out" 2>"$work/err" || code=$?
    case "$(cat "$work/err")" in *Sanitizer* | *"runtime error"*) fail "tahr $*: $(cat "$work/err")" ;; esac
}

# expect CODE WORDS... : the last call ended with CODE and its messages hold every one of WORDS.
expect() {
    wanted=$1
    shift
    [ "$code" = "$wanted" ] || fail "exit code $code instead of $wanted; $(cat "$work/err")"
    for words in "$@"; do
        grep -qF -- "$words" "$work/out" "$work/err" || fail "no '$words' in: $(cat "$work/out" "$work/err")"
    done
}

# The value of a key of the one-level JSON object in $work/out.
value() {
    sed -n "s/^  \"$1\": \(.*\)\$/\1/p" "$work/out" | sed 's/,$//; s/^"//; s/"$//'
}

# Whether $work/out is JSON, by python3 where there is one.
is_json() {
    if command -v python3 >/dev/null 2>&1; then
        python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$work/out"
    else
        [ "$(head -c 1 "$work/out")" = "{" ] && [ "$(tail -n 1 "$work/out")" = "}" ]
    fi
}

# The backends of this build, one a line; solid: those of three dimensions, plane: those that run --2d on chains too.
backends() {
    "$TAHR" info --json | awk -v wanted="$1" '
        /^      "name": / { name = $2; gsub(/[",]/, "", name); planar = 0 }
        /"planar"/ { planar = 1 }
        /^    }/ { if (name != "" && (wanted == "all" || planar == (wanted == "plane"))) print name; name = "" }'
}

finish() {
    [ ! -e "$work/failed" ] || failures=$((failures + 1))
    [ "$failures" = 0 ] && echo "ok: $(basename "$0")"
    exit "$((failures > 0))"
}
