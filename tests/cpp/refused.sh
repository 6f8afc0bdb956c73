#!/bin/sh
# refused.sh: the mistakes of refused.cpp do not compile, and the compiler's words say why. Usage: refused.sh FOLDER,
# that of <tahr/tahr.hpp>
set -eu
log=$(mktemp)
trap 'rm -f "$log"' EXIT
compile() {
    "${CXX:-c++}" -std=c++17 -Wall -Wextra -Werror -I"$1" -Iinclude -DMISTAKE="$2" -fsyntax-only tests/cpp/refused.cpp \
        >"$log" 2>&1
}
compile "$1" 0 || { cat "$log"; echo "refused: a program without a mistake does not compile"; exit 1; }
number=0
while IFS='|' read -r words what; do
    number=$((number + 1))
    if compile "$1" $number; then echo "refused: $what compiles"; exit 1; fi
    grep -qE "$words" "$log" || { cat "$log"; echo "refused: $what: the message is not '$words'"; exit 1; }
done <<END
ray does not take the arguments that callbacks.hpp says|a ray with other arguments
tahr_status, tahr::status or nothing, no bool|a callback that returns bool
the body would point into what is gone|a mesh of vertices that die
deleted|a copy of a world
unused-result|a status that is dropped
view|a mesh of signed indices
what gathers takes|a function that gathers without a place to put things
END
echo "refused: $number mistakes"
