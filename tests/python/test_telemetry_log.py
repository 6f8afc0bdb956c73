# SPDX-License-Identifier: MIT
"""Logs as arrays: what is in them, what is lost, foreign or of another run."""

import warnings

import numpy as np
import pytest
from logs import CHANNELS, walk, world_message, write

import tahr
from tahr import messages
from tahr.telemetry import Log, LogWarning, ranges, read_log


@pytest.fixture(scope="module")
def told():
    return walk()


@pytest.fixture(scope="module")
def log(told, tmp_path_factory):
    return read_log(write(tmp_path_factory.mktemp("log") / "walk.lcmlog", told))


def test_everything_that_was_told_is_in_the_log_in_its_order(log, told):
    for kind in ("state", "report", "event"):
        sent = [message for channel, message in told if channel == CHANNELS[kind]]
        got = log.messages(kind)
        assert len(got) == len(sent) > 0
        assert [m.character for m in sent] == got["character"].tolist()
        assert [m.time_ns for m in sent] == got["time_ns"].tolist()
    positions = [message.position for channel, message in told if channel == CHANNELS["state"]]
    assert np.array_equal(log.states["position"], positions)
    assert log.problems == [] and log.foreign == 0 and log.others == 0
    assert log.characters.tolist() == [0, 1, 2]
    assert log.worlds["level"].tolist() == ["flat"]
    assert len(log.inputs) == len(log.snapshots) == len(log.bodies) == 0
    assert "270 states" in repr(log)


def test_movement_in_the_log_is_that_of_the_movers(log):
    first = log.of(0).states
    assert tahr.MODE_WALKING in first["mode"] and tahr.MODE_FALLING in first["mode"]
    names = {tahr.event_name(int(number)) for number in log.events["type"]}
    assert {"landed", "jumped", "left_ground"} <= names


@pytest.mark.parametrize("count", [1, 4])
def test_lost_messages_are_counted_by_their_numbers(told, tmp_path, count):
    lost = range(10, 10 + count)
    kept = [(c, m) for c, m in told if not (c == CHANNELS["state"] and m.character == 1 and m.step in lost)]
    log = read_log(write(tmp_path / "gaps.lcmlog", kept))
    assert log.lost == {"state": count, "event": 0, "input": 0, "report": 0, "snapshot": 0}


def test_characters_can_be_chosen(log):
    chosen = log.of([0, 2])
    assert chosen.characters.tolist() == [0, 2]
    assert len(chosen.states) == 180 and len(chosen.worlds) == 1
    assert np.array_equal(log.of(1).states, log.states[log.states["character"] == 1])
    assert log.of(None) is log
    with pytest.raises(ValueError, match=r"no message of character 7; there are 0-2"):
        log.of([0, 7])


def test_a_time_can_be_chosen(log):
    part = log.between(0.5, 1.0)
    assert part.states["time_ns"].min() > 500_000_000 and part.states["time_ns"].max() == 1_000_000_000
    assert len(part.states) == 3 * 30 and len(part.worlds) == 1
    assert len(log.between(-np.inf, np.inf).states) == len(log.states)
    with pytest.raises(ValueError, match="begin is 1 s and end 1 s"):
        log.between(1, 1)


def test_kinds_have_names(log):
    assert log.messages("states") is log.messages("state")
    assert log.bodies is log.messages("bodies")
    with pytest.raises(ValueError, match="no kind of messages is called 'stat'; there are state, event"):
        log.messages("stat")


def test_runs_are_told_apart(told, tmp_path):
    again = [(CHANNELS["world"], world_message(run=2)), *told[1:101]]
    log = read_log(write(tmp_path / "runs.lcmlog", [*told, *again]))
    first, second = log.runs
    assert len(first.states) == 270
    assert len(second.states) == sum(channel == CHANNELS["state"] for channel, _ in again)
    assert second.worlds["run"].tolist() == [2]
    assert len(first.runs) == 1 and log.lost["state"] == 0


def test_foreign_messages_are_counted_and_ignored(told, tmp_path):
    state = next(message for channel, message in told if channel == CHANNELS["state"]).encode()
    other_version = bytes([state[0] ^ 1]) + state[1:]
    more = [(CHANNELS["state"], other_version), (CHANNELS["event"], state), (CHANNELS["state"], b"")]
    more += [("POSE", b"another program's"), ("POSE", state)]
    log = read_log(write(tmp_path / "foreign.lcmlog", [*told, *more]))
    assert log.foreign == 3 and log.others == 2
    assert len(log.states) == 270 and log.problems == []


def test_prefixes_are_told_apart(told, tmp_path):
    arena = [(f"arena/{channel}", message) for channel, message in told[:100]]
    mixed = write(tmp_path / "mixed.lcmlog", [*told, *arena])
    with pytest.raises(ValueError, match="several prefixes, say which: '', 'arena/'"):
        read_log(mixed)
    assert len(read_log(mixed, prefix="").states) == 270
    assert len(read_log(mixed, prefix="arena/").states) == sum(c.endswith("STATE") for c, _ in arena)
    with pytest.raises(ValueError, match="no channels with the prefix 'x'; there are '', 'arena/'"):
        read_log(mixed, prefix="x")
    assert read_log(write(tmp_path / "one.lcmlog", arena)).prefix == "arena/"


def test_channels_of_each_character_are_one_log(told, tmp_path):
    def suffixed(channel, message):
        return f"{channel}_{message.character}" if hasattr(message, "character") else channel

    log = read_log(write(tmp_path / "suffix.lcmlog", [(suffixed(c, m), m) for c, m in told]))
    same = read_log(write(tmp_path / "plain.lcmlog", told))
    for kind in ("state", "event", "report"):
        assert np.array_equal(log.messages(kind), same.messages(kind))


def test_tables_have_a_column_for_each_number(log):
    pandas = pytest.importorskip("pandas")
    table = log.to_pandas("states")
    assert isinstance(table, pandas.DataFrame) and len(table) == 270
    assert np.array_equal(table["position_y"], log.states["position"][:, 1])
    assert np.array_equal(table["orientation_w"], log.states["orientation"][:, 3])
    assert log.to_pandas("report")["saved_8"].dtype == np.int32
    assert log.to_pandas("world")["level"].tolist() == ["flat"]
    assert table.groupby("character")["step"].max().tolist() == [89, 89, 89]


def test_progress_grows_to_the_whole(told, tmp_path):
    parts = []
    read_log(write(tmp_path / "long.lcmlog", told * 20), progress=parts.append)
    assert len(parts) > 1 and parts == sorted(parts) and parts[-1] == 1


def test_an_empty_log_is_a_log(tmp_path):
    log = read_log(write(tmp_path / "empty.lcmlog", []))
    assert isinstance(log, Log) and len(log.states) == 0 and log.characters.tolist() == []
    assert len(log.runs) == 1 and log.lost["state"] == 0


def test_what_is_no_log_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError):
        read_log(tmp_path / "nowhere.lcmlog")
    text = tmp_path / "text"
    text.write_bytes(b"TAHRTRC\0 and more")
    with pytest.raises(ValueError, match="no LCM log: the bytes ed a1 da 01 .* begins with 54 41 48 52"):
        read_log(text)


def test_messages_of_a_wrong_length_are_problems(told, tmp_path):
    short = messages.event_t().encode()[:-3]
    path = write(tmp_path / "short.lcmlog", [(CHANNELS["event"], short), *told])
    with pytest.warns(LogWarning, match="byte 0: an? event message of 113 bytes, expected 116"):
        log = read_log(path)
    assert [problem.byte for problem in log.problems] == [0] and len(log.states) == 270


def test_a_sound_log_warns_of_nothing(told, tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_log(write(tmp_path / "sound.lcmlog", told))


def test_ranges_are_for_people():
    assert ranges(np.array([0, 1, 2, 5, 7, 8])) == "0-2, 5, 7-8"
    assert ranges(np.array([], int)) == "none"


def test_events_of_a_step_come_with_it(log):
    landed = log.events[log.events["type"] == tahr.EVENT_LANDED]
    for event in landed:
        own = log.of(int(event["character"])).states
        index = np.searchsorted(own["step"], event["step"])
        assert own["time_ns"][index] - 16_666_667 <= event["time_ns"] <= own["time_ns"][index]
