#!/bin/sh
# check_includes.sh: who may include whom, so that the seams stay seams. Run from the root of the sources.
#   include/     a few libc headers and itself
#   src/         include/ and src/, libc; plugin_file.c also <sys/stat.h> and <link.h>
#   backends/X/  include/, backends/common/ and X's own third party; never src/, never another backend
#   bindings/, fuzz/, tests/: include/, their own folder and tests/support/; tests/unit also src/, backends/ and
#   tests/bench/, tests/cli and fuzz also bindings/cli/; bindings/cpp/ of C++ a few small headers, its tests its headers
set -eu

libc='assert|ctype|dlfcn|errno|fenv|float|inttypes|limits|math|stdalign|stdarg|stdatomic|stdbool|stddef|stdint|stdio|stdlib|string'

# Prints "file:line:header" of every include, quotes or angle brackets kept.
includes() {
    awk '/^[ \t]*#[ \t]*include[ \t]*[<"]/ {
        header = $0
        sub(/^[ \t]*#[ \t]*include[ \t]*/, "", header)
        match(header, /^(<[^>]*>|"[^"]*")/)
        print FILENAME ":" FNR ":" substr(header, 1, RLENGTH)
    }' "$@"
}

# rule NAME FOLDER PATTERN: every include in the C files below FOLDER matches the extended regular expression.
rule() {
    [ -d "$2" ] || return 0
    files=$(find "$2" -name '*.[ch]' -o -name '*.[ch]pp' | sort)
    [ -n "$files" ] || return 0
    # shellcheck disable=SC2086
    bad=$(includes $files | grep -vE ":($3)\$" || true)
    [ -z "$bad" ] && return 0
    printf '%s\n' "$bad" | sed "s|^|$1 may not include this: |"
    return 1
}

# Quoted names must exist beside the including file, or in one of the other folders given.
resolve() {
    folder=$1
    shift
    [ -d "$folder" ] || return 0
    files=$(find "$folder" -name '*.[ch]' -o -name '*.[ch]pp' | sort)
    [ -n "$files" ] || return 0
    # shellcheck disable=SC2086
    includes $files | grep ':"' | while IFS=: read -r file line name; do
        name=${name#\"}
        name=${name%\"}
        for place in "${file%/*}" "$@"; do
            [ -f "$place/$name" ] && continue 2
        done
        echo "$file:$line: \"$name\" is not in a folder that this file may use"
    done
}

failed=0
own='"[a-z0-9_]+\.h"'
check() {
    rule "$@" || failed=1
}
check "include/" include '<(stddef|stdint)\.h>|<tahr/[a-z0-9_]+\.h>'
check "src/" src "<($libc|sys/stat|link)\\.h>|<tahr/[a-z0-9_]+\\.h>|$own"
# One file of the library looks at files of the system: the one that does so before a plugin is loaded.
if grep -lE '<(sys/stat|link)\.h>' src/* | grep -v '^src/plugin_file\.c$'; then
    echo "src/: only plugin_file.c may include <sys/stat.h> and <link.h>"
    failed=1
fi
for backend in backends/*/; do
    name=$(basename "$backend")
    case $name in
    ccd) third='|<ccd/[a-z0-9_]+\.h>' ;;
    fcl) third='|<(fcl|octomap)/[a-zA-Z0-9_/.-]+>|<[a-z_]+>' ;;
    box2d) third='|<box2d/[a-z0-9_]+\.h>|<[a-z_]+>' ;;
    threads) third='|<(immintrin|pthread|signal|sys/mman|time|unistd)\.h>' ;;
    lcm) third='|<(lcm|tahr_lcm)/[a-z0-9_]+\.h>|<((arpa|netinet|sys)/[a-z]+|fcntl|time|unistd)\.h>' ;;
    native | common) third='|<[ei]mmintrin\.h>' ;; # the processor's own vectors
    *) third= ;;
    esac
    check "backends/$name" "backends/$name" \
        "<($libc)\\.h>|<tahr/[a-z0-9_]+\\.h>|\"((\\.\\./)?common/)?[a-z0-9_]+\\.h\"$third"
done
for binding in bindings/*/; do
    name=$(basename "$binding")
    case $name in
    cpp) # of C++ what is quickly read
        pattern='<(atomic|cstddef|cstdint|cstdio|cstdlib|cstring|exception|new|stdexcept|type_traits|utility)>'
        pattern="$pattern|<tahr/[a-z0-9_]+\\.h>|\"[a-z_]+\\.hpp\"" ;;
    cli) pattern='<(tahr/)?[a-z0-9_/-]+\.h>|"((\.\./|lcm/)?[a-z0-9_]+\.h)"' ;; # lcm/: all that speaks LCM
    *) pattern="<(tahr/)?[a-z0-9_/-]+\\.h>|$own" ;;
    esac
    check "bindings/$name" "bindings/$name" "$pattern"
done
check "fuzz/" fuzz "<(tahr/)?[a-z0-9_/-]+\\.h>|\"(\\.\\./(tests/support|bindings/cli|bindings/cli/lcm)/)?[a-z0-9_]+\\.h\""
for folder in tests/*/; do
    name=$(basename "$folder")
    case $name in
    cpp) pattern='<tahr/[a-z]+\.hpp>|"cpp_test\.hpp"' ;;
    examples) pattern='"[a-z0-9_]+\.h"|<bt[A-Za-z]+\.h>|<tahr/[a-z]+\.hpp>' ;; # programs of users of other engines
    bench) # peers/ are users of other engines
        pattern='"((\.\./)?support/)?[a-z0-9_]+\.h"|<(bt[A-Z]|Bullet|Jolt/)[A-Za-z/]*\.h>' ;;
    unit) pattern='"[a-z0-9_/.]+\.(h|inc)"' ;;
    fcl) pattern='<(fcl|octomap)/[a-zA-Z0-9_/.-]+>|<[a-z_]+>|"[a-z0-9_]+\.h"' ;;
    lcm) pattern='"(\.\./)?[a-z0-9_]+\.h"' ;;
    cli) pattern='"((\.\./)?support/|\.\./\.\./bindings/cli/|lcm/)?[a-z0-9_]+\.h"' ;;
    *) pattern='"((\.\./)?support/)?[a-z0-9_]+\.h"' ;;
    esac
    check "tests/$name" "tests/$name" "<(tahr/)?[a-z0-9_/]+\\.h>|<[a-z_]+>|$pattern"
done

unresolved=$(
    resolve src
    for backend in backends/*/; do resolve "${backend%/}" backends; done
    for folder in bindings/*/; do resolve "${folder%/}"; done
    for folder in tests/*/; do
        case $folder in
        tests/unit/) resolve tests/unit tests/unit tests/support tests/bench src backends backends/common | grep -v '"layout.inc"' || true ;;
        tests/bench/) resolve tests/bench tests/bench tests/support tests/accuracy ;; # what is charted is scored there
        tests/cli/) resolve tests/cli tests tests/support bindings/cli ;;
        *) resolve "${folder%/}" tests tests/support ;;
        esac
    done
)
if [ -n "$unresolved" ]; then
    printf '%s\n' "$unresolved"
    failed=1
fi

# The top level was fixed by the project's user.
for entry in *; do
    case $entry in
    Makefile | CMakeLists.txt | include | src | backends | bindings | tests | fuzz | README.md | LICENSE | CHANGELOG.md) ;;
    build*) ;;
    *) echo "$entry: nothing else belongs at the top level"; failed=1 ;;
    esac
done
[ $failed = 0 ] && echo "includes: every file keeps to its neighbours"
exit $failed
