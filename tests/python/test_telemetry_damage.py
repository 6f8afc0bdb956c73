# SPDX-License-Identifier: MIT
"""Logs that were cut off or spoilt: what can be read is kept, and it is said at which byte something is wrong."""

import struct
import warnings

import numpy as np
import pytest
from logs import CHANNELS, walk, write

from tahr.telemetry import LogWarning, read_log

HEADER = 28


@pytest.fixture(scope="module")
def told():
    return walk(characters=2, steps=50)


@pytest.fixture(scope="module")
def sound(told, tmp_path_factory):
    return write(tmp_path_factory.mktemp("damage") / "sound.lcmlog", told).read_bytes()


@pytest.fixture(scope="module")
def begins(told):
    """Where each event begins, and where the last one ends."""
    sizes = [HEADER + len(channel) + len(message.encode()) for channel, message in told]
    return np.concatenate([[0], np.cumsum(sizes)])


def read(path, data):
    path.write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LogWarning)
        return read_log(path)


def kept(log):
    return sum(len(log.messages(kind)) for kind in ("state", "report", "event", "world"))


def test_a_log_cut_anywhere_keeps_what_is_before(sound, begins, told, tmp_path):
    rng = np.random.default_rng(3)
    last = int(begins[-2])
    cuts = {*range(last + 1, len(sound)), *rng.integers(40, len(sound), 200).tolist()}
    for cut in sorted(cuts):
        log = read(tmp_path / "cut.lcmlog", sound[:cut])
        whole = int(np.searchsorted(begins, cut, side="right")) - 1
        assert kept(log) == whole, cut
        if cut == begins[whole]:
            assert log.problems == []
        else:
            assert [problem.byte for problem in log.problems] == [begins[whole]], cut
            if cut >= begins[whole] + 4:
                assert "the file ends inside of an event" in log.problems[0].text


def test_garbage_between_events_is_left_out(sound, begins, told, tmp_path):
    at = int(begins[100])
    log = read(tmp_path / "garbage.lcmlog", sound[:at] + b"\x00garbage\xed\xa1" * 10 + sound[at:])
    assert kept(log) == len(told)
    assert [tuple(problem) for problem in log.problems] == [(at, "100 bytes that belong to no event")]


def test_garbage_before_the_first_event_is_left_out(sound, told, tmp_path):
    log = read(tmp_path / "before.lcmlog", b"garbage" + sound)
    assert kept(log) == len(told) and log.problems[0].byte == 0


def spoil(data, at, new):
    return data[:at] + new + data[at + len(new) :]


@pytest.mark.parametrize("length", [-1, 0, 1000, 2**31 - 1])
def test_an_event_with_an_impossible_channel_is_left_out(sound, begins, told, tmp_path, length):
    at = int(begins[50])
    log = read(tmp_path / "channel.lcmlog", spoil(sound, at + 20, struct.pack(">i", length)))
    assert kept(log) == len(told) - 1
    assert [problem.byte for problem in log.problems] == [at]


@pytest.mark.parametrize("change", [-7, 1, 300, 10**9])
def test_an_event_of_a_wrong_length_takes_no_other_one_with_it(sound, begins, told, tmp_path, change):
    at = int(begins[50])
    length = struct.unpack_from(">i", sound, at + 24)[0]
    log = read(tmp_path / "length.lcmlog", spoil(sound, at + 24, struct.pack(">i", length + change)))
    assert kept(log) == len(told) - 1
    assert log.problems[0].byte == at


def test_a_channel_that_is_no_text_is_none_of_ours(sound, begins, told, tmp_path):
    log = read(tmp_path / "text.lcmlog", spoil(sound, int(begins[70]) + HEADER, b"\xff\xfe"))
    assert kept(log) == len(told) - 1 and log.others == 1


def test_a_spoilt_beginning_of_an_event_costs_only_that_one(sound, begins, told, tmp_path):
    at = int(begins[120])
    log = read(tmp_path / "sync.lcmlog", spoil(sound, at, b"\x00"))
    assert log.problems[0].text.endswith("bytes that belong to no event")
    assert kept(log) == len(told) - 1
    assert [problem.byte for problem in log.problems] == [at]


def test_a_sync_word_inside_of_a_message_harms_nothing(told, tmp_path):
    channel, message = next((c, m) for c, m in told if c == CHANNELS["state"])
    data = message.encode()
    data = data[:60] + b"\xed\xa1\xda\x01" + data[64:]
    log = read(tmp_path / "inside.lcmlog", write(tmp_path / "x", [*told, (channel, data), *told]).read_bytes())
    assert kept(log) == 2 * len(told) + 1 and log.problems == []


def test_any_byte_may_be_wrong(sound, begins, told, tmp_path):
    """Whatever one byte becomes: at most two events are lost, and no other message changes."""
    rng = np.random.default_rng(11)
    before = read(tmp_path / "sound.lcmlog", sound)
    known = {(row["character"], row["step"]): str(row) for row in before.states}
    for at in rng.integers(0, len(sound), 150):
        new = bytes([sound[at] ^ int(rng.integers(1, 256))])
        log = read(tmp_path / "byte.lcmlog", spoil(sound, int(at), new))
        missing = len(told) - kept(log) - log.foreign - log.others
        assert 0 <= missing <= 2, at
        assert missing == 0 or log.problems, at
        changed = [row for row in log.states if known.get((row["character"], row["step"])) != str(row)]
        assert len(changed) <= 1, at


def test_damage_is_warned_of_with_its_place(sound, begins, tmp_path):
    path = tmp_path / "warned.lcmlog"
    path.write_bytes(sound[: int(begins[30]) + 35])
    with pytest.warns(LogWarning, match=rf"warned.lcmlog: byte {begins[30]}: the file ends inside of an event, 35 of"):
        read_log(path)
