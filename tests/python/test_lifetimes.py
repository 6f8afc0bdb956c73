# SPDX-License-Identifier: MIT
"""Closing, forgetting, threads and forks in whatever order: exceptions, never a crash."""

import gc
import os
import subprocess
import sys
import threading

import numpy as np
import pytest
from scenes import DT, ground, plane_sweep, walk

import tahr

N = 200


def test_a_world_with_movers_is_not_closed():
    world = ground()
    mover, crowd = tahr.Mover(world), tahr.Crowd(world, capacity=2)
    with pytest.raises(tahr.InUseError, match="movers or crowds of it are open"):
        world.close()
    walk(mover, tahr.State(None, (0, 0, 1)), 3)
    mover.close()
    with pytest.raises(tahr.InUseError):
        world.close()
    crowd.close()
    world.close()
    assert world.closed


def test_what_is_closed_says_so():
    world = ground()
    mover, crowd = tahr.Mover(world), tahr.Crowd(world, capacity=2)
    for thing in (mover, crowd, world):
        thing.close()
        thing.close()
    states = tahr.states(None, [(0, 0, 1)])
    for call in (
        lambda: mover.step(tahr.State(), tahr.Input(), DT),
        lambda: crowd.step(tahr.inputs(1), DT, states),
        lambda: crowd.counts(),
        lambda: mover.set_custom_mode(None),
        lambda: tahr.Mover(world),
        lambda: tahr.Crowd(world),
        lambda: world.ray(tahr.Ray(motion=(0, 0, -1))),
        lambda: world.touch(),
        lambda: world.revision,
        lambda: world.describe(),
        lambda: world.set(tahr.poses([0], [(0, 0, 0)])),
    ):
        with pytest.raises(tahr.ClosedError, match="closed"):
            call()


def test_with_closes():
    with ground() as world:
        with tahr.Mover(world) as mover, tahr.Crowd(world, capacity=2):
            walk(mover, tahr.State(None, (0, 0, 1)), 3)
    assert world.closed


def test_a_mover_keeps_its_world():
    mover = tahr.Mover(ground())
    gc.collect()
    assert walk(mover, tahr.State(None, (0, 0, 1)), 60).mode == tahr.MODE_WALKING


def test_forgotten_movers_do_not_keep_a_world_open():
    world = ground()
    mover = tahr.Mover(world)
    del mover
    gc.collect()
    world.close()


def test_a_crowd_forgotten_within_a_step_is_freed_after_it():
    crowds = []

    def sweep(query):
        crowds.clear()  # frees the crowd while its world is in use
        gc.collect()
        return plane_sweep(query)

    world = tahr.World.from_callbacks(sweep)
    mover = tahr.Mover(world)
    crowds.append(tahr.Crowd(world, capacity=2))
    walk(mover, tahr.State(None, (0, 0, 1)), 3)
    mover.close()
    world.close()


def test_an_interpreter_may_end_at_any_time():
    program = """
import tahr, sys
sys.path.insert(0, sys.argv[1])
from scenes import ground, plane_sweep
world = ground()
mover = tahr.Mover(world); crowd = tahr.Crowd(world, capacity=5, threads=2)
class Loop: pass
loop = Loop(); loop.self = loop; loop.things = [tahr.Mover(tahr.World.from_callbacks(plane_sweep)), world]
states = tahr.states(None, [(0, 0, 1)])
crowd.step(tahr.inputs(1), 0.1, states)
recording = world.recording(sys.argv[2]); mover.close(); recording.__enter__()
print("end")
"""
    here = os.path.dirname(os.path.abspath(__file__))
    for _ in range(3):
        done = subprocess.run(
            [sys.executable, "-c", program, here, os.devnull], capture_output=True, text=True, timeout=60
        )
        assert (done.returncode, done.stdout, done.stderr) == (0, "end\n", "")


def run_threads(functions):
    failed = []

    def guarded(function):
        try:
            function()
        except BaseException as error:
            failed.append(error)

    threads = [threading.Thread(target=guarded, args=(function,)) for function in functions]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert not any(thread.is_alive() for thread in threads)
    if failed:
        raise failed[0]


def test_movers_of_one_world_step_on_many_threads_with_the_same_bits():
    world, hashes = ground(), []

    def work():
        mover = tahr.Mover(world)
        hashes.append(walk(mover, tahr.State(None, (0, 0, 1)), N, (0.3, 0.7, 0)).hash())

    run_threads([work] * 8)
    assert len(hashes) == 8 and len(set(hashes)) == 1


def test_movers_and_crowds_come_and_go_while_others_step():
    world, hashes = ground(), []

    def step():
        mover = tahr.Mover(world)
        hashes.append(walk(mover, tahr.State(None, (0, 0, 1)), 10 * N).hash())

    def come_and_go():
        for _ in range(N):
            tahr.Mover(world)  # forgotten at once
            try:
                tahr.Crowd(world, capacity=2)
            except tahr.ReentrantError:
                pass  # the world is in use, which only its making minds

    run_threads([step, step, come_and_go])
    assert len(hashes) == 2 and len(set(hashes)) == 1
    world.close()  # nothing is left


def test_garbage_that_is_collected_does_not_take_the_message_along(monkeypatch):
    world = ground()
    mover = tahr.Mover(world)
    garbage, make = [tahr.Mover(world), tahr.Crowd(world), tahr.Mover(ground())], world._failed

    def collect_first(*arguments):
        garbage.clear()
        gc.collect()
        return make(*arguments)

    monkeypatch.setattr(world, "_failed", collect_first)
    with pytest.raises(tahr.ArgumentError, match="dt is -1"):
        mover.step(tahr.State(), tahr.Input(), -1)


def test_one_mover_on_many_threads_is_refused_or_steps_whole():
    mover, refused, stepped = tahr.Mover(ground()), [], []
    everybody = threading.Barrier(4)

    def work():
        state = tahr.State(None, (0, 0, 1))
        everybody.wait(60)
        for _ in range(20 * N):
            try:
                mover.step(state, tahr.Input(move=(1, 0, 0)), DT)
                stepped.append(1)
            except tahr.ReentrantError as error:
                refused.append(str(error))

    run_threads([work] * 4)
    assert len(stepped) + len(refused) == 4 * 20 * N and stepped
    assert all("in use already" in text for text in refused)


def test_a_mover_that_waits_in_a_callback_refuses_another_thread():
    inside, go_on, seen = threading.Event(), threading.Event(), []

    def sweep(query):
        inside.set()
        assert go_on.wait(60)
        return plane_sweep(query)

    world = tahr.World.from_callbacks(sweep)
    mover = tahr.Mover(world)

    def first():
        mover.step(tahr.State(None, (0, 0, 1)), tahr.Input(), DT)

    def second():
        assert inside.wait(60)
        for call in (
            lambda: mover.step(tahr.State(), tahr.Input(), DT),
            mover.close,
            world.close,
            world.touch,
            lambda: tahr.Crowd(world),
        ):
            try:
                call()
            except tahr.ReentrantError:
                seen.append(1)
        go_on.set()

    run_threads([first, second])
    assert len(seen) == 5


def test_changing_a_world_on_one_thread_while_others_step():
    world = tahr.World([tahr.Body.box((20, 20, 1), position=(0, 0, -1), flags=tahr.BODY_MOVABLE)])
    done = {"moved": 0, "stepped": 0, "refused": 0}
    lock = threading.Lock()

    def count(what):
        with lock:
            done[what] += 1

    def attempt(call, what):
        try:
            call()
            count(what)
        except tahr.ReentrantError:
            count("refused")

    def step():
        mover, state = tahr.Mover(world), tahr.State(None, (0, 0, 1))
        for _ in range(N):
            attempt(lambda: mover.step(state, tahr.Input(), DT), "stepped")

    def move():
        for i in range(N):
            attempt(lambda: world.move(tahr.poses([0], [(0, 0, -1 + 0.001 * (i % 2))]), DT), "moved")

    run_threads([step, step, move])
    assert sum(done.values()) == 3 * N and done["stepped"] and done["moved"]


def in_a_fork(function):
    """Runs function in a child; what it returns must be 0."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            code = function()
        finally:
            os._exit(code)
    _, status = os.waitpid(child, 0)
    assert os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0


needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")


@needs_fork
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("threads", [1, 2])
def test_movers_and_crowds_go_on_in_a_fork(threads):
    world = ground()
    mover, crowd = tahr.Mover(world), tahr.Crowd(world, capacity=N, threads=threads)
    places = np.column_stack([np.arange(N) % 20 * 1.5 - 15, np.arange(N) // 20 * 1.5 - 7, np.ones(N)])
    states = tahr.states(None, places)
    state = tahr.State(None, (0, 0, 1))
    wish = tahr.inputs(N)
    wish["move"][:, 0] = 1

    def go_on():
        mine, one = states.copy(), state.copy()
        for _ in range(20):
            crowd.step(wish, DT, mine)
        return tahr.hashes(mine).tolist(), walk(mover, one, 20).hash()

    crowd.step(wish, DT, states)
    expected = go_on()

    def child():
        same = go_on() == expected
        if os.path.isdir("/proc/self/task"):
            same = same and len(os.listdir("/proc/self/task")) == threads  # its own, not the parent's
        crowd.close()
        mover.close()
        world.close()
        return 0 if same else 3

    in_a_fork(child)
    assert go_on() == expected


@needs_fork
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_what_stepped_when_the_process_forked_is_refused_in_the_child():
    inside, go_on = threading.Event(), threading.Event()

    def sweep(query):
        inside.set()
        assert go_on.wait(60)
        return plane_sweep(query)

    world = tahr.World.from_callbacks(sweep)
    mover = tahr.Mover(world)
    stepper = threading.Thread(target=lambda: mover.step(tahr.State(None, (0, 0, 1)), tahr.Input(), DT))
    stepper.start()
    try:
        assert inside.wait(60)

        def child():
            try:
                mover.step(tahr.State(), tahr.Input(), DT)
            except tahr.ReentrantError:
                return 0
            return 4

        in_a_fork(child)
    finally:
        go_on.set()
        stepper.join(60)
