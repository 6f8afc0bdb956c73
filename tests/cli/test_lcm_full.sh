#!/bin/sh
# SPDX-License-Identifier: MIT
# test_lcm_full.sh: ten minutes of 16 characters, recorded over LCM, are proven bit for bit by taking them again; so is
# a crowd of 256.
. "$(dirname "$0")/support.sh"

tahr listen --help
if grep -q "built without LCM" "$work/err"; then
    echo "SKIP: cli_lcm_full: this tahr was built without LCM"
    exit 77
fi
for options in "--characters 16 --seconds 600" "--characters 256 --seconds 20 --crowd"; do
    # shellcheck disable=SC2086
    tahr run $options --check off --lcm "file://$work/a.lcmlog"
    expect 0 "; 0 dropped, 0 failed"
    echo "lcm: $options: $(wc -c <"$work/a.lcmlog") bytes"
    tahr replay "$work/a.lcmlog" --verify
    expect 0 "ok"
    grep "proven" "$work/out"
done
finish
