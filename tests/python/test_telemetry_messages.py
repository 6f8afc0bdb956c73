# SPDX-License-Identifier: MIT
"""Messages as the generated types have them, and as arrays."""

import numpy as np
import pytest
from logs import random_message

import tahr
from tahr import messages
from tahr.telemetry import KINDS
from tahr.telemetry._decode import decode
from tahr.telemetry._wire import layout


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "world"])
def test_arrays_hold_what_the_generated_type_decodes(kind):
    rng = np.random.default_rng(7)
    payloads = [random_message(kind, rng).encode() for _ in range(50)]
    array, good, faults = decode(kind, payloads)
    assert good == list(range(50)) and faults == []
    for row, payload in zip(array, payloads):
        expected = KINDS[kind].decode(payload)
        for name in KINDS[kind].__slots__:
            value = getattr(expected, name)
            if name == "size":
                continue
            if name == "state":
                assert row[name].tobytes() == value
            elif name.endswith("_hash"):
                assert int(row[name]) == value % 2**64
            else:
                assert np.array_equal(row[name], value), name


@pytest.mark.parametrize("kind", ["state", "event", "input", "report", "body"])
def test_layout_covers_every_byte_of_a_message(kind):
    wire = layout(kind).wire
    covered = np.zeros(wire.itemsize, int)
    for name in wire.names:
        field, offset = wire.fields[name][:2]
        covered[offset : offset + field.itemsize] += 1
    assert covered[:8].sum() == 0 and (covered[8:] == 1).all()
    assert len(KINDS[kind]().encode()) == wire.itemsize


def test_worlds_keep_texts_and_bytes():
    world = messages.world_t()
    world.level, world.backend, world.configs, world.size = "Höhle", "native", b"\x00\xff", 2
    world.level_hash, world.run, world.state_rate, world.characters = -1, 5, 2.5, 7
    array, _, faults = decode("world", [world.encode()])
    assert faults == []
    row = array[0]
    assert (row["level"], row["backend"], row["configs"]) == ("Höhle", "native", b"\x00\xff")
    assert (row["level_hash"], row["run"], row["state_rate"], row["characters"]) == (2**64 - 1, 5, 2.5, 7)


def test_a_message_of_the_wrong_length_is_a_fault_and_the_others_are_kept():
    rng = np.random.default_rng(1)
    whole = [random_message("event", rng).encode() for _ in range(3)]
    array, good, faults = decode("event", [whole[0], whole[1][:-1], whole[1] + b"x", whole[2]])
    assert good == [0, 3] and len(array) == 2
    assert [index for index, _ in faults] == [1, 2]
    assert "115 bytes, expected 116" in faults[0][1]


def test_a_snapshot_of_another_size_of_state_is_a_fault():
    message = random_message("snapshot", np.random.default_rng(2))
    message.state, message.size = b"\x00" * 8, 8
    array, good, faults = decode("snapshot", [message.encode()])
    assert len(array) == 0 and good == [] and "expected" in faults[0][1]


def test_snapshots_hold_states_of_the_library():
    config = tahr.Config()
    state = tahr.State(config, position=(1, 2, 3))
    message = messages.snapshot_t()
    message.state, message.size = bytes(state), len(bytes(state))
    message.state_hash = state.hash() - 2**64 if state.hash() >= 2**63 else state.hash()
    row = decode("snapshot", [message.encode()])[0]
    assert row["state"].base is not None  # a view into the array
    assert np.array_equal(row["state"]["position"][0], [1, 2, 3])
    assert tahr.hashes(np.ascontiguousarray(row["state"]))[0] == row["state_hash"][0] == state.hash()


def test_constants_are_those_of_the_library():
    modes, events = messages.constants(messages.state_t, "MODE_"), messages.constants(messages.event_t)
    assert modes == {getattr(tahr, f"MODE_{name.upper()}"): name for name in modes.values()}
    assert events == {number: tahr.event_name(number) for number in events}
    assert len(modes) == 7 and len(events) == 21
