# SPDX-License-Identifier: MIT
"""Worlds behind Python functions."""

import traceback

import numpy as np
import pytest
from scenes import DT, plane_sweep, walk

import tahr


def test_the_quick_start_of_c_comes_out_the_same():
    mover = tahr.Mover(tahr.World.from_callbacks(plane_sweep))
    state = tahr.State(None, (0, 0, 1))
    for i in range(60):
        mover.step(state, tahr.Input(move=(1, 0, 0), jump=int(i == 30)), DT)
    assert f"{state.mode_name} at {state.position[0]:.3f} m" == "falling at 4.547 m"


def test_what_a_function_raises_comes_out_of_the_step_with_its_traceback():
    def sweep(query):
        raise KeyError("no such wall")

    mover = tahr.Mover(tahr.World.from_callbacks(sweep))
    state = tahr.State(None, (0, 0, 1))
    before = bytes(state)
    with pytest.raises(KeyError, match="no such wall") as caught:
        walk(mover, state, 1)
    assert "in sweep" in "".join(traceback.format_tb(caught.value.__traceback__))
    assert bytes(state) == before


@pytest.mark.parametrize("threads", [1, 2])
def test_out_of_a_crowd_too(threads):
    def sweep(query):
        if query.position[0] > 10:
            raise RuntimeError("beyond the world")
        return plane_sweep(query)

    crowd = tahr.Crowd(tahr.World.from_callbacks(sweep), capacity=3, threads=threads)
    states = tahr.states(None, [(0, 0, 1), (5, 0, 1), (20, 0, 1)])
    with pytest.raises(RuntimeError, match="beyond the world"):
        crowd.step(tahr.inputs(3), DT, states)
    assert states["velocity"][:, 2].tolist()[2] == 0 and states["velocity"][0, 2] < 0


@pytest.mark.parametrize("answer", [1, "wall", tahr.Contact(), [tahr.Hit()]])
def test_an_answer_of_the_wrong_type_is_named(answer):
    mover = tahr.Mover(tahr.World.from_callbacks(lambda query: answer))
    with pytest.raises(tahr.ArgumentError, match="sweep: expected the function to return a tahr.Hit"):
        walk(mover, tahr.State(None, (0, 0, 1)), 1)


def test_a_wrong_answer_is_a_backend_error():
    mover = tahr.Mover(tahr.World.from_callbacks(lambda query: tahr.Hit(blocking=1, fraction=float("nan"))))
    with pytest.raises(tahr.BackendError, match="fraction"):
        walk(mover, tahr.State(None, (0, 0, 1)), 1)


def test_contacts_ray_sensors_body_and_fluid_are_asked():
    asked = set()

    def contacts(query):
        asked.add("contacts")
        gap = query.position[2] - query.shape.half_height
        return [tahr.Contact(distance=gap, normal=(0, 0, 1), point=(0, 0, 0))] if gap <= query.margin else []

    def ray(query):
        asked.add("ray")
        return tahr.Hit(blocking=1, fraction=0.5, normal=(0, 0, 1))

    def sensors(query):
        asked.add("sensors")
        return [tahr.Hit(sensor=1, body=7, start_overlap=1)] if abs(query.position[0]) < 1 else []

    def body(number):
        asked.add("body")
        motion = tahr.BodyMotion(velocity=(1, 0, 0))
        motion.pose.position = (tick * DT, 0, 0)
        return motion

    def fluid(query):
        asked.add("fluid")
        return None

    world = tahr.World.from_callbacks(plane_sweep, contacts=contacts, ray=ray, sensors=sensors, body=body, fluid=fluid)
    mover, report = tahr.Mover(world), tahr.Report(events=16)
    state = tahr.State(None, (0, 0, 1))
    for tick in range(30):
        world.touch()
        mover.step(state, tahr.Input(), DT, report)
    assert world.ray(tahr.Ray(origin=(0, 0, 1), motion=(0, 0, -2))).fraction == 0.5
    assert len(world.contacts(tahr.ContactQuery(shape=mover.config.shape, position=(0, 0, 0.8), margin=0.1))) == 1
    assert asked == {"contacts", "ray", "sensors", "body", "fluid"}
    assert state.touched_count == 1 and state.touched[0] == 7
    assert state.position[0] > 0.2  # carried


def test_a_query_may_be_kept():
    kept = []

    def sweep(query):
        kept.append(query)
        return plane_sweep(query)

    walk(tahr.Mover(tahr.World.from_callbacks(sweep)), tahr.State(None, (3, 0, 1)), 10, (0, 0, 0))
    assert {float(query.position[0]) for query in kept} == {3.0}
    assert all(np.isfinite(query.motion).all() for query in kept)


def test_calling_back_into_the_mover_or_changing_its_world_is_refused():
    seen = []

    def sweep(query):
        for call in (
            lambda: mover.step(tahr.State(), tahr.Input(), DT),
            mover.close,
            world.touch,
            world.close,
        ):
            try:
                call()
            except tahr.ReentrantError as error:
                seen.append(str(error))
        assert world.revision  # asking is allowed
        return plane_sweep(query)

    world = tahr.World.from_callbacks(sweep)
    mover = tahr.Mover(world)
    walk(mover, tahr.State(None, (0, 0, 1)), 1)
    assert len(seen) % 4 == 0 and seen
    assert "Mover.step: this mover or crowd is in use already" in seen[0]
    assert "the world is in use" in seen[2]
