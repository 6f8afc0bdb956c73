#!/bin/sh
# run.sh: the Python package in a virtual environment of its own, below BUILD.
#   built    linked with the libraries of this build: pytest over all of tests/python, mypy over package and examples
#   sources  `pip install` of the folder, as a user does it, without anything else; and the README's quick start
set -eu
what=$1
name=python_$what
folder=$BUILD/python/$what
python=${PYTHON:-python3}
package=$PWD/bindings/python

skip() {
    echo "SKIP: $name: $1"
    exit 77
}
command -v "$python" >/dev/null 2>&1 || skip "there is no $python"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 9))' || skip "$python is older than 3.9"
"$python" -c 'import venv, ensurepip' 2>/dev/null || skip "$python has no venv (Debian: python3-venv)"
"$python" -c 'import os, sysconfig; open(os.path.join(sysconfig.get_path("include"), "Python.h"))' 2>/dev/null ||
    skip "$python has no headers (Debian: python3-dev)"
mkdir -p "$folder"
[ "$what" = built ] || rm -rf "$folder/venv"
[ -x "$folder/venv/bin/python" ] || "$python" -m venv "$folder/venv"
pip="$folder/venv/bin/python -m pip --quiet --disable-pip-version-check"
$pip install scikit-build-core cffi numpy >"$folder/pip.log" 2>&1 ||
    skip "pip cannot install packages: $(tail -n 1 "$folder/pip.log")"

if [ "$what" = sources ]; then
    $pip uninstall -y scikit-build-core cffi numpy
    $pip install "$package"
    awk '/^```python$/ { inside = 1; next } /^```$/ && inside { exit } inside' "$package/README.md" >"$folder/start.py"
    cd "$folder" && venv/bin/python start.py
    exit
fi

cmake --install "$BUILD" --prefix "$folder/prefix" >/dev/null
$pip install --no-build-isolation --force-reinstall --no-deps "$package" \
    --config-settings="cmake.define.TAHR_PYTHON_INSTALLED=$folder/prefix"
$pip install --no-build-isolation "tahr[test]"
folder_of_tests=$PWD/tests/python
cd "$folder"
status=0
venv/bin/python -B -m pytest -p no:cacheprovider -q -rs "$folder_of_tests" >pytest.log 2>&1 || status=$?
cat pytest.log
sed -n 's/^SKIPPED \[[0-9]*\] [^ ]*: /SKIP: python_built: /p' pytest.log
[ $status = 0 ] || exit $status
venv/bin/python -m mypy --strict -p tahr
venv/bin/python -m mypy --strict "$package"/examples/*.py "$package"/bench/*.py "$package"/build_ffi.py
