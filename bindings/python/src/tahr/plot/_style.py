# SPDX-License-Identifier: MIT
"""How modes and events look, in every picture."""

from __future__ import annotations

from typing import Any, Dict, NamedTuple, Tuple, Union

import numpy as np
import numpy.typing as npt

from ..messages import constants, event_t, state_t

#: Number -> name: "walking", "landed".
MODES: Dict[int, str] = constants(state_t, "MODE_")
EVENTS: Dict[int, str] = constants(event_t)

#: A dash pattern of matplotlib.
Dashes = Union[str, Tuple[float, Tuple[float, ...]]]

# They stay apart on the light ground of a map, also for most colour-blind people; falling is dashed besides.
_COLOURS = {
    "none": "#737373",
    "walking": "#1f5ebf",
    "falling": "#d65400",
    "swimming": "#00948c",
    "flying": "#993894",
    "hanging": "#bf143d",
    "custom": "#6b590a",
}


class Mode(NamedTuple):
    """How a mode is drawn."""

    number: int
    name: str
    colour: str
    dashes: Dashes


def modes_of(numbers: npt.NDArray[Any]) -> "list[Mode]":
    """The modes that occur, ascending; of unknown ones the number is the name."""
    found = []
    for number in np.unique(numbers):
        name = MODES.get(int(number), str(number))
        dashes: Dashes = (0, (3.0, 1.6)) if name == "falling" else "solid"
        found.append(Mode(int(number), name, _COLOURS.get(name, "#737373"), dashes))
    return found


class Mark(NamedTuple):
    """How an event is drawn."""

    event: str
    label: str
    shape: str  # a marker of matplotlib
    size: float  # points
    colour: str


_EDGE = "#1a1f29"

#: What is marked. Being blocked and stepping down happen all the time: drawn, they would hide the rest.
MARKS = [
    Mark("stepped_up", "step up", "o", 3.0, _EDGE),
    Mark("landed", "landing", "v", 5.5, "#ffffff"),
    Mark("jumped", "jump", "^", 6.0, "#ffd933"),
    Mark("wall_jumped", "wall jump", "^", 6.5, "#f2731a"),
    Mark("grabbed", "hangs on an edge", "s", 5.5, "#bf143d"),
    Mark("base", "another base", "s", 4.5, "#59bf59"),
    Mark("shape", "another height", "o", 4.2, "#9e9eb3"),
    Mark("launched", "launched", "D", 5.0, "#993894"),
    Mark("overlap_begin", "sensor entered", "P", 5.5, "#00948c"),
    Mark("stuck", "stuck", "X", 7.0, "#cc0d1a"),
    Mark("crushed", "crushed", "X", 7.0, "#660066"),
    Mark("custom", "of the program's own", "*", 7.5, "#6b590a"),
]


def mark_style(mark: Mark) -> Dict[str, Any]:
    """For Axes.plot."""
    return {
        "linestyle": "none",
        "marker": mark.shape,
        "markersize": mark.size,
        "markerfacecolor": mark.colour,
        "markeredgecolor": _EDGE,
        "markeredgewidth": 0.6,
    }


def marked(events: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Those events that have a mark."""
    names = {mark.event for mark in MARKS}
    kinds = [number for number, name in EVENTS.items() if name in names]
    return np.asarray(events[np.isin(events["type"], kinds)])


def find_marks(events: npt.NDArray[Any]) -> "list[tuple[Mark, npt.NDArray[Any]]]":
    """The kinds of marks that occur, each with its events."""
    names = {name: number for number, name in EVENTS.items()}
    found = [(mark, events[events["type"] == names[mark.event]]) for mark in MARKS if mark.event in names]
    return [(mark, events) for mark, events in found if len(events)]
