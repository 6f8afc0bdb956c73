# SPDX-License-Identifier: MIT
"""One character: steps, snapshots, reports, settings."""

import pickle

import numpy as np
import pytest
from scenes import DT, TRIANGLES, VERTICES, ground, walk

import tahr


@pytest.mark.parametrize("backend", [name for name in tahr.backends() if name != "box2d"])
def test_walks_on_every_backend(backend):
    mover = tahr.Mover(ground(backend=backend))
    state = walk(mover, tahr.State(mover.config, (0, 0, 1)), 60)
    assert state.mode == tahr.MODE_WALKING and state.mode_name == "walking"
    assert 4 < state.position[0] < 6
    assert 0.9 + 0.01 <= state.position[2] <= 0.9 + 0.015 + 1e-9


def test_walks_in_two_dimensions():
    if "box2d" not in tahr.backends():
        pytest.skip("this package was built without Box2D")
    world = tahr.World([tahr.Body.box((50, 1, 1), position=(0, -1, 0))], backend="box2d")
    mover = tahr.Mover(world, tahr.Config("platformer"))
    state = walk(mover, tahr.State(mover.config, (0, 1, 0)), 60)
    assert state.mode == tahr.MODE_WALKING and state.position[0] > 4 and state.position[2] == 0


def test_a_snapshot_replays_to_the_same_hash():
    mover = tahr.Mover(ground())
    state = walk(mover, tahr.State(mover.config, (0, 0, 1)), 30)
    snapshot, first = state.copy(), []
    for _ in range(2):
        state.assign(snapshot)
        walk(mover, state, 30, (0.3, 1, 0))
        first.append((state.hash(), bytes(state)))
    assert first[0] == first[1]
    assert state != snapshot and snapshot == snapshot.copy()
    assert pickle.loads(pickle.dumps(state)) == state
    assert tahr.State.from_bytes(bytes(state)).hash() == state.hash()
    with pytest.raises(TypeError):
        hash(state)  # it changes


def test_a_state_keeps_its_memory_as_long_as_a_view_of_it_lives():
    normal = tahr.State(None, (1, 2, 3)).floor.normal
    position = tahr.State(None, (1, 2, 3)).position
    others = [tahr.State(None, (9, 9, 9)) for _ in range(200)]
    assert position.tolist() == [1, 2, 3] and normal.tolist() == [0, 0, 0] and len(others) == 200


def test_reports_tell_events_decisions_and_queries():
    mover = tahr.Mover(ground())
    state = tahr.State(mover.config, (0, 0, 2))
    report = tahr.Report(events=8, decisions=32, queries=32)
    seen = []
    for _ in range(60):
        mover.step(state, tahr.Input(), DT, report)
        seen += [(tahr.event_name(event["type"]), event["position"][2]) for event in report.events]
    assert [name for name, _ in seen].count("landed") == 1
    landed = next(height for name, height in seen if name == "landed")
    assert abs(landed - 0.91) < 0.01
    assert len(report.decisions) and report.explain()[0].split()[1] in ("accepted:", "refused:")
    assert report.queries.dtype == tahr.QUERY_RECORD and report.sweeps == len(report.queries)
    with pytest.raises(ValueError):
        report.decisions["reason"] = 1  # addresses of C: not to be written


def test_presets_and_settings_reach_the_library():
    assert tahr.Config("unreal").skin == 0.019
    assert tahr.Config(tahr.PRESET_PLATFORMER).gravity.tolist() == [0, -19.62, 0]
    config = tahr.Config(max_speed=2, gravity=(0, 0, -5), shape=tahr.Config("unreal").shape)
    assert config.shape.radius == 0.34
    mover = tahr.Mover(ground(), config)
    state = walk(mover, tahr.State(config, (0, 0, 1)), 120)
    assert abs(np.linalg.norm(state.velocity) - 2) < 1e-6
    assert config.scaled(2).max_speed == 4 and config.max_speed == 2


def test_the_config_of_a_mover_is_its_own():
    config = tahr.Config()
    mover = tahr.Mover(ground(), config)
    config.max_speed = 1
    assert mover.config.max_speed == 6


def test_teleport_forgets_the_floor():
    mover = tahr.Mover(ground())
    state = walk(mover, tahr.State(mover.config, (0, 0, 1)), 30)
    state.teleport((1, 2, 30))
    walk(mover, state, 1)
    assert state.mode == tahr.MODE_FALLING


def test_a_lift_carries_and_a_rollback_puts_it_back():
    lift = tahr.Body.box((2, 2, 0.1), position=(0, 0, 0), flags=tahr.BODY_MOVABLE)
    world = tahr.World([lift])
    mover = tahr.Mover(world)
    state = walk(mover, tahr.State(mover.config, (0, 0, 1.1)), 30, (0, 0, 0))
    before, revision = state.copy(), world.revision
    hashes = []
    for _ in range(2):
        state.assign(before)
        world.set(tahr.poses([0], [(0, 0, 0)]))
        assert world.revision == revision
        for tick in range(1, 31):
            world.move(tahr.poses([0], [(0, 0, tick / 30)]), DT)
            mover.step(state, tahr.Input(), DT)
        hashes.append(state.hash())
    assert hashes[0] == hashes[1]
    assert abs(state.position[2] - before.position[2] - 1) < 1e-6
    assert abs(world.body(0).velocity[2] - 2) < 1e-9


def test_the_world_answers_directly():
    world = ground()
    shape = tahr.Shape(type=tahr.SHAPE_SPHERE, radius=0.5, half_height=0.5)
    hits = world.sweep(tahr.Sweep(shape=shape, position=(0, 0, 2), motion=(0, 0, -3), margin=0.01))
    assert hits.dtype == tahr.HIT and len(hits) == 1 and abs(hits[0]["fraction"] * 3 - 1.49) < 1e-9
    near = world.contacts(tahr.ContactQuery(shape=shape, position=(0, 0, 0.6), margin=0.2))
    assert len(near) == 1 and abs(near[0]["distance"] - 0.1) < 1e-9
    hit = world.ray(tahr.Ray(origin=(1, 1, 5), motion=(0, 0, -10)))
    assert hit is not None and np.allclose(hit.point, (1, 1, 0)) and hit.body == 0
    assert world.ray(tahr.Ray(origin=(1, 1, 5), motion=(0, 0, 10))) is None
    pool = tahr.World([tahr.Body.box((1, 1, 1), flags=tahr.BODY_FLUID)])
    assert pool.fluid(tahr.FluidQuery(position=(0, 0, 0), radius=0.3, half_height=0.5)).immersion == 1
    assert pool.fluid(tahr.FluidQuery(position=(9, 0, 0), radius=0.3, half_height=0.5)).body == tahr.NO_BODY


def test_bodies_of_all_kinds_can_be_stood_on():
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 0)]
    for body in (
        tahr.Body.box((1, 1, 0.5), position=(0, 0, -0.5)),
        tahr.Body.sphere(5, position=(0, 0, -5)),
        tahr.Body.capsule(1, 2, position=(0, 0, -2)),
        tahr.Body.hull(corners),
        tahr.Body.heights(np.zeros((3, 4)), (5, 5)),
        tahr.Body.mesh(VERTICES, TRIANGLES.astype(int)),
    ):
        mover = tahr.Mover(tahr.World([body]))
        state = walk(mover, tahr.State(None, (0.01, 0, 1)), 60, (0, 0, 0))
        assert state.mode == tahr.MODE_WALKING, body.type


def test_options_reach_the_backend():
    hashes = set()
    for options in (None, {"no_cache": 1}, {"cache_triangles": 32, "no_simd": 1}):
        mover = tahr.Mover(ground(options=options))
        hashes.add(walk(mover, tahr.State(None, (0, 0, 1)), 30).hash())
    assert len(hashes) == 1
    with pytest.raises(tahr.ArgumentError, match="has no 'no_cash', expected some of"):
        ground(options={"no_cash": 1})
    with pytest.raises(tahr.ArgumentError, match="cache_triangles"):
        ground(options={"cache_triangles": 100_000})


def test_describe_and_what_the_world_says_of_itself():
    world = ground()
    assert "2 triangles" in "\n".join(world.describe())
    assert world.backend == "native" and world.memory > 0


def test_a_ladder_of_ones_own():
    def climb(step, time):
        assert step.gravity.tolist() == [0, 0, -9.81]
        way, hit = step.slide((0, 0, time * 2.0))
        step.set_velocity((0, 0, 2))
        step.event(0.0, 7.0)
        kept.append(step)
        if step.state.position[2] > 1.5:
            return tahr.MODE_FALLING, 0.0
        return None

    kept = []
    mover = tahr.Mover(ground())
    mover.set_custom_mode(climb)
    state = tahr.State(None, (0, 0, 1), mode=tahr.MODE_CUSTOM)
    report = tahr.Report()
    mover.step(state, tahr.Input(), 0.1, report)
    assert abs(state.position[2] - 1.2) < 1e-12
    assert [e["value"] for e in report.events if e["type"] == tahr.EVENT_CUSTOM] == [7.0]
    for _ in range(5):
        mover.step(state, tahr.Input(), 0.1)
    assert state.mode == tahr.MODE_FALLING
    with pytest.raises(tahr.ClosedError):
        kept[0].slide((0, 0, 1))

    def fail(step, time):
        raise KeyError("rung")

    mover.set_custom_mode(fail)
    state.mode = tahr.MODE_CUSTOM
    before = bytes(state)
    with pytest.raises(KeyError, match="rung"):
        mover.step(state, tahr.Input(), 0.1)
    assert bytes(state) == before


def test_a_recording_is_a_trace(tmp_path):
    world = ground()
    mover = tahr.Mover(world)
    state = tahr.State(None, (0, 0, 1))
    with world.recording(tmp_path / "walk.trace"):
        walk(mover, state, 20)
        with pytest.raises(tahr.InUseError):
            with world.recording(tmp_path / "again.trace"):
                pass
    size = (tmp_path / "walk.trace").stat().st_size
    assert size > 20 * 100
    walk(mover, state, 20)
    assert (tmp_path / "walk.trace").stat().st_size == size
    with pytest.raises(tahr.FileError):
        with world.recording(tmp_path / "nowhere" / "walk.trace"):
            pass
