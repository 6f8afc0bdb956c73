#!/bin/sh
# layout.sh: compares the layout of the public headers with layout.golden. Usage: layout.sh c99|c11|c17|c++17 [--write]
# With --write the golden text is replaced: do that only when a change of the ABI is meant.
set -eu
language=$1
case $language in
c++*) compiler=${CXX:-c++} ;;
*) compiler=${CC:-cc} ;;
esac
if ! command -v "$compiler" >/dev/null 2>&1; then
    echo "SKIP: house_layout_$language: no compiler '$compiler'"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

headers=
for header in include/tahr/*.h; do headers="$headers -include tahr/${header##*/}"; done
# shellcheck disable=SC2086
{
    "${CC:-cc}" -E -P -Iinclude $headers -x c /dev/null | awk -f tests/unit/layout.awk
    # Plain numbers are constants of the ABI too; versions are not.
    sed -nE 's/^#define (TAHR_[A-Z0-9_]+) \(*[0-9(].*/VALUE(\1)/p' include/tahr/*.h | grep -v VERSION
} >"$folder/layout.inc"

standard=c
case $language in c++*) standard=c++ ;; esac
# shellcheck disable=SC2086
"$compiler" -x $standard -std="$language" -pedantic-errors -Wall -Wextra -Werror -Iinclude -I"$folder" \
    $headers tests/unit/layout.c -o "$folder/layout"
"$folder/layout" >"$folder/text" || {
    status=$?
    sed -n "s/^SKIP: house_layout:/SKIP: house_layout_$language:/p" "$folder/text"
    exit $status
}
if [ "${2:-}" = --write ]; then
    cp "$folder/text" tests/unit/layout.golden
    echo "layout: wrote $(wc -l <tests/unit/layout.golden) lines"
elif ! diff tests/unit/layout.golden "$folder/text"; then
    echo "layout: differs from tests/unit/layout.golden (left: golden, right: these headers as $language)"
    exit 1
fi
