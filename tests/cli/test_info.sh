#!/bin/sh
# SPDX-License-Identifier: MIT
# test_info.sh: help, version and info say what they should.
. "$(dirname "$0")/support.sh"

tahr help
expect 0 "usage: tahr" "run" "info"
tahr
expect 2 "usage: tahr"
tahr --version
expect 0 "tahr 0.1.0"
tahr run --help
expect 0 --level --up --characters --seconds --rate --seed --preset --backend --route --csv --plot --check --json "native"
tahr help run
expect 0 --level

tahr info
expect 0 "ABI 0.1" "native" "capsule" "mesh" "precise"
tahr info --json
expect 0 '"version": "0.1.0"' '"native"' '"native-double"' '"bit_identical"'
is_json || fail "info --json is no JSON"
tahr info --nonsense
expect 2 "--nonsense"
tahr info --json more
expect 2 "more"
finish
