# SPDX-License-Identifier: MIT
"""What a step did."""

from typing import Any, List

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError
from ._layout import dtype_of
from ._records import ReportFields
from ._tahr import ffi, lib


class Report(ReportFields):
    """What a step did: counts and flags, and in arrays with the room asked for what happened, which rules decided what,
    and what the world was asked. Hand it to Mover.step, again and again: each step writes it anew."""

    __slots__ = ("_events", "_decisions", "_queries")

    def __init__(self, events: int = 16, decisions: int = 0, queries: int = 0) -> None:
        super().__init__()
        for name, room in (("events", events), ("decisions", decisions), ("queries", queries)):
            if not 0 <= room <= 1 << 24:
                raise ArgumentError(f"Report: {name} is {room!r}, expected room for 0 to 2^24 of them")
        self._events = ffi.new("tahr_event[]", events)
        self._decisions = ffi.new("tahr_decision[]", decisions)
        self._queries = ffi.new("tahr_query_record[]", queries)
        self._c.events, self._c.event_capacity = self._events, events
        self._c.decisions, self._c.decision_capacity = self._decisions, decisions
        self._c.queries, self._c.query_capacity = self._queries, queries

    @staticmethod
    def _seen(memory: Any, kind: str, count: int) -> npt.NDArray[Any]:
        if len(memory) == 0:
            return np.zeros(0, dtype_of(kind))
        view = np.frombuffer(ffi.buffer(memory), dtype_of(kind))[:count]
        view.flags.writeable = False
        return view

    @property
    def events(self) -> npt.NDArray[Any]:
        """A view of what happened, in order: dtype EVENT."""
        return self._seen(self._events, "tahr_event", self._c.event_count)

    @property
    def decisions(self) -> npt.NDArray[Any]:
        """A view of what rules accepted or refused, in order: dtype DECISION; explain() says it in words."""
        return self._seen(self._decisions, "tahr_decision", self._c.decision_count)

    @property
    def queries(self) -> npt.NDArray[Any]:
        """A view of what the world was asked, in order: dtype QUERY_RECORD."""
        return self._seen(self._queries, "tahr_query_record", self._c.query_count)

    def explain(self) -> List[str]:
        """The decisions in words, one a line: rule, verdict, the numbers, the reason."""
        lines = []
        for i in range(self._c.decision_count):
            made = self._decisions[i]
            verdict = "accepted" if made.accepted else "refused"
            reason = ffi.string(made.reason).decode() if made.reason else ""
            lines.append(f"{rule_name(made.rule)} {verdict}: {made.value:g} to {made.limit:g}, {reason}")
        return lines


def event_name(event: int) -> str:
    """The name of an EVENT_*: "landed"; "?" for a number that is none."""
    return str(ffi.string(lib.tahr_event_name(event)).decode())


def rule_name(rule: int) -> str:
    """The name of a RULE_*: "step_up"; "?" for a number that is none."""
    return str(ffi.string(lib.tahr_rule_name(rule)).decode())


def shortcut_name(shortcut: int) -> str:
    """The name of a SHORTCUT_*, which report.saved counts by; "?" for a number that is none."""
    return str(ffi.string(lib.tahr_shortcut_name(shortcut)).decode())
