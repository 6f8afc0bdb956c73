# SPDX-License-Identifier: MIT
"""All of a log on one page."""

from __future__ import annotations

from typing import Any, List, Optional, Tuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from ..telemetry import Log
from ..telemetry._log import Characters
from . import _relief, _scene, panels
from ._level import Level, load_triangles

# Of the page, inches.
_WIDTH, _HEIGHT = 16.0, 10.0

# So many times as wide as high ways fill the width of the page better than its left half.
_WIDE = 2.5

# Entries of the legend that fit beside each other.
_LEGEND_COLUMNS = 11


def _title(log: Log) -> str:
    level = str(log.worlds["level"][-1]) if len(log.worlds) else ""
    backend = str(log.worlds["backend"][-1]) if len(log.worlds) else ""
    count = len(log.characters)
    begin, end = (round(time, 1) for time in panels.time_span(log.states))
    who = f"character {log.characters[0]}" if count == 1 else f"{count} characters"
    when = f"for {end:.4g} s" if begin == 0 else f"from {begin:.4g} to {end:.4g} s"
    return f"{level or 'movement'}: {who} {when}" + (f" on {backend}" if backend else "")


def _caption(log: Log, flat: bool, has_level: bool) -> str:
    seen = "from its side" if flat else "from above and from the south"
    over = " over the level" if has_level else ""
    text = f"The ways of the feet {seen}{over}, each from its dot on, coloured by mode."
    wrong: List[str] = []
    lost = sum(log.lost.values())
    if lost:
        wrong.append(f"{lost} messages were lost")
    if log.problems:
        wrong.append(f"the log is damaged in {len(log.problems)} places")
    return text + (f" Not all is here: {', '.join(wrong)}." if wrong else "")


def overview(log: Log, level: Level = None, characters: Characters = None, up: str = "y") -> Figure:
    """A page with all panels: the ways over the level, height, speed, modes with events, queries per step.

    Args:
        log: what read_log gives
        level: a file for tahr.load_level, or vertices (n, 3), m, z up, and triangles (m, 3)
        characters: the ids of those to be drawn; None: all
        up: the axis of the level's file that points up, "y" or "z"

    Raises ValueError where the log tells nothing of a character, and what tahr.load_level raises. The figure belongs to
    no window: matplotlib.pyplot is not used, so nothing has to be closed.
    """
    log = log.of(characters)
    triangles = load_triangles(level, up)
    flat = _scene.is_flat(log.states)
    handles, labels = panels.legend_entries(Figure().subplots(), log)
    rows = -(-len(labels) // _LEGEND_COLUMNS)
    engine = ConstrainedLayoutEngine(rect=(0.005, 0.02 + 0.025 * rows, 0.99, 0.92 - 0.025 * rows))
    figure = Figure(figsize=(_WIDTH, _HEIGHT), layout=engine)
    above, side, over_time, inner = _lay_out(figure, log, flat)
    panels.ways(above, log, _scene.level_behind(triangles, _relief.ABOVE, log.states), _relief.ABOVE)
    if side is not None:
        panels.ways(side, log, _scene.level_behind(triangles, _relief.SOUTH, log.states), _relief.SOUTH)
    for panel, ax in zip((panels.height, panels.speed, panels.modes, panels.queries), over_time):
        panel(ax, log)
        if ax in inner:  # the axes below have the same time
            ax.set_xlabel("")
    figure.text(0.01, 0.985, _title(log), fontsize=16, fontweight="bold", va="top")
    figure.text(0.01, 0.955, _caption(log, flat, triangles is not None), fontsize=10, va="top", color="#40444f")
    if handles:
        style: Any = {"loc": "lower center", "ncol": -(-len(labels) // rows), "fontsize": 9, "frameon": False}
        figure.legend(handles, labels, columnspacing=1.3, **style)
    return figure


def _lay_out(figure: Figure, log: Log, flat: bool) -> Tuple[Axes, Optional[Axes], List[Axes], List[Axes]]:
    """Axes for the ways from above and from the side (none in a flat world), those over time, and which of these have
    others below: beside each other, or, where the ways take up much more width than height, below each other."""
    left, right, bottom, top = _scene.bounds(log.states, _relief.ABOVE)
    wide = (right - left) / (top - bottom)
    halves: Any
    if wide > _WIDE:
        tall = _WIDTH / wide + (0 if flat else 1.6)
        halves = figure.subfigures(2, 1, height_ratios=(tall + 0.6, _HEIGHT - tall - 1.6))
        ways, rest = halves
        grid = rest.subplots(2, 2, sharex=True)
        over_time, inner = [grid[0, 0], grid[1, 0], grid[0, 1], grid[1, 1]], list(grid[0])
        ratios = (_WIDTH / wide, 1.6)
    else:
        halves = figure.subfigures(1, 2)
        ways, rest = halves
        count = len(log.characters)
        rows = 1 + (min(max(count, 3), 24) if count <= panels.ROWS else 9) / 6
        over_time = list(rest.subplots(4, 1, sharex=True, height_ratios=(3, 2.4, rows, 2.4)))
        inner = over_time[:-1]
        ratios = (3.6, 1)
    if flat:
        return ways.subplots(), None, over_time, inner
    above, side = ways.subplots(2, 1, height_ratios=ratios)
    return above, side, over_time, inner
