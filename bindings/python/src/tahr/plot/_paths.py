# SPDX-License-Identifier: MIT
"""The ways of characters as lines: cut where the mode changes and where somebody was put elsewhere, and thinned out to
what can be seen."""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Tuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]
Floats = npt.NDArray[np.float64]

# Places in a picture that are told apart along either axis: more than there are pixels.
_GRID = 2500

# Farther than this many times its speed allows, plus so many metres, a character was put somewhere else.
_LEAP_FACTOR = 3.0
_LEAP = 1.0


def by_character(messages: Array) -> Iterator[Tuple[int, Array]]:
    """Id of each character, and the indices of its messages, in order."""
    order = np.argsort(messages["character"], kind="stable")
    ids, begins = np.unique(messages["character"][order], return_index=True)
    for number, part in zip(ids, np.split(order, begins[1:])):
        yield int(number), part


def seconds(messages: Array) -> Floats:
    """Simulated time."""
    return np.asarray(messages["time_ns"] * 1e-9)


def leaps(states: Array) -> Array:
    """Whether one character's state is not where the one before it led to; shape (n - 1,)."""
    way = np.linalg.norm(np.diff(states["position"], axis=0), axis=1)
    time = np.diff(seconds(states))
    speed = np.linalg.norm(states["velocity"], axis=1)
    return np.asarray((way > _LEAP + _LEAP_FACTOR * np.maximum(speed[1:], speed[:-1]) * np.abs(time)) | (time < 0))


def polylines(states: Array, points: Floats, spans: Tuple[float, float]) -> Dict[int, List[Floats]]:
    """Mode -> lines of one character; a line goes on to the first point of the next mode.

    points: (n, 2), of each state; spans: width and height of the picture in the same units.
    """
    cells = np.floor(points * (_GRID / np.maximum(spans, 1e-9)))
    modes, leap = states["mode"], leaps(states)
    ends = leap | (np.diff(modes) != 0)
    kept = np.ones(len(points), bool)
    # What is drawn onto the same place as the point before is left out, unless a line ends or begins there.
    kept[1:-1] = np.any(np.diff(cells, axis=0)[:-1] != 0, axis=1) | ends[1:] | ends[:-1]
    chosen = np.flatnonzero(kept)
    lines: Dict[int, List[Floats]] = {}
    cuts = np.flatnonzero(ends[chosen[1:] - 1]) + 1
    for piece in np.split(chosen, cuts):
        last = piece[-1]
        if last + 1 < len(points) and not leap[last]:
            piece = np.append(piece, last + 1)
        lines.setdefault(int(modes[piece[0]]), []).append(points[piece])
    return lines
