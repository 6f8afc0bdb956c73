#!/bin/sh
# namespace.sh NAME COMMAND...: runs a test in a network of its own, which has nothing but a loopback that takes
# multicast, so that no message leaves it. What the test leaves running ends with it.
set -eu
name=$1
shift
skip() {
    echo "SKIP: $name: $1"
    exit 77
}
for tool in unshare ip; do
    command -v $tool >/dev/null 2>&1 || skip "$tool is missing"
done
# With a /proc of its own, where that is allowed: what looks itself up there (sanitizers) would find others.
own="-n -p -f --kill-child"
[ "$(id -u)" -eq 0 ] || own="-r $own"
for more in --mount-proc ""; do
    # shellcheck disable=SC2086
    unshare $own $more ip link set lo up 2>/dev/null && break
    [ "$more" ] || skip "network namespaces are not permitted here"
done
# shellcheck disable=SC2086,SC2016
TAHR_OWN_NETWORK=1 exec unshare $own $more sh -c '
    set -eu
    ip link set lo up
    ip link set lo multicast on
    ip route add 224.0.0.0/4 dev lo
    "$@"
' sh "$@"
