# SPDX-License-Identifier: MIT
"""What the shell publishes is read and drawn here; what is published here is proven by the shell."""

import os
import subprocess

import lcm
import numpy as np
import pytest
from logs import messages
from scenes import DT

import tahr
from tahr._tahr import lib
from tahr.telemetry import Publisher, read_log

SHELL = os.environ.get("TAHR")
if not SHELL:
    pytest.skip("TAHR does not name the shell", allow_module_level=True)


def shell(*arguments, code=0):
    done = subprocess.run([SHELL, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


about = subprocess.run([SHELL, "listen", "--help"], capture_output=True, text=True, timeout=60)
if about.returncode != 0 or "without LCM" in about.stdout:
    pytest.skip("the shell was built without LCM", allow_module_level=True)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    path = tmp_path_factory.mktemp("shell") / "run.lcmlog"
    shell("run", "--characters", 4, "--seconds", 5, "--lcm", f"file://{path}")
    return path


def test_what_the_shell_publishes_is_read_whole(recorded):
    log = read_log(recorded)
    assert log.problems == [] and log.foreign == 0 and sum(log.lost.values()) == 0
    assert len(log.states) == len(log.inputs) == len(log.reports) == 4 * 300
    assert log.worlds["level"][-1] == "playground" and len(log.bodies) > 0
    assert messages.body_t.MOVE in log.bodies["kind"]
    first = log.snapshots[log.snapshots["step"] == 0]
    assert sorted(first["character"].tolist()) == [0, 1, 2, 3]
    assert (tahr.hashes(first["state"].copy()) == first["state_hash"]).all()
    assert len(log.events) == log.reports["event_count"].sum()


def test_what_the_shell_records_lcm_reads(recorded, tmp_path):
    path = tmp_path / "kept.lcmlog"
    shell("record", "--lcm", f"file://{recorded}?speed=0", path)
    kept = [(event.channel, event.data) for event in lcm.EventLog(str(path), "r")]
    assert kept == [(event.channel, event.data) for event in lcm.EventLog(str(recorded), "r")]
    state = messages.state_t.decode(next(data for channel, data in kept if channel == "TAHR_STATE"))
    assert (state.character, state.step) == (0, 0)


def test_what_the_shell_publishes_can_be_drawn(recorded, tmp_path):
    pytest.importorskip("matplotlib")
    from tahr.plot import overview

    overview(read_log(recorded)).savefig(tmp_path / "run.png", dpi=50)
    assert (tmp_path / "run.png").stat().st_size > 10000


@pytest.mark.skipif(not hasattr(lib, "glue_publisher_open"), reason="the package was built without LCM")
def test_what_is_published_here_the_shell_proves_bit_for_bit(tmp_path):
    """The same level, as the shell has it: floats, and sides that both block."""
    pytest.importorskip("trimesh")
    level = tmp_path / "level.obj"
    level.write_text(shell("level", "playground.obj"))
    reference = tmp_path / "reference.lcmlog"
    shell("run", "--level", level, "--characters", 1, "--seconds", 1, "--lcm", f"file://{reference}")
    known = read_log(reference).worlds[-1]
    vertices, triangles = tahr.load_level(level)
    vertices = vertices.astype(np.float32).astype(np.float64)
    world, config = tahr.World.from_mesh(vertices, triangles, flags=tahr.BODY_TWO_SIDED), tahr.Config()
    mover, states = tahr.Mover(world, config), [tahr.State(config, position=(3 * i - 6, -3, 1)) for i in range(4)]
    path = tmp_path / "python.lcmlog"
    scene = {"level": known["level"], "level_hash": int(known["level_hash"])}
    with Publisher(world, config, characters=4, url=f"file://{path}", **scene) as publisher:
        for step in range(300):
            for number, state in enumerate(states):
                angle = step / 60 + number
                wish = tahr.Input(move=(np.cos(angle), np.sin(angle), 0), jump=step % 100 == 50)
                publisher.step(mover, state, wish, DT, character=number)
    assert "proven     1200 steps of 4 characters" in shell("replay", path, "--verify", "--level", level)
    data = path.read_bytes()
    dt = np.array([DT], ">f8").tobytes()
    at = data.index(dt, len(data) // 2)
    path.write_bytes(data[:at] + np.array([DT * 1.0001], ">f8").tobytes() + data[at + 8 :])
    assert "DIFFERS" in shell("replay", path, "--verify", "--level", level, code=1)
