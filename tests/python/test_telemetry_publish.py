# SPDX-License-Identifier: MIT
"""Publishing what is stepped in Python: the library's own thread sends it, here into files."""

import os
import pathlib
import subprocess
import sys
import threading

import numpy as np
import pytest
from logs import messages
from scenes import DT, ground

import tahr
from tahr._tahr import lib
from tahr.telemetry import Publisher, read_log

if not hasattr(lib, "glue_publisher_open"):
    pytest.skip("the package was built without LCM", allow_module_level=True)


def wish(step):
    return tahr.Input(move=(np.cos(step / 20), np.sin(step / 20), 0), jump=step % 50 == 25)


def url_of(path, **options):
    return "file://" + str(path) + ("?" + "&".join(f"{k}={v}" for k, v in options.items()) if options else "")


def test_a_log_holds_every_step_bit_for_bit(tmp_path):
    world, config = ground(), tahr.Config()
    mover, state, report = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 2)), tahr.Report()
    states, hashes, inputs, events = [], [], [], []
    with Publisher(world, config, url=url_of(tmp_path / "one.lcmlog"), level="flat", level_hash=2**63 + 5) as publisher:
        begin = state.copy()
        for step in range(300):
            given = wish(step)
            publisher.step(mover, state, given, DT, report)
            states.append(state.position.copy())
            hashes.append(state.hash())
            inputs.append(given.move.copy())
            events.extend(report.events["type"].tolist())
        assert publisher.latest() == state
    log = read_log(tmp_path / "one.lcmlog")
    assert np.array_equal(log.states["position"], states)
    assert log.reports["state_hash"].tolist() == hashes
    assert np.array_equal(log.inputs["move"], inputs)
    assert log.events["type"].tolist() == events and len(events) > 10
    assert log.snapshots["state"][0].tobytes() == bytes(begin)
    assert (log.reports["duration_ns"] > 0).all()
    assert log.worlds["level"][0] == "flat" and log.worlds["level_hash"][0] == 2**63 + 5
    assert log.worlds["backend"][0] == "native" and log.lost["state"] == 0
    counts = publisher.counts
    assert counts["state"] == {"offered": 300, "thinned": 0, "dropped": 0, "delivered": 300, "failed": 0}
    assert counts["event"]["delivered"] == len(events) and counts["world"]["delivered"] == len(log.worlds)


def test_steps_are_those_of_a_mover_alone(tmp_path):
    world, config = ground(), tahr.Config()
    mover = tahr.Mover(world, config)
    alone, told = tahr.State(config, position=(0, 0, 1)), tahr.State(config, position=(0, 0, 1))
    with Publisher(world, config, url=url_of(tmp_path / "same.lcmlog")) as publisher:
        for step in range(100):
            assert mover.step(alone, wish(step), DT) == publisher.step(mover, told, wish(step), DT)
    assert alone == told


def test_a_crowd_is_published_as_it_steps(tmp_path):
    world, config = ground(), tahr.Config()
    places = np.c_[np.arange(20) - 10.0, np.zeros(20), np.ones(20)]
    crowd, states, inputs = tahr.Crowd(world, config, 20), tahr.states(config, places), tahr.inputs(20)
    inputs["move"][:, 1] = 1
    hashes = []
    with Publisher(world, config, characters=20, url=url_of(tmp_path / "crowd.lcmlog")) as publisher:
        for _ in range(50):
            publisher.step_crowd(crowd, inputs, DT, states)
            hashes.append(tahr.hashes(states))
    log = read_log(tmp_path / "crowd.lcmlog")
    assert log.characters.tolist() == list(range(20)) and len(log.states) == 1000
    assert np.array_equal(log.reports["state_hash"], np.concatenate(hashes))
    assert (log.inputs["step_flags"] == messages.input_t.STEP_CROWD).all()
    assert tahr.EVENT_LANDED in log.events["type"]


def test_bodies_that_move_are_told_of(tmp_path):
    block = tahr.Body.box((1, 1, 1), position=(5, 5, 1), flags=tahr.BODY_MOVABLE)
    world = ground(bodies=[block])
    config = tahr.Config()
    mover, state = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 1))
    with Publisher(world, config, url=url_of(tmp_path / "bodies.lcmlog")) as publisher:
        publisher.set(tahr.poses([1], [(5, 5, 2)]))
        for step in range(10):
            publisher.move(tahr.poses([1], [(5, 5, 2 + step / 10)]), DT)
            publisher.step(mover, state, wish(step), DT)
        with pytest.raises(tahr.ArgumentError, match="dt is 0"):
            publisher.move(tahr.poses([1], [(5, 5, 2)]), 0)
    log = read_log(tmp_path / "bodies.lcmlog")
    moves = log.bodies[log.bodies["kind"] == 2]
    assert np.allclose(moves["position"][:, 2], 2 + np.arange(10) / 10)
    assert log.inputs["epoch"].tolist() == list(range(2, 12))
    assert log.bodies["revision"][-1] == world.revision


def test_states_are_thinned_out_when_asked(tmp_path):
    world, config = ground(), tahr.Config()
    mover, state = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 1))
    with Publisher(world, config, url=url_of(tmp_path / "thin.lcmlog"), every=10, prefix="arena/") as publisher:
        for step in range(100):
            publisher.step(mover, state, wish(step), DT)
    log = read_log(tmp_path / "thin.lcmlog")
    assert log.prefix == "arena/" and len(log.states) == 10 and len(log.inputs) == 100
    assert publisher.counts["state"]["thinned"] == 90


def test_what_finds_no_room_is_dropped_and_counted(tmp_path):
    world, config = ground(), tahr.Config()
    mover, state = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 1))
    with Publisher(world, config, url=url_of(tmp_path / "small.lcmlog"), ring_bytes=4096, bodies=0) as publisher:
        for step in range(5000):
            publisher.step(mover, state, wish(step), DT)
    counts = publisher.counts
    log = read_log(tmp_path / "small.lcmlog")
    for kind in ("state", "input", "report", "event"):
        kept = len(log.messages(kind))
        assert counts[kind]["offered"] == kept + counts[kind]["dropped"], kind
    assert counts["state"]["offered"] == 5000


def test_wrong_arguments_are_named(tmp_path):
    world, config = ground(), tahr.Config()
    good = url_of(tmp_path / "x.lcmlog")
    with pytest.raises(tahr.UnsupportedError, match="nonsense"):
        Publisher(world, config, url="nonsense://x")
    with pytest.raises(tahr.FileError, match="no/such/folder"):
        Publisher(world, config, url=url_of(tmp_path / "no/such/folder/x"))
    with pytest.raises(tahr.ArgumentError, match="characters"):
        Publisher(world, config, characters=0, url=good)
    with pytest.raises(tahr.ArgumentError, match="ring_bytes is -1"):
        Publisher(world, config, ring_bytes=-1, url=good)
    with pytest.raises(tahr.ArgumentError, match="state_rate"):
        Publisher(world, config, state_rate=float("nan"), url=good)
    mover, state = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 1))
    with Publisher(world, config, url=good) as publisher:
        with pytest.raises(tahr.NotFoundError):
            publisher.latest()
        before = state.copy()
        for wrong in (1, -1, "first"):
            with pytest.raises(tahr.ArgumentError, match="character is .*, expected 0 to 0"):
                publisher.step(mover, state, wish(0), DT, character=wrong)
            with pytest.raises(tahr.ArgumentError, match="config is .*, expected 0 to 0"):
                publisher.step(mover, state, wish(0), DT, config=wrong)
        with pytest.raises(tahr.ArgumentError, match="mover is a State, expected a tahr.Mover"):
            publisher.step(state, state, wish(0), DT)
        with pytest.raises(tahr.ArgumentError, match="input is a int, expected a tahr.Input"):
            publisher.step(mover, state, 5, DT)
        with pytest.raises(tahr.ArgumentError, match="dt"):
            publisher.step(mover, state, wish(0), -1.0)
        assert state == before
    with pytest.raises(tahr.ClosedError):
        publisher.step(mover, state, wish(0), DT)
    with pytest.raises(tahr.ClosedError):
        publisher.latest()
    publisher.close()


def test_more_characters_than_expected_are_refused(tmp_path):
    world, config = ground(), tahr.Config()
    places = np.c_[np.arange(4) * 2.0, np.zeros(4), np.ones(4)]
    crowd, states = tahr.Crowd(world, config, 4), tahr.states(config, places)
    with Publisher(world, config, characters=3, url=url_of(tmp_path / "few.lcmlog")) as publisher:
        with pytest.raises(tahr.ArgumentError, match="4 characters, expected up to 3"):
            publisher.step_crowd(crowd, tahr.inputs(4), DT, states)


def test_a_fork_cannot_publish_and_does_not_hang(tmp_path):
    world, config = ground(), tahr.Config()
    mover, state = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 1))
    with Publisher(world, config, url=url_of(tmp_path / "fork.lcmlog")) as publisher:
        publisher.step(mover, state, wish(0), DT)
        child = os.fork()
        if child == 0:
            code = 1
            try:
                publisher.step(mover, state, wish(0), DT)
            except tahr.UnsupportedError as error:
                code = 0 if "the process that forked" in str(error) else 2
            publisher.close()
            del publisher
            os._exit(code)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
        publisher.step(mover, state, wish(1), DT)
    assert len(read_log(tmp_path / "fork.lcmlog").states) == 2


def test_two_threads_at_once_are_refused_or_come_one_after_the_other(tmp_path):
    world, config = ground(), tahr.Config()
    refused, done = [], []

    def run(number):
        mover, state = tahr.Mover(world, config), tahr.State(config, position=(3.0 * number, 0, 1))
        for step in range(2000):
            try:
                publisher.step(mover, state, wish(step), DT, character=number)
                done.append(number)
            except tahr.ReentrantError:
                refused.append(number)

    with Publisher(world, config, characters=2, url=url_of(tmp_path / "two.lcmlog"), ring_bytes=1 << 24) as publisher:
        threads = [threading.Thread(target=run, args=(number,)) for number in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert len(done) + len(refused) == 4000
    assert publisher.counts["state"]["offered"] == len(done)


def test_the_example_of_a_published_walk_draws_it(tmp_path):
    pytest.importorskip("matplotlib")
    program = pathlib.Path(__file__).parents[2] / "bindings" / "python" / "examples" / "published_walk.py"
    command = [sys.executable, "-B", str(program), "--seconds", "3"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "1080 states, 18 steps up, 0 messages lost: walk.png\n"
    assert (tmp_path / "walk.png").read_bytes().startswith(b"\x89PNG")
    assert len(read_log(tmp_path / "walk.lcmlog").states) == 1080
