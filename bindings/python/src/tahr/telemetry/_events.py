# SPDX-License-Identifier: MIT
"""The events of an LCM log one after the other, and at which byte something is wrong with it.

A log is read by LCM's own EventLog. Where it is damaged that looks for the next event by itself and says nothing about
it, or stops. So it is checked that all bytes were read; around those that were not, events are looked at one by one.
"""

from __future__ import annotations

import itertools
import mmap
import os
import struct
from types import ModuleType
from typing import TYPE_CHECKING, Callable, Iterator, List, NamedTuple, Optional, Sequence, Tuple

if TYPE_CHECKING:
    import lcm

#: Every event of a log begins with these bytes.
SYNC = b"\xed\xa1\xda\x01"

# Before the lengths of channel and data: the sync word, a number, a time.
_LENGTHS = struct.Struct(">ii")
_LENGTHS_AT = 20
_HEADER = _LENGTHS_AT + _LENGTHS.size

# The longest name of a channel that LCM sends, and its EventLog reads.
_LONGEST_CHANNEL = 999

#: The part of the log that is read, 0 to 1.
Progress = Callable[[float], None]

# Events that are read before it is looked whether any byte between them was left out.
_BLOCK = 4096

# Bytes around something broken within which each event is looked at by itself.
_CAREFUL = 1 << 16


class Problem(NamedTuple):
    """Something that could not be read."""

    byte: int  # where in the file
    text: str

    def __str__(self) -> str:
        return f"byte {self.byte}: {self.text}"


class Event(NamedTuple):
    """What is read of an event, here or by EventLog."""

    channel: str
    data: bytes


class Block(NamedTuple):
    """Some events of a log."""

    bytes: List[int]  # where in the file each of them begins
    events: "Sequence[Event | lcm.Event]"


def _fault(view: mmap.mmap, at: int, size: int) -> Tuple[int, str]:
    """Where the event that begins at `at` ends; and what is wrong with it, or ''."""
    if at + _HEADER > size:
        return size, f"the file ends inside of an event, {size - at} bytes after it began"
    channel, data = _LENGTHS.unpack_from(view, at + _LENGTHS_AT)
    end = at + _HEADER + channel + data
    if not 0 < channel <= _LONGEST_CHANNEL or data < 0:
        return end, f"an event with a channel of {channel} and data of {data} bytes"
    if end > size:
        return end, f"the file ends inside of an event, {size - at} of its {end - at} bytes after it began"
    # What follows is no event: these lengths are wrong, if another one begins before they are over.
    if end < size and view[end : end + 4] != SYNC[: size - end] and view.find(SYNC, at + 4, min(end + 3, size)) >= 0:
        return end, f"an event of {end - at} bytes inside of which another one begins"
    return end, ""


def _next_sync(view: mmap.mmap, at: int, size: int) -> int:
    found = view.find(SYNC, at)
    return found if found >= 0 else size


class _Reader:
    """One log, as far as it was read."""

    def __init__(self, path: str, view: mmap.mmap, on_problem: Callable[[Problem], None]) -> None:
        self.view = view
        self.size = len(view)
        self.at = 0
        self._log = import_lcm().EventLog(path)
        self._on_problem = on_problem

    def close(self) -> None:
        self._log.close()

    def _is_event(self, at: int) -> bool:
        return self.view[at : at + 4] == SYNC

    def read_sound(self) -> Optional[Block]:
        """The next events; None, and nothing read, where something is wrong with one of them."""
        if not self._is_event(self.at):
            return None
        try:
            events = list(itertools.islice(iter(self._log.read_next_event, None), _BLOCK))
        except UnicodeDecodeError:
            events = []
        ends = list(itertools.accumulate([_HEADER + len(e.channel) + len(e.data) for e in events], initial=self.at))
        end = ends.pop()
        if events and self._log.tell() == end and (end == self.size or self._is_event(end)):
            self.at = end
            return Block(ends, events)
        self._log.seek(self.at)
        return None

    def read_broken(self) -> Block:
        """The same, without EventLog, which refuses sound events too where what follows them is not."""
        places: List[int] = []
        events: List[Event] = []
        stop = min(self.at + _CAREFUL, self.size)
        while self.at < stop:
            if not self._is_event(self.at):
                after = _next_sync(self.view, self.at, self.size)
                self._skip(after, f"{after - self.at} bytes that belong to no event")
                continue
            end, fault = _fault(self.view, self.at, self.size)
            if fault:
                self._skip(_next_sync(self.view, self.at + 4, self.size), fault)
                continue
            length = _LENGTHS.unpack_from(self.view, self.at + _LENGTHS_AT)[0]
            data = self.at + _HEADER + length
            places.append(self.at)
            events.append(Event(self.view[self.at + _HEADER : data].decode("utf-8", "replace"), self.view[data:end]))
            self.at = end
        self._log.seek(self.at)
        return Block(places, events)

    def _skip(self, to: int, why: str) -> None:
        self._on_problem(Problem(self.at, why))
        self.at = to


def read_events(
    path: str, on_problem: Callable[[Problem], None], progress: Optional[Progress] = None
) -> Iterator[Block]:
    """Every event of a log that can be read, in its order.

    Raises OSError where there is no such file, ValueError where it is no LCM log, ImportError without PyPI's lcm.
    """
    import_lcm()
    if os.stat(path).st_size == 0:
        return
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as view:
        if view.find(SYNC) < 0:
            raise ValueError(
                f"{path} is no LCM log: the bytes {SYNC.hex(' ')} with which events begin are nowhere in it "
                f"(it begins with {view[:4].hex(' ')})"
            )
        reader = _Reader(path, view, on_problem)
        try:
            while reader.at < reader.size:
                yield reader.read_sound() or reader.read_broken()
                if progress is not None:
                    progress(reader.at / reader.size)
        finally:
            reader.close()


def import_lcm() -> ModuleType:
    """PyPI's lcm; or an ImportError that says how to get it."""
    try:
        import lcm
    except ImportError as error:
        raise ImportError("tahr.telemetry needs LCM: pip install 'tahr[telemetry]' (PyPI: lcm)", name="lcm") from error
    return lcm
