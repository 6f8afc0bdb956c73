# SPDX-License-Identifier: MIT
"""What is wrong is named, with what was expected; nothing has changed then."""

import builtins
import re

import numpy as np
import pytest
from scenes import DT, TRIANGLES, VERTICES, ground, walk

import tahr


@pytest.fixture
def mover():
    return tahr.Mover(ground())


def refuses(text, call, error=tahr.ArgumentError):
    with pytest.raises(error, match=re.escape(text)):
        call()


def test_exceptions_are_those_of_python_too():
    assert issubclass(tahr.ArgumentError, ValueError) and issubclass(tahr.ArgumentError, tahr.Error)
    assert issubclass(tahr.MemoryError, builtins.MemoryError)
    assert issubclass(tahr.FileError, OSError) and issubclass(tahr.NotFoundError, LookupError)


@pytest.mark.parametrize("dt", [-1, float("nan"), float("inf"), 2])
def test_a_wrong_dt_is_named(mover, dt):
    state = walk(mover, tahr.State(None, (0, 0, 1)), 5)
    before = bytes(state)
    refuses("Mover.step: dt is ", lambda: mover.step(state, tahr.Input(), dt))
    assert bytes(state) == before
    refuses("Crowd.step: ", lambda: tahr.Crowd(ground()).step(tahr.inputs(1), dt, tahr.states(None, [(0, 0, 1)])))


def test_a_wrong_input_or_state_is_named(mover):
    state = tahr.State(None, (0, 0, 1))
    refuses("input.move", lambda: mover.step(state, tahr.Input(move=(float("nan"), 0, 0)), DT))
    state.position[2] = float("inf")
    refuses("state.position", lambda: mover.step(state, tahr.Input(), DT))
    refuses("state is a int, expected a tahr.State", lambda: mover.step(1, tahr.Input(), DT))
    refuses("state is a Input, expected a tahr.State", lambda: mover.step(tahr.Input(), tahr.Input(), DT))
    refuses("input is a NoneType, expected a tahr.Input", lambda: mover.step(state, None, DT))
    refuses("report is a dict, expected a tahr.Report", lambda: mover.step(state, tahr.Input(), DT, {}))
    refuses("dt is 'soon', expected seconds", lambda: mover.step(state, tahr.Input(), "soon"))


def test_a_wrong_setting_is_named():
    refuses("max_speed is -1.0", lambda: tahr.Config(max_speed=-1))
    refuses("no field max_sped; did you mean max_speed?", lambda: tahr.Config(max_sped=1))
    refuses("preset is 'quick', expected one of precise", lambda: tahr.Config("quick"))
    refuses("preset is 99", lambda: tahr.Config(99))
    refuses("Config.max_speed: expected a number, got 'fast'", lambda: tahr.Config(max_speed="fast"))
    refuses("Config.max_slides: expected an integer", lambda: tahr.Config(max_slides=-1))
    refuses("Config.gravity: expected numbers of shape (3,)", lambda: tahr.Config(gravity=(0, 1)))
    refuses("Config.shape: expected a Shape", lambda: tahr.Config(shape=3))
    refuses("factor is 0", lambda: tahr.Config().scaled(0))
    config = tahr.Config()
    with pytest.raises(AttributeError):
        config.max_sped = 1
    config.shape.radius = float("nan")
    refuses("shape.radius", lambda: tahr.Mover(ground(), config))


def test_a_wrong_position_is_named():
    refuses("State.position: expected numbers of shape (3,)", lambda: tahr.State(None, (1, 2)))
    refuses("State: position is", lambda: tahr.State(None, (1, 2, float("nan"))))
    refuses("positions[1] is [1.0, 2.0, inf]", lambda: tahr.states(None, [(0, 0, 0), (1, 2, np.inf)]))
    refuses("expected 512 bytes, got 3", lambda: tahr.State.from_bytes(b"abc"))
    state = tahr.State(None, (1, 2, 3))
    refuses("teleport", lambda: state.teleport((0, 0, 1e9)))
    assert state.position.tolist() == [1, 2, 3]
    refuses("index is 2, expected one of 2", lambda: tahr.State.of(tahr.states(None, np.zeros((2, 3))), 2))


def test_a_wrong_mesh_is_named():
    refuses("vertices: expected numbers of shape (n, 3)", lambda: tahr.World.from_mesh(VERTICES[:, :2], TRIANGLES))
    refuses("vertices: expected numbers", lambda: tahr.World.from_mesh(VERTICES.astype(str), TRIANGLES))
    refuses("vertices: expected numbers", lambda: tahr.World.from_mesh(VERTICES + 0j, TRIANGLES))
    refuses("triangles: expected integers of shape (m, 3)", lambda: tahr.World.from_mesh(VERTICES, VERTICES[:2]))
    refuses("triangles[1] is [0, 2, 4]", lambda: tahr.World.from_mesh(VERTICES, [[0, 1, 2], [0, 2, 4]]))
    refuses("triangles[0] is [-1, 1, 2]", lambda: tahr.World.from_mesh(VERTICES, [[-1, 1, 2]]))
    refuses("heights: expected numbers of shape (rows", lambda: tahr.Body.heights([1, 2], (1, 1)))
    broken = VERTICES.copy()
    broken[3, 1] = np.nan
    with pytest.raises(tahr.GeometryError):
        tahr.World.from_mesh(broken, TRIANGLES)
    # Numbers of another type or order are no mistake: they are copied.
    same = tahr.World.from_mesh(np.asfortranarray(VERTICES.astype(np.float32)), TRIANGLES.astype(np.int64).tolist())
    assert same.revision == ground().revision


def test_a_wrong_body_is_named_by_its_index():
    refuses("bodies[1] is a str, expected a tahr.Body", lambda: tahr.World([tahr.Body.sphere(1), "box"]))
    with pytest.raises(tahr.Error, match=r"World: .*bodies\[1\]"):
        tahr.World([tahr.Body.sphere(1), tahr.Body.sphere(-1)])
    with pytest.raises(tahr.UnsupportedError, match="bod"):
        tahr.World([tahr.Body.cone(1, 1)])
    refuses("no backend 'bullet'; there are native", lambda: tahr.World(backend="bullet"), tahr.NotFoundError)
    refuses("World: backend: ", lambda: tahr.World(backend="/nowhere/libtahr_mine.so"), tahr.NotFoundError)
    refuses("sweep is None, expected a function", lambda: tahr.World.from_callbacks(None))


def crowd_refuses(text, error=tahr.ArgumentError, **changed):
    crowd = tahr.Crowd(ground(), capacity=4)
    states = tahr.states(None, np.column_stack([np.arange(4), np.zeros(4), np.ones(4)]))
    given = dict(inputs=tahr.inputs(4), dt=DT, states=states, members=tahr.members(4))
    given.update(changed)
    before = states.tobytes()
    refuses(text, lambda: crowd.step(**given), error)
    assert states.tobytes() == before


def test_arrays_of_the_wrong_dtype_shape_or_order_are_named():
    crowd_refuses("states has dtype float64, expected tahr.STATE", states=np.zeros(4))
    crowd_refuses("states is a list, expected a NumPy array of dtype tahr.STATE", states=[1, 2])
    crowd_refuses("states is a NoneType", states=None)
    crowd_refuses("states has shape (2, 2), expected (n,)", states=np.zeros((2, 2), tahr.STATE))
    crowd_refuses("inputs has 3 elements, expected 4", inputs=tahr.inputs(3))
    crowd_refuses("inputs has dtype ", inputs=np.zeros(4, tahr.STATE))
    crowd_refuses("states is not contiguous", states=np.zeros(8, tahr.STATE)[::2])
    crowd_refuses("members has 5 elements, expected 4", members=tahr.members(5))
    crowd_refuses("statuses has dtype int64, expected np.int32", statuses=np.zeros(4, np.int64))
    crowd_refuses("reports has dtype", reports=np.zeros(4))
    crowd_refuses("events without reports", events=np.zeros((4, 2), tahr.EVENT))
    reports = np.zeros(4, tahr.REPORT)
    crowd_refuses("expected tahr.EVENT of shape (4, room)", reports=reports, events=np.zeros(4, tahr.EVENT))
    crowd_refuses("expected tahr.EVENT of shape (4, room)", reports=reports, events="x")
    swapped = tahr.STATE.newbyteorder()
    crowd_refuses("states has dtype", states=np.zeros(4, swapped))


def test_arrays_that_must_not_be_written_are_named():
    states = tahr.states(None, np.zeros((4, 3)))
    states.flags.writeable = False
    crowd_refuses("states is read-only, expected a writeable array", states=states)
    wish = np.zeros(4, tahr.INPUT)
    wish.flags.writeable = False
    crowd_refuses("inputs is read-only without struct_size; make it with tahr.inputs(n)", inputs=wish)
    refuses("states is read-only", lambda: tahr.State.of(states, 0))


def test_what_the_library_refuses_names_the_character():
    twice = tahr.members(4)
    twice["id"] = [0, 1, 2, 1]
    crowd_refuses("id", members=twice)
    wild = tahr.members(4)
    wild["config"][2] = 7
    crowd_refuses("members[2].config", members=wild)
    large = tahr.inputs(4)
    large["struct_size"] = 1 << 20  # would be a stride into nowhere
    crowd_refuses("inputs[0].struct_size is 1048576", error=tahr.StructSizeError, inputs=large)
    mixed = tahr.inputs(4)
    mixed["struct_size"][2] = 3
    crowd_refuses("inputs[2].struct_size", error=tahr.StructSizeError, inputs=mixed)
    crowd_refuses(
        "count",
        inputs=tahr.inputs(5),
        members=None,
        states=tahr.states(None, np.ones((5, 3)) * [[i] for i in range(5)]),
    )


@pytest.mark.parametrize("threads", [1, 2])
def test_a_character_that_fails_is_named_and_the_others_go_on(threads):
    crowd = tahr.Crowd(ground(), capacity=4, threads=threads)
    states = tahr.states(None, np.column_stack([np.arange(4) * 3.0, np.zeros(4), np.full(4, 5.0)]))
    before = states.copy()
    statuses = np.zeros(4, np.int32)
    wish = tahr.inputs(4)
    wish["move"][2, 1] = np.nan
    with pytest.raises(tahr.ArgumentError, match=r"character 2, at index 2.*input\.move"):
        crowd.step(wish, DT, states, statuses=statuses)
    assert statuses.tolist() == [0, 0, tahr.E_ARGUMENT, 0]
    assert (states[2] == before[2]) and (states["position"][[0, 1, 3], 2] < 5).all()


def test_a_crowd_of_the_wrong_size_is_named():
    for name, value in (("capacity", 0), ("capacity", 1 << 23), ("threads", 300), ("threads", -1), ("tasks", 5000)):
        refuses(f"{name} is {value}", lambda: tahr.Crowd(ground(), **{name: value}))
    refuses("configs[1] is a str", lambda: tahr.Crowd(ground(), [tahr.Config(), "quick"]))
    refuses("config_count", lambda: tahr.Crowd(ground(), []))
    refuses("world is a str, expected a tahr.World", lambda: tahr.Crowd("world"))


def test_wrong_poses_and_bodies_are_named():
    world = tahr.World([tahr.Body.box((1, 1, 1), flags=tahr.BODY_MOVABLE), tahr.Body.sphere(1, position=(5, 0, 0))])
    refuses("5", lambda: world.set(tahr.poses([5], [(0, 0, 0)])), tahr.NotFoundError)
    refuses("TAHR_BODY_MOVABLE", lambda: world.set(tahr.poses([1], [(0, 0, 0)])))
    refuses("dt is 0", lambda: world.move(tahr.poses([0], [(0, 0, 0)]), 0))
    refuses("poses: positions: expected numbers of shape (1, 3)", lambda: tahr.poses([0], (0, 0, 0)))
    refuses("poses: bodies is [-1]", lambda: tahr.poses([-1], [(0, 0, 0)]))
    refuses("poses has dtype", lambda: world.set(np.zeros(1)))
    refuses("World.body", lambda: world.body(9), tahr.NotFoundError)
    refuses("World.sweep", lambda: world.sweep(tahr.Sweep()))


def test_sizes_and_addresses_that_c_trusts_cannot_be_written():
    report, body = tahr.Report(events=2), tahr.Body.mesh(VERTICES, TRIANGLES)
    refuses("Report.event_capacity: is 2, and not to be set", lambda: setattr(report, "event_capacity", 1 << 20))
    refuses("Report.decision_count: is 0", lambda: setattr(report, "decision_count", 9))
    refuses("Body.vertex_count: is 4", lambda: setattr(body, "vertex_count", 1 << 20))
    refuses("Body.triangle_count", lambda: tahr.Body.mesh(VERTICES, TRIANGLES, triangle_count=1 << 20))
    for record in (report, body, tahr.Input(), tahr.Config()):
        with pytest.raises(ValueError):
            record.array["struct_size"] = 1 << 20
    wild = tahr.inputs(1)
    wild["struct_size"] = 1 << 20
    state, one = tahr.State(None, (0, 0, 1)), tahr.Input.from_bytes(wild[0].tobytes())
    assert tahr.Mover(ground()).step(state, one, DT) == tahr.OK
    state.array["velocity"] = (1, 2, 3)  # a state has neither
    assert state.velocity.tolist() == [1, 2, 3]
    refuses("has no 'struct_size'", lambda: ground(options={"struct_size": 1 << 20}))
