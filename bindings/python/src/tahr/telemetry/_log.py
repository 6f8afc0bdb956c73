# SPDX-License-Identifier: MIT
"""A log of LCM messages as arrays."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._events import Problem, Progress, read_events
from ._gather import Gathering
from ._wire import KINDS, Array

if TYPE_CHECKING:
    import pandas

#: One character's id, or several.
Characters = Union[int, Iterable[int], None]

PLURALS = {kind: kind[:-1] + "ies" if kind.endswith("y") else kind + "s" for kind in KINDS}


class LogWarning(UserWarning):
    """A part of a log could not be read."""


class Log:
    """The messages of a log, in its order, one structured array per kind.

    The fields are those of the message types (:mod:`tahr.messages`), in SI units, world frame, times in ns:
    ``log.states["position"]`` has shape (n, 3), ``log.events["type"]`` shape (n,).

    Attributes:
        states: where characters were and what they did, after a step
        events: what happened to them
        inputs: what their steps were given
        reports: what their steps came to, and cost
        snapshots: all of their states, some times; ``snapshots["state"]`` is an array of ``tahr.STATE``
        bodies: bodies that were placed
        worlds: what the steps were taken in; texts and bytes are Python objects
        problems: what could not be read, and at which byte
        foreign: messages on channels of Tahr's that are of another type or version
        others: messages on other channels
        path: of the file
        size: of the file in bytes
        prefix: of the channels
    """

    def __init__(self, path: str, size: int, prefix: str, found: Dict[str, Tuple[Array, Array]]) -> None:
        self.path = path
        self.size = size
        self.prefix = prefix
        self.problems: List[Problem] = []
        self.foreign = 0
        self.others = 0
        self._found = found

    def messages(self, kind: str) -> Array:
        """The messages of a kind: "state", "event", "input", "report", "snapshot", "body" or "world".

        Raises ValueError where there is no such kind.
        """
        for singular, plural in PLURALS.items():
            if kind in (singular, plural):
                return self._found[singular][0]
        raise ValueError(f"no kind of messages is called {kind!r}; there are {', '.join(KINDS)}")

    states = property(lambda self: self.messages("state"))
    events = property(lambda self: self.messages("event"))
    inputs = property(lambda self: self.messages("input"))
    reports = property(lambda self: self.messages("report"))
    snapshots = property(lambda self: self.messages("snapshot"))
    bodies = property(lambda self: self.messages("body"))
    worlds = property(lambda self: self.messages("world"))

    @property
    def characters(self) -> npt.NDArray[np.int32]:
        """The ids of all characters that messages tell of, ascending, shape (n,)."""
        return np.unique(np.concatenate([self.messages(k)["character"] for k in KINDS if _is_personal(self, k)]))

    @property
    def lost(self) -> Dict[str, int]:
        """Kind -> messages that are missing between the first and the last one, by their sequence numbers.

        Of bodies and worlds, and where characters began anew, nothing is known.
        """
        return {kind: _gaps(self.messages(kind)) for kind in KINDS if _is_personal(self, kind)}

    def of(self, characters: Characters) -> "Log":
        """The same log with only the messages of these characters, and those of nobody (bodies, worlds).

        Raises ValueError where no message tells of one of them.
        """
        if characters is None:
            return self
        known = self.characters
        wanted = np.unique(np.atleast_1d(np.asarray([characters] if isinstance(characters, int) else list(characters))))
        missing = [str(c) for c in wanted if c not in known]
        if missing:
            raise ValueError(f"no message of character {', '.join(missing)}; there are {ranges(known)}")
        return self._cut({k: np.isin(self.messages(k)["character"], wanted) for k in KINDS if _is_personal(self, k)})

    def between(self, begin: float, end: float) -> "Log":
        """The same log with only what happened after begin up to end (s, simulated), and what has no such time (bodies,
        worlds). Raises ValueError where begin is not before end."""
        if not begin < end:
            raise ValueError(f"Log.between: begin is {begin!r} s and end {end!r} s, expected one before the other")
        timed = [kind for kind in KINDS if "time_ns" in (self.messages(kind).dtype.names or ())]
        times = {kind: self.messages(kind)["time_ns"] * 1e-9 for kind in timed}
        return self._cut({kind: (begin < at) & (at <= end) for kind, at in times.items()})

    @property
    def runs(self) -> "List[Log]":
        """The log cut where another run began, by what its worlds say; the whole log where there is only one."""
        worlds, places = self._found["world"]
        begins = places[1:][np.diff(worlds["run"]) != 0]
        edges = [-1, *begins, self.size]
        return [
            self._cut({k: (at >= low) & (at < high) for k, (_, at) in self._found.items()})
            for low, high in zip(edges, edges[1:])
        ]

    def _cut(self, masks: Dict[str, npt.NDArray[np.bool_]]) -> "Log":
        found = {k: (m[masks[k]], at[masks[k]]) if k in masks else (m, at) for k, (m, at) in self._found.items()}
        log = Log(self.path, self.size, self.prefix, found)
        log.problems, log.foreign, log.others = self.problems, self.foreign, self.others
        return log

    def to_pandas(self, kind: str) -> "pandas.DataFrame":
        """The messages of a kind as a table: a row for each, position_x, position_y and position_z for position.

        Raises ImportError without pandas, ValueError where there is no such kind.
        """
        try:
            import pandas
        except ImportError as error:
            raise ImportError("Log.to_pandas needs pandas: pip install pandas", name="pandas") from error
        return pandas.DataFrame(dict(_columns(self.messages(kind))))

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(self.messages(kind))} {PLURALS[kind]}" for kind in KINDS)
        wrong = f", {len(self.problems)} problems" if self.problems else ""
        return f"<Log {self.path}: {counts}; {len(self.characters)} characters{wrong}>"


def _is_personal(log: Log, kind: str) -> bool:
    return "character" in (log.messages(kind).dtype.names or ())


def _gaps(messages: Array) -> int:
    """Numbers that are missing in the sequences of all characters; a sequence that goes back begins anew."""
    order = np.argsort(messages["character"], kind="stable")
    sequence = messages["sequence"][order]
    same = np.diff(messages["character"][order]) == 0
    steps = np.diff(sequence)
    return int(np.sum(steps[same & (steps > 1)] - 1))


def ranges(ids: Array) -> str:
    """Ascending ids for people: "0-3, 7"."""
    if len(ids) == 0:
        return "none"
    parts = np.split(ids, np.flatnonzero(np.diff(ids) > 1) + 1)
    return ", ".join(f"{part[0]}-{part[-1]}" if len(part) > 1 else str(part[0]) for part in parts)


_SUFFIXES = {3: "xyz", 4: "xyzw"}


def _columns(array: Array, prefix: str = "") -> Iterable[Tuple[str, Any]]:
    for name in array.dtype.names or ():
        column = array[name]
        if column.dtype.names:
            yield from _columns(column, f"{prefix}{name}_")
        elif column.ndim == 1:
            yield prefix + name, column.astype(column.dtype.newbyteorder("="))
        else:
            suffixes = _SUFFIXES.get(column.shape[1], range(column.shape[1]))
            for i, suffix in enumerate(suffixes):
                yield f"{prefix}{name}_{suffix}", column[:, i].astype(column.dtype.newbyteorder("="))


def _choose_prefix(found: List[str], asked: Optional[str], path: str) -> str:
    if asked is not None:
        if found and asked not in found:
            raise ValueError(f"{path}: no channels with the prefix {asked!r}; there are {', '.join(map(repr, found))}")
        return asked
    if len(found) > 1:
        raise ValueError(f"{path} has channels of several prefixes, say which: {', '.join(map(repr, found))}")
    return found[0] if found else ""


def read_log(path: "str | os.PathLike[str]", prefix: Optional[str] = None, progress: Optional[Progress] = None) -> Log:
    """Reads a log that ``tahr record``, ``lcm-logger`` or ``tahr run --lcm file://`` has written.

    What is damaged is left out; a LogWarning tells of it, and ``log.problems`` at which byte.

    Args:
        path: of the file
        prefix: of the channels, where a log has those of several
        progress: called with the part that is read, 0 to 1

    Raises:
        OSError: there is no such file
        ValueError: it is no LCM log; its channels have several prefixes, or none of this one
        ImportError: PyPI's lcm is missing
    """
    name = os.fspath(path)
    gathering = Gathering()
    for block in read_events(name, gathering.problems.append, progress):
        gathering.add(block)
    prefix = _choose_prefix(gathering.prefixes(), prefix, name)
    log = Log(name, os.stat(name).st_size, prefix, gathering.finish(prefix))
    log.problems, log.foreign, log.others = sorted(gathering.problems), gathering.foreign, gathering.others
    if log.problems:
        more = f", and {len(log.problems) - 1} more, see log.problems" if len(log.problems) > 1 else ""
        warnings.warn(f"{name}: {log.problems[0]}{more}; what can be read is kept", LogWarning, stacklevel=2)
    return log
