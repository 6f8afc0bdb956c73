#!/bin/sh
# test_playground_full.sh: 64 characters wander 100 000 steps through the playground, at other rates and with the other
# preset too: nobody tunnels, sinks in, is stuck for good, or crushed by what does not move. TAHR: the program.
set -eu
failed=0
while read -r arguments; do
    # shellcheck disable=SC2086
    if ! "$TAHR" run --characters 64 --check sampled $arguments; then
        echo "cli_playground_full: $arguments: see above"
        failed=1
    fi
done <<END
--rate 60 --seconds 1667 --seed 7
--rate 30 --seconds 600 --seed 11
--rate 144 --seconds 300 --seed 12
--rate 60 --seconds 500 --seed 14
--rate 60 --seconds 600 --seed 13 --preset unreal
END
exit $failed
