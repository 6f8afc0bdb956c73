#!/bin/sh
# run.sh PROGRAM: interop.py with PyPI's lcm, in a virtual environment below BUILD and a network of its own.
set -eu
program=$1
folder=$BUILD/lcm/interop
python=${PYTHON:-python3}
skip() {
    echo "SKIP: lcm_interop: $1"
    exit 77
}
command -v "$python" >/dev/null 2>&1 || skip "there is no $python"
"$python" -c 'import venv, ensurepip' 2>/dev/null || skip "$python has no venv (Debian: python3-venv)"
mkdir -p "$folder"
[ -x "$folder/venv/bin/python" ] || "$python" -m venv "$folder/venv"
"$folder/venv/bin/python" -c 'import lcm' 2>/dev/null ||
    "$folder/venv/bin/python" -m pip --quiet --disable-pip-version-check install lcm >"$folder/pip.log" 2>&1 ||
    skip "pip cannot install lcm: $(tail -n 1 "$folder/pip.log")"
PYTHONPATH=$BUILD/lcm/python PYTHONDONTWRITEBYTECODE=1 exec sh tests/lcm/namespace.sh lcm_interop \
    "$folder/venv/bin/python" tests/lcm/interop/interop.py "$program" "$folder"
