# SPDX-License-Identifier: MIT
"""Many characters: arrays, threads, the same bits as one by one."""

import sys
import threading
import time

import numpy as np
import pytest
from scenes import DT, ground

import tahr

N = 300


def square(n=N):
    side = int(np.ceil(np.sqrt(n)))
    x, y = np.divmod(np.arange(n), side)
    return np.column_stack([x * 1.5 - side * 0.75, y * 1.5 - side * 0.75, np.full(n, 1.0)])


def to_the_middle(states):
    wish = tahr.inputs(len(states))
    wish["move"] = -states["position"]
    return wish


def run(threads, ticks=60, n=N, **more):
    states = tahr.states(None, square(n))
    with tahr.Crowd(ground(), capacity=n, threads=threads) as crowd:
        for _ in range(ticks):
            crowd.step(to_the_middle(states), DT, states, **more)
    return states


def test_the_same_bits_on_any_number_of_threads():
    one = run(1)
    for threads in (2, 3):
        assert (tahr.hashes(run(threads)) == tahr.hashes(one)).all()
    assert len(set(tahr.hashes(one).tolist())) == N


def test_nobody_is_in_another_one():
    places = run(2, 120)["position"]
    gaps = np.linalg.norm(places[:, None, :2] - places[None, :, :2], axis=-1) + 10 * np.eye(N)
    assert gaps.min() > 0.7  # two radii


def test_alone_a_crowd_steps_as_movers_do():
    world = ground()
    states = tahr.states(None, square())
    members = tahr.members(N)
    members["flags"] = tahr.MEMBER_ALONE
    mover, crowd = tahr.Mover(world), tahr.Crowd(world, capacity=N)
    singles = states.copy()
    wish = tahr.inputs(N)
    wish["move"][:, 0] = 1
    one = tahr.Input(move=(1, 0, 0))
    for _ in range(20):
        crowd.step(wish, DT, states, members=members)
        for i in range(N):
            mover.step(tahr.State.of(singles, i), one, DT)
    assert (tahr.hashes(states) == tahr.hashes(singles)).all()


def test_states_are_stepped_in_place_and_zeroed_inputs_are_set_up():
    crowd = tahr.Crowd(ground(), capacity=4)
    states = tahr.states(None, square(4))
    view = states["position"]
    wish = np.zeros(4, tahr.INPUT)
    assert crowd.step(wish, DT, states) == tahr.OK
    assert (view[:, 2] < 1).all() and (wish["struct_size"] == tahr.INPUT.itemsize).all()
    wish.flags.writeable = False
    crowd.step(wish, DT, states)  # read-only inputs will do


def test_reports_events_statuses_and_counts():
    crowd = tahr.Crowd(ground(), capacity=9, threads=2)
    states = tahr.states(None, square(9))
    reports, events = np.zeros(9, tahr.REPORT), np.zeros((9, 4), tahr.EVENT)
    statuses = np.full(9, 99, np.int32)
    landed = np.zeros(9, bool)
    for _ in range(30):
        crowd.step(tahr.inputs(9), DT, states, reports=reports, events=events, statuses=statuses)
        for i in range(9):
            landed[i] |= tahr.EVENT_LANDED in events[i, : reports["event_count"][i]]["type"]
    assert landed.all() and (statuses == 0).all()
    assert crowd.counts().ticks == 30 and crowd.counts().steps == 270


def test_a_budget_needs_delays_and_saves_steps():
    crowd = tahr.Crowd(ground(), capacity=9)
    states, members = tahr.states(None, square(9)), tahr.members(9)
    members["budget"] = 0.2
    members["flags"] = tahr.MEMBER_ALONE
    with pytest.raises(tahr.ArgumentError, match="budget"):
        crowd.step(tahr.inputs(9), DT, states, members=members)
    delays = np.zeros(9, tahr.DELAY)
    wish = tahr.inputs(9)
    wish["move"][:, 0] = 1
    for _ in range(90):
        crowd.step(wish, DT, states, members=members, delays=delays)
    assert crowd.counts().deferred > 100


def test_other_python_threads_run_while_a_crowd_steps():
    crowd = tahr.Crowd(ground(), capacity=2000)
    states, wish = tahr.states(None, square(2000)), tahr.inputs(2000)
    seen, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            seen[0] += 1
            time.sleep(0)  # hands the interpreter's lock back

    interval = sys.getswitchinterval()
    counter = threading.Thread(target=count)
    counter.start()
    try:
        sys.setswitchinterval(1e6)  # nobody loses the lock who does not give it away
        before, ticks = seen[0], 0
        while seen[0] - before < 10 and ticks < 10_000:
            crowd.step(wish, DT, states)
            ticks += 1
        assert seen[0] - before >= 10
    finally:
        sys.setswitchinterval(interval)
        stop.set()
        counter.join()


def test_several_configs():
    slow, fast = tahr.Config(max_speed=1), tahr.Config(max_speed=8)
    crowd = tahr.Crowd(ground(), [slow, fast], capacity=2)
    members = tahr.members(2)
    members["config"] = [0, 1]
    states = tahr.states(slow, [(0, -3, 1), (0, 3, 1)])
    wish = tahr.inputs(2)
    wish["move"][:, 0] = 1
    for _ in range(90):
        crowd.step(wish, DT, states, members=members)
    assert np.allclose(states["velocity"][:, 0], [1, 8])
