# SPDX-License-Identifier: MIT
"""The parts of an overview, each a function that draws into one Axes of matplotlib.

All take the log, and the ids of the characters to be drawn (None: all).
"""

from __future__ import annotations

from typing import Any, List, Optional, Tuple

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from ..telemetry import Log
from ..telemetry._log import Characters
from . import _relief, _scene
from ._level import Level, load_triangles
from ._paths import by_character, seconds
from ._style import MARKS, find_marks, mark_style, marked, modes_of

Floats = npt.NDArray[np.float64]
Array = npt.NDArray[Any]

#: Rows of a timeline that can still be read; more characters are counted by mode instead.
ROWS = 40

# Lines that can still be told apart where they go up and down all the time.
_LINES = 6

# Points along the time axis of what is summed up over all characters.
_BINS = 300

# Kinds of queries, as the fields of reports and for people, with colours that stay apart.
_QUERIES = [
    ("sweeps", "sweeps", "#1f5ebf"),
    ("contact_queries", "contacts", "#e69f00"),
    ("rays", "rays", "#00948c"),
    ("fluid_queries", "fluids", "#993894"),
]


def _tell(ax: Axes, text: str) -> None:
    ax.text(0.5, 0.5, text, transform=ax.transAxes, ha="center", va="center", color="#737373")


def time_span(messages: Array) -> Tuple[float, float]:
    """When the first of these steps began and the last one ended, s, simulated."""
    if len(messages) == 0:
        return 0.0, 0.0
    return _begin(seconds(messages)), float(seconds(messages).max())


def _time_axis(ax: Axes, messages: Array) -> None:
    ax.set_xlabel("simulated time in s")
    ax.grid(alpha=0.25)
    begin, end = time_span(messages)
    if end > begin:
        ax.set_xlim(begin, end)


def ways(ax: Axes, log: Log, behind: Optional[_scene.Backdrop], view: _relief.View, dots_last: bool = False) -> None:
    """The ways of the feet before what is behind them, each with a dot where it begins or (dots_last) ends."""
    states, events = log.states, marked(log.events)
    _scene.draw_backdrop(ax, behind)
    if len(states) == 0:
        _tell(ax, "no states in this log")
    else:
        ax.grid(alpha=0.2)
        points = view.project(_scene.feet(states))[:, :2]
        left, right, bottom, top = _scene.bounds(states, view)
        _scene.draw_lines(ax, states, points, (right - left, top - bottom))
        _scene.draw_dots(ax, states, points, view, dots_last)
        _scene.draw_marks(ax, events, _feet_at(events, states, view))
    _scene.set_limits(ax, view, states)


def _feet_at(events: Array, states: Array, view: _relief.View) -> Floats:
    """Where the feet are in the picture at each event: events tell where the centre is."""
    drop = np.zeros((len(events), 3))
    for number, own in by_character(states):
        whose = events["character"] == number
        index = own[np.searchsorted(states["step"][own], events["step"][whose]).clip(0, len(own) - 1)]
        drop[whose] = states["up"][index] * states["half_height"][index][:, None]
    return view.project(events["position"] - drop)[:, :2]


def above(ax: Axes, log: Log, level: Level = None, characters: Characters = None) -> None:
    """The ways of the feet from above, y up, over the level; of a world of two dimensions, from its side.

    Raises ValueError where the log tells nothing of a character, and what tahr.load_level raises.
    """
    log = log.of(characters)
    ways(ax, log, _scene.level_behind(load_triangles(level), _relief.ABOVE, log.states), _relief.ABOVE)


def side(ax: Axes, log: Log, level: Level = None, characters: Characters = None) -> None:
    """The ways of the feet from the south, z up, before what of the level is as far north as they are.

    Raises as above does.
    """
    log = log.of(characters)
    ways(ax, log, _scene.level_behind(load_triangles(level), _relief.SOUTH, log.states), _relief.SOUTH)


def _over_time(ax: Axes, states: Array, values: Floats) -> None:
    """A line for each character, coloured by mode."""
    points = np.stack([seconds(states), values], axis=1)
    span = float(np.ptp(values)) or 1.0
    _scene.draw_lines(ax, states, points, (float(np.ptp(points[:, 0])) or 1.0, span))
    ax.set_ylim(values.min() - 0.06 * span, values.max() + 0.1 * span)


def height(ax: Axes, log: Log, characters: Characters = None) -> None:
    """Height of the feet over time, with the marks of events; along z, of a world of two dimensions along y."""
    log = log.of(characters)
    states, events = log.states, marked(log.events)
    _time_axis(ax, states)
    ax.set_ylabel("height of\nthe feet in m")
    if len(states) == 0:
        _tell(ax, "no states in this log")
        return
    axis = 1 if _scene.is_flat(states) else 2
    _over_time(ax, states, _scene.feet(states)[:, axis])
    view = _relief.ABOVE if axis == 1 else _relief.SOUTH
    points = np.stack([seconds(events), _feet_at(events, states, view)[:, 1]], axis=1)
    _scene.draw_marks(ax, events, points)


def speed(ax: Axes, log: Log, characters: Characters = None) -> None:
    """Speed over time; on a moving body relative to it."""
    states = log.of(characters).states
    _time_axis(ax, states)
    ax.set_ylabel("speed in m/s")
    if len(states) == 0:
        _tell(ax, "no states in this log")
        return
    values = np.linalg.norm(states["velocity"], axis=1)
    if len(np.unique(states["character"])) > _LINES:
        _spread(ax, seconds(states), values)
    else:
        _over_time(ax, states, values)
        ax.set_ylim(0, values.max() * 1.08 or 1.0)


def _spread(ax: Axes, time: Floats, values: Floats) -> None:
    """How the values of many characters lie: all, the eight tenths in the middle, the middle one."""
    edges, which = _bins(time)
    order = np.lexsort((values, which))
    begins = np.searchsorted(which[order], np.arange(len(edges)))
    filled = np.flatnonzero(np.diff(begins))
    low, ends = begins[filled], begins[filled + 1] - 1
    rows = [values[order][(low + part * (ends - low)).round().astype(int)] for part in (0, 0.1, 0.5, 0.9, 1)]
    at = (edges[filled] + edges[filled + 1]) / 2
    ax.fill_between(at, rows[0], rows[4], color="#1f5ebf", alpha=0.15, lw=0, label="all")
    ax.fill_between(at, rows[1], rows[3], color="#1f5ebf", alpha=0.3, lw=0, label="8 of 10")
    ax.plot(at, rows[2], color="#12376f", lw=1.2, label="median")
    ax.set_ylim(0, values.max() * 1.3 or 1.0)
    ax.legend(loc="upper right", ncol=3, fontsize=8, frameon=False)


def _spells(states: Array) -> List[Tuple[int, float, float]]:
    """Mode, begin and length in s of what one character did, one after the other."""
    times, modes = seconds(states), states["mode"]
    begins = np.concatenate([[0], np.flatnonzero(np.diff(modes)) + 1])
    edges = np.append(times[begins], times[-1])
    return [(int(modes[i]), float(a), float(b - a)) for i, a, b in zip(begins, edges, edges[1:])]


def modes(ax: Axes, log: Log, characters: Characters = None) -> None:
    """What everybody did over time: a row for each character with its events; for many, how many did what."""
    log = log.of(characters)
    states = log.states
    _time_axis(ax, states)
    if len(states) == 0:
        _tell(ax, "no states in this log")
        return
    if len(log.characters) > ROWS:
        _mode_counts(ax, states)
        return
    rows = {int(number): row for row, number in enumerate(log.characters)}
    styles = {mode.number: mode for mode in modes_of(states["mode"])}
    for number, own in by_character(states):
        spells = _spells(states[own])
        colours = [styles[mode].colour for mode, _, _ in spells]
        ax.broken_barh([(a, b) for _, a, b in spells], (rows[number] - 0.36, 0.72), facecolors=colours, alpha=0.75)
    events = marked(log.events)
    at = np.array([rows[int(number)] for number in events["character"]], np.float64)
    _scene.draw_marks(ax, events, np.stack([seconds(events), at], axis=1))
    ax.set_ylabel("character")
    ax.set_ylim(len(rows) - 0.4, -0.6)
    step = 1 if len(rows) <= 20 else 5
    ax.set_yticks(list(rows.values())[::step], [str(number) for number in rows][::step])
    ax.grid(False, axis="y")


def _begin(time: Floats) -> float:
    """When the first of these steps began: times are the ends of steps."""
    count = len(np.unique(time))
    step = (float(time.max()) - float(time.min())) / (count - 1) if count > 1 else float(time.max())
    return max(0.0, float(time.min()) - step)


def _bins(time: Floats) -> Tuple[Floats, Array]:
    """Edges along the time axis, no more than there are times, and the bin of each time."""
    count = int(np.clip(len(np.unique(time)), 1, _BINS))
    edges = np.linspace(_begin(time), max(float(time.max()), 1e-3), count + 1)
    # A time on an edge ends the bin before it; half a nanosecond is no time.
    return edges, np.clip(np.searchsorted(edges, time - 5e-10) - 1, 0, count - 1)


def _stack(ax: Axes, edges: Floats, layers: Floats, colours: List[str]) -> None:
    """Layers (k, bins) upon each other."""
    tops = np.vstack([np.zeros(layers.shape[1]), np.cumsum(layers, axis=0)])
    for low, high, colour in zip(tops, tops[1:], colours):
        ax.fill_between(edges, np.append(low, low[-1:]), np.append(high, high[-1:]), step="post", color=colour, lw=0)


def _mode_counts(ax: Axes, states: Array) -> None:
    edges, which = _bins(seconds(states))
    styles = modes_of(states["mode"])
    counts = np.stack([np.bincount(which[states["mode"] == mode.number], minlength=len(edges) - 1) for mode in styles])
    parts = counts / np.maximum(counts.sum(axis=0), 1) * 100
    _stack(ax, edges, parts, [mode.colour for mode in styles])
    ax.set_ylabel("characters in %")
    ax.set_ylim(0, 100)


def queries(ax: Axes, log: Log, characters: Characters = None) -> None:
    """Queries per step over time by kind, the mean of all characters, and the most that one step took."""
    reports = log.of(characters).reports
    _time_axis(ax, reports)
    ax.set_ylabel("queries\nper step")
    if len(reports) == 0:
        _tell(ax, "no reports in this log")
        return
    edges, which = _bins(seconds(reports))
    steps = np.bincount(which, minlength=len(edges) - 1)
    layers, total = [], np.zeros(len(reports))
    for field, _, _ in _QUERIES:
        layers.append(np.bincount(which, reports[field], len(edges) - 1) / np.maximum(steps, 1))
        total += reports[field]
    most = np.zeros(len(edges) - 1)
    np.maximum.at(most, which, total)
    used = [k for k, layer in enumerate(layers) if layer.any()] or [0]
    _stack(ax, edges, np.stack([layers[k] for k in used]), [_QUERIES[k][2] for k in used])
    ax.step(edges, np.append(most, most[-1]), where="post", color="#1a1f29", lw=0.8)
    ax.set_ylim(0, most.max() * 1.3 or 1.0)
    handles = [ax.fill_between([], [], color=_QUERIES[k][2]) for k in used] + [ax.plot([], [], "#1a1f29", lw=0.8)[0]]
    labels = [_QUERIES[k][1] for k in used] + ["most of a step"]
    ax.legend(handles, labels, loc="upper right", ncol=5, fontsize=8, frameon=False, handlelength=1.2, columnspacing=1)


def legend_entries(ax: Axes, log: Log) -> Tuple[List[Any], List[str]]:
    """Handles and labels of the modes and marks that occur in a log, for Axes.legend or Figure.legend."""
    handles: List[Any] = []
    labels: List[str] = []
    for mode in modes_of(log.states["mode"]):
        handles += ax.plot([], [], color=mode.colour, linestyle=mode.dashes, lw=2)
        labels.append(mode.name)
    for mark, events in find_marks(log.events):
        handles += ax.plot([], [], **mark_style(mark))
        labels.append(f"{mark.label} ({len(events)})")
    return handles, labels


__all__ = ["MARKS", "above", "height", "legend_entries", "modes", "queries", "side", "speed"]
