# SPDX-License-Identifier: MIT
"""What a reader would run: the README's quick start as it stands, every example, the benchmark's Python side."""

import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
PYTHON = ROOT / "bindings" / "python"


def run(*arguments, folder):
    done = subprocess.run(
        [sys.executable, *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=200
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("readme", [ROOT / "README.md", PYTHON / "README.md"], ids=["root", "python"])
def test_the_quick_start_says_what_the_readme_says(readme, tmp_path):
    text = readme.read_text()
    code, output = re.search(r"```python\n(.*?)```\n\n```\n(.*?)```", text, re.S).groups()
    (tmp_path / "quick_start.py").write_text(code)
    assert run("quick_start.py", folder=tmp_path) == output


def test_the_errors_that_the_readme_shows_are_those_that_come(tmp_path):
    text = (PYTHON / "README.md").read_text()
    shown = re.search(r"names the argument:\n\n```\n(.*?)```", text, re.S).group(1).splitlines()
    program = """
import numpy as np, tahr
world = tahr.World([tahr.Body.box((9, 9, 1))])
mover, crowd = tahr.Mover(world), tahr.Crowd(world, capacity=4)
states, inputs = tahr.states(None, [(0, 0, 2), (2, 0, 2), (4, 0, 2)]), tahr.inputs(3)
frozen = states.copy()
frozen.flags.writeable = False
inputs["move"][2, 1] = np.nan
for call in (
    lambda: mover.step(tahr.State(), tahr.Input(), -1),
    lambda: tahr.Config(max_sped=1),
    lambda: crowd.step(tahr.inputs(3), 0.1, frozen),
    lambda: crowd.step(inputs, 0.1, states),
    lambda: world.close(),
):
    try:
        call()
    except tahr.Error as error:
        print(f"{type(error).__name__}: {error}")
"""
    (tmp_path / "errors.py").write_text(program)
    assert run("errors.py", folder=tmp_path).splitlines() == shown


def test_a_wall_in_python_is_kept_at_a_skin(tmp_path):
    said = run(PYTHON / "examples" / "plane.py", folder=tmp_path)
    assert "walking along the wall, 10.0 mm from it" in said


def test_a_rollback_comes_to_the_same_hash(tmp_path):
    said = run(PYTHON / "examples" / "rollback.py", folder=tmp_path)
    assert "the same hash is True" in said and "guessed: 0.000 m" not in said


def test_the_density_of_a_crowd_is_drawn(tmp_path):
    pytest.importorskip("matplotlib")
    arguments = ("--characters", 300, "--seconds", 6, "--threads", 2, "--output", "density.png")
    said = run(PYTHON / "examples" / "crowd_density.py", *arguments, folder=tmp_path)
    assert said.startswith("300 characters: ")
    picture = (tmp_path / "density.png").read_bytes()
    assert picture[:8] == b"\x89PNG\r\n\x1a\n" and len(picture) > 10_000
