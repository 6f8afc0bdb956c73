#!/bin/sh
# headers.sh: every public header compiles alone, twice included, without a warning. Usage: headers.sh c99|c11|c17|c++17
set -eu
language=$1
case $language in
c++*) kind=c++ compiler=${CXX:-c++} ;;
*) kind=c compiler=${CC:-cc} ;;
esac
if ! command -v "$compiler" >/dev/null 2>&1; then
    echo "SKIP: house_headers_$language: no compiler '$compiler'"
    exit 77
fi
others=
command -v clang >/dev/null 2>&1 && others=clang
for header in include/tahr/*.h; do
    name=tahr/${header##*/}
    for tool in "$compiler" $others; do
        printf "#include <%s>\n#include <%s>\nextern int nothing;\n" "$name" "$name" |
            "$tool" -x $kind -std="$language" -pedantic-errors -Wall -Wextra -Wconversion -Wshadow -Werror -Iinclude \
                -fsyntax-only -
    done
done
