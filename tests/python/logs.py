# SPDX-License-Identifier: MIT
"""Logs that the tests of the telemetry share: of real movers, and of random messages of every kind."""

import numpy as np
import pytest
from scenes import DT, ground

import tahr

lcm = pytest.importorskip("lcm")
messages = pytest.importorskip("tahr.messages")

from tahr.telemetry import KINDS  # noqa: E402
from tahr.telemetry._wire import blank, fields  # noqa: E402

CHANNELS = {kind: f"TAHR_{kind.upper()}" for kind in KINDS}


def write(path, events):
    """A log of (channel, message or bytes)."""
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for i, (channel, message) in enumerate(events):
        log.write_event(1_000_000 + i, channel, message if isinstance(message, bytes) else message.encode())
    log.close()
    return path


def state_message(character, step, state):
    made = messages.state_t()
    made.character, made.step, made.sequence = character, step, step
    made.time_ns = round((step + 1) * DT * 1e9)
    made.wall_ns = 1_700_000_000_000_000_000 + made.time_ns
    for name in ("position", "velocity", "orientation", "up"):
        setattr(made, name, list(getattr(state, name)))
    made.mode, made.flags, made.radius, made.half_height = state.mode, state.flags, state.radius, state.half_height
    return made


def report_message(character, step, report):
    made = messages.report_t()
    made.character, made.step, made.sequence, made.time_ns = character, step, step, round((step + 1) * DT * 1e9)
    for name in ("sweeps", "contact_queries", "rays", "fluid_queries"):
        setattr(made, name, getattr(report, name))
    return made


def event_messages(character, step, report, first):
    for i, event in enumerate(report.events):
        made = messages.event_t()
        made.character, made.step, made.sequence, made.type = character, step, first + i, int(event["type"])
        made.time_ns = round((step * DT + event["time"]) * 1e9)
        made.position, made.body = list(event["position"]), -1
        yield made


def world_message(run=1, characters=1):
    made = messages.world_t()
    made.run, made.level, made.backend, made.version, made.characters = run, "flat", "native", "0.1.0", characters
    made.configs, made.level_hash = b"\x01\x02", -1
    made.size = len(made.configs)
    return made


def walk(characters=3, steps=90):
    """What characters that start above the ground, walk and jump are told of, as (channel, message)."""
    config = tahr.Config()
    mover = tahr.Mover(ground(), config)
    states = [tahr.State(config, position=(3.0 * i - 3, 0, 1.2)) for i in range(characters)]
    report, counts = tahr.Report(), [0] * characters
    told = [(CHANNELS["world"], world_message(characters=characters))]
    for step in range(steps):
        for number, state in enumerate(states):
            wish = tahr.Input(move=(np.cos(number), np.sin(number), 0), jump=step == 40)
            mover.step(state, wish, DT, report)
            told.append((CHANNELS["state"], state_message(number, step, state)))
            told.append((CHANNELS["report"], report_message(number, step, report)))
            for event in event_messages(number, step, report, counts[number]):
                told.append((CHANNELS["event"], event))
                counts[number] += 1
    return told


def random_value(value, kind, width, rng):
    """Something that a field of this type can hold, and that is not likely to be in another one too."""
    if isinstance(value, (list, tuple)):
        return [random_value(element, kind, width, rng) for element in value]
    if isinstance(value, bool):
        return bool(rng.integers(2))
    if isinstance(value, float):
        return float(rng.normal() * 1e3)
    bound = 2 ** (8 * width - 1)
    return int(rng.integers(-bound, bound))


def random_message(kind, rng):
    """A message all of whose fields hold something."""
    made = blank(kind)
    for field in fields(kind):
        setattr(made, field.name, random_value(getattr(made, field.name), field.letter, field.width, rng))
    if kind == "snapshot":
        made.state = rng.bytes(tahr.STATE.itemsize)
        made.size = len(made.state)
    return made
