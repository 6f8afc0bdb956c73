#!/bin/sh
# SPDX-License-Identifier: MIT
# test_chart.sh: tahr_chart measures every family on its smallest budget, what it writes is well-formed, and wrong
# options are refused by name. With "draw" what was measured is drawn too, if matplotlib is there.
# Environment: CHART (the program), BUILD (where `make chart` has its Python).
set -u
here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "FAILED: $*"
    exit 1
}

python=python3
[ "${1:-}" = draw ] && [ -x "$BUILD/venv/bin/python" ] && python=$BUILD/venv/bin/python
command -v "$python" >/dev/null 2>&1 || { echo "SKIP: bench_chart: python3 is not there"; exit 77; }

"$CHART" --budget huge >"$work/out" 2>&1
[ $? -eq 2 ] && grep -q "'huge'" "$work/out" || fail "--budget huge: $(cat "$work/out")"
"$CHART" --family x >"$work/out" 2>&1
[ $? -eq 2 ] && grep -q "'x'" "$work/out" || fail "--family x: $(cat "$work/out")"
"$CHART" --out "$work/nowhere" >"$work/out" 2>&1
[ $? -eq 1 ] && grep -q "nowhere/machine.csv' cannot be written" "$work/out" || fail "--out: $(cat "$work/out")"

# Without the shared levels, so that it takes as long everywhere.
TAHR_LEVELS=$work "$CHART" --budget tiny --quiet --out "$work" 2>"$work/out" || fail "tahr_chart: $(cat "$work/out")"

PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$here "$python" - "$work" <<'PYTHON' || fail "a CSV is not as it must be"
import sys
from pathlib import Path

from rows import read_machine, read_rows

folder = Path(sys.argv[1])
wanted = {"sweeps": 6, "movement": 5, "shortcuts": 3, "crowds": 3, "scenes": 1}  # scenes without the shared levels
for family, scenes in wanted.items():
    rows = read_rows(folder / f"{family}.csv")
    assert len({r.scene for r in rows}) == scenes, f"{family}: {sorted({r.scene for r in rows})}"
    assert len({(r.scene, r.curve, r.setting, r.value) for r in rows}) == len(rows), f"{family}: a setting twice"
    for r in rows:
        assert r.family == family and r.scene and r.curve and r.setting, r
        assert r.role in ("default", "knob", "off", "parity", "only", "definition", "reference"), r
        assert r.failed <= r.samples and (r.failed == 0) == (r.why == ""), r
        assert r.role == "reference" or (r.samples > 0 and r.ns_p50 > 0 and r.ns_p99 >= r.ns_p50), r
        if family in ("sweeps", "movement"):
            assert 0 <= r.error_p50_m <= r.error_p99_m <= r.error_max_m, r
assert dict(read_machine(folder / "machine.csv")).keys() >= {"processor", "clock", "compiler", "flags"}
PYTHON

PYTHONDONTWRITEBYTECODE=1 "$python" -m unittest discover -s "$here" -p 'test_*.py' >"$work/out" 2>&1 ||
    fail "$(cat "$work/out")"

# Without its libraries the drawing says what is missing, and where it is listed.
mkdir "$work/bare"
echo 'raise ImportError("no", name="matplotlib")' >"$work/bare/matplotlib.py"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$work/bare "$python" "$here/draw.py" --in "$work" --out "$work" >"$work/out" 2>&1
[ $? -eq 1 ] && grep -q "^chart: matplotlib is not there; .*requirements.txt" "$work/out" || fail "bare: $(cat "$work/out")"
grep -q Traceback "$work/out" && fail "bare: $(cat "$work/out")"
[ "${1:-}" = draw ] || exit 0

"$python" -c 'import matplotlib' 2>/dev/null ||
    { echo "SKIP: bench_chart_draw_full: matplotlib is not there (make chart installs it)"; exit 77; }
draw() {
    PYTHONDONTWRITEBYTECODE=1 "$python" "$here/draw.py" --in "$work" --out "$1" >"$work/out" 2>&1
}
draw "$work/a" && draw "$work/b" || fail "$(cat "$work/out")"
cmp "$work/a/index.html" "$work/b/index.html" || fail "the same numbers drew another page"
cmp "$work/a/speed-accuracy.svg" "$work/b/speed-accuracy.svg" || fail "the same numbers drew another picture"
grep -Eq '(src|href)="https?:' "$work/a/index.html" && fail "the page needs the network"
echo "sweeps,x" >>"$work/sweeps.csv"
draw "$work/c" && fail "a broken row was drawn"
grep -q "sweeps.csv:[0-9]*: 2 fields, expected" "$work/out" || fail "a broken row: $(cat "$work/out")"
draw "$work/sweeps.csv" && fail "drawn into a file"
grep -q "^chart: .*sweeps.csv: cannot be written" "$work/out" || fail "into a file: $(cat "$work/out")"
printf '\377\376\n' >"$work/sweeps.csv"
draw "$work/c" && fail "bytes that are no text were drawn"
grep -q "^chart: .*sweeps.csv: is no CSV" "$work/out" || fail "no text: $(cat "$work/out")"
exit 0
