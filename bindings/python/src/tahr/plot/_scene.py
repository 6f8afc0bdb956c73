# SPDX-License-Identifier: MIT
"""What a picture of the ways is of: where everybody went, from where it is seen, and how much of the world is shown."""

from __future__ import annotations

from typing import Any, Dict, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patheffects import withStroke

from . import _relief
from ._paths import by_character, polylines
from ._relief import Frame, View
from ._style import EVENTS, find_marks, mark_style, modes_of

Floats = npt.NDArray[np.float64]
Array = npt.NDArray[Any]

# cos 50 degrees: steeper ground than this is drawn grey; the precise preset can stand on no more.
_WALKABLE = 0.6427876096865394

# The most pixels of the picture of a level along its longer side, and the most per metre.
_PIXELS = 1600
_FINEST = 80.0

# Beside the ways so much is shown, m and part of their extent.
_MARGIN, _MARGIN_PART = 2.0, 0.08

# Width of lines in points, as long as all of them together are no longer than so many times the picture.
_WIDTH, _SPARSE = 1.4, 6.0

# Marks that are drawn as large as in the legend.
_FEW = 120

# Numbers at the beginnings of more ways would lie on each other; from the south they do so earlier.
_NUMBERED, _NUMBERED_SOUTH = 40, 4


def is_flat(states: Array) -> bool:
    """Whether the world is one of two dimensions, y up: nobody leaves a plane of equal z."""
    if len(states) == 0:
        return False
    return bool(np.all(np.abs(states["up"][:, 2]) < 0.5) and np.ptp(states["position"][:, 2]) < 1e-9)


def feet(states: Array) -> Floats:
    """Where the shapes end below, shape (n, 3), m."""
    return np.asarray(states["position"] - states["up"] * states["half_height"][:, None])


def bounds(states: Array, view: View) -> Tuple[float, float, float, float]:
    """left, right, bottom, top of what is to be seen, m."""
    if len(states) == 0:
        return -1.0, 1.0, -1.0, 1.0
    shape = np.maximum(states["radius"], np.abs(states["up"] @ view.directions[1]) * states["half_height"])[:, None]
    seen = view.project(states["position"])[:, :2]
    low, high = (seen - shape).min(axis=0), (seen + shape).max(axis=0)
    margin = _MARGIN + _MARGIN_PART * (high - low)
    (left, bottom), (right, top) = low - margin, high + margin
    return float(left), float(right), float(bottom), float(top)


class Backdrop(NamedTuple):
    """A level as a picture, and where it lies: left, right, bottom, top, m."""

    image: npt.NDArray[np.uint8]
    extent: Tuple[float, float, float, float]


def backdrop(triangles: Floats, view: View, window: Tuple[float, float, float, float]) -> Optional[Backdrop]:
    """What of a level is in a window (left, right, bottom, top, m); None where nothing is."""
    seen = view.project(triangles).reshape(-1, 3)
    if len(seen) == 0:
        return None
    low, high = seen.min(axis=0) - 0.5, seen.max(axis=0) + 0.5
    left, right = max(window[0], low[0]), min(window[1], high[0])
    bottom, top = max(window[2], low[1]), min(window[3], high[1])
    if left >= right or bottom >= top:
        return None
    scale = min(_FINEST, _PIXELS / max(right - left, top - bottom))
    image = _relief.draw(triangles, view, Frame(left, right, bottom, top, scale), _WALKABLE)
    rows, columns = image.shape[:2]
    return Backdrop(image, (left, left + columns / scale, top - rows / scale, top))


def draw_backdrop(ax: Axes, behind: Optional[Backdrop]) -> None:
    """The level behind the ways."""
    if behind is not None:
        ax.imshow(behind.image, extent=behind.extent, origin="upper", aspect="auto", zorder=0)


def level_behind(triangles: Optional[Floats], view: View, states: Array) -> Optional[Backdrop]:
    """The level around the ways: as much as axes of another shape may show too."""
    if triangles is None:
        return None
    left, right, bottom, top = bounds(states, view)
    room = max(right - left, top - bottom)
    window = (left - room, right + room, bottom - room, top + room)
    return backdrop(_beside(triangles, states) if view is _relief.SOUTH else triangles, view, window)


def set_limits(ax: Axes, view: View, states: Array) -> None:
    """What is to be seen; last, as drawing moves limits. From the south heights are stretched: they are small."""
    left, right, bottom, top = bounds(states, view)
    ax.set_xlim(left, right, auto=True)
    ax.set_ylim(bottom, top, auto=True)
    ax.set_xlabel(f"{view.names[0]} in m")
    if view is _relief.SOUTH:
        ax.set_aspect("auto")
        ax.set_ylabel(f"{view.names[1]} in m\n(stretched)")
    else:
        ax.set_aspect("equal", adjustable="datalim")
        ax.set_ylabel(f"{view.names[1]} in m")


def _beside(triangles: Floats, states: Array) -> Floats:
    """Those in the strip in y that the ways take up: what lies before it only hides them, what lies a metre behind it
    has nothing to do with them."""
    if len(states) == 0:
        return triangles
    y = states["position"][:, 1]
    low, high = triangles[:, :, 1].min(axis=1), triangles[:, :, 1].max(axis=1)
    return np.asarray(triangles[(high >= y.min()) & (low <= y.max() + 1)])


def draw_lines(ax: Axes, states: Array, points: Floats, spans: Tuple[float, float]) -> None:
    """Everybody's lines through points (n, 2), coloured by mode; the more there is to see, the thinner."""
    collected: "dict[int, list[Floats]]" = {}
    for _, whose in by_character(states):
        for number, lines in polylines(states[whose], points[whose], spans).items():
            collected.setdefault(number, []).extend(lines)
    every = [np.diff(line / spans, axis=0) for lines in collected.values() for line in lines]
    length = sum(float(np.hypot(*way.T).sum()) for way in every)
    width = float(np.clip(_WIDTH * (_SPARSE / max(length, _SPARSE)) ** 0.35, 0.35, _WIDTH))
    for mode in modes_of(states["mode"]):
        style: Dict[str, Any] = {"colors": mode.colour, "linestyles": mode.dashes, "linewidths": width}
        ax.add_collection(LineCollection(collected[mode.number], alpha=0.85, zorder=2, **style))


def draw_marks(ax: Axes, events: Array, points: Floats) -> None:
    """A mark for each event at points (n, 2); the more, the smaller."""
    factor = float(np.clip((_FEW / max(len(events), _FEW)) ** 0.35, 0.3, 1))
    for mark, _ in find_marks(events):
        chosen = points[events["type"] == _number_of(mark.event)]
        style = mark_style(mark)
        style["markersize"] *= factor
        style["markeredgewidth"] *= factor
        ax.plot(chosen[:, 0], chosen[:, 1], zorder=3, **style)


def _number_of(name: str) -> int:
    return next(number for number, known in EVENTS.items() if known == name)


def draw_dots(ax: Axes, states: Array, points: Floats, view: View, last: bool) -> None:
    """A dot where each way begins (last: ends), with the character's number if there are several."""
    most = _NUMBERED_SOUTH if view is _relief.SOUTH else _NUMBERED
    where = dict(by_character(states))
    halo = [withStroke(linewidth=2.2, foreground="white")]
    for number, indices in where.items():
        x, y = points[indices[-1 if last else 0]]
        size = 6.0 if len(where) <= most else 3.5
        ax.plot(x, y, "o", color="#1f5ebf", markersize=size, markeredgecolor="white", markeredgewidth=0.8, zorder=4)
        if 1 < len(where) <= most:
            style: Dict[str, Any] = {"textcoords": "offset points", "fontsize": 8, "zorder": 5, "path_effects": halo}
            ax.annotate(str(number), (x, y), (4, 4), **style)
