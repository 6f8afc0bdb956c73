# SPDX-License-Identifier: MIT
"""All of a log on one page."""

from __future__ import annotations

from typing import Any, List

import numpy as np
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from ..telemetry import Log
from ..telemetry._log import Characters
from . import _scene, panels
from ._level import Level, load_triangles
from ._paths import seconds

# Of the page, inches.
_WIDTH, _HEIGHT = 16.0, 10.0


def _title(log: Log) -> str:
    level = str(log.worlds["level"][-1]) if len(log.worlds) else ""
    backend = str(log.worlds["backend"][-1]) if len(log.worlds) else ""
    count = len(log.characters)
    length = float(seconds(log.states).max()) if len(log.states) else 0.0
    who = f"character {log.characters[0]}" if count == 1 else f"{count} characters"
    return f"{level or 'movement'}: {who} for {length:.4g} s" + (f" on {backend}" if backend else "")


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
    level = None if triangles is None else (triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    flat = _scene.is_flat(log.states)
    engine = ConstrainedLayoutEngine(rect=(0.005, 0.045, 0.99, 0.895))
    figure = Figure(figsize=(_WIDTH, _HEIGHT), layout=engine)
    halves: Any = figure.subfigures(1, 2)
    left, right = halves
    if flat:
        panels.above(left.subplots(), log, level)
    else:
        top, bottom = left.subplots(2, 1, height_ratios=(3.6, 1))
        panels.above(top, log, level)
        panels.side(bottom, log, level)
    rows = min(max(len(log.characters), 3), 24)
    tall, fast, timeline, asked = right.subplots(4, 1, sharex=True, height_ratios=(3, 2.4, 1 + rows / 6, 2.4))
    panels.height(tall, log)
    panels.speed(fast, log)
    panels.modes(timeline, log)
    panels.queries(asked, log)
    for ax in (tall, fast, timeline):
        ax.set_xlabel("")
    figure.text(0.01, 0.985, _title(log), fontsize=16, fontweight="bold", va="top")
    figure.text(0.01, 0.955, _caption(log, flat, triangles is not None), fontsize=10, va="top", color="#40444f")
    handles, labels = panels.legend_entries(tall, log)
    if handles:
        style: Any = {"loc": "lower center", "ncol": len(labels), "fontsize": 9, "frameon": False}
        figure.legend(handles, labels, columnspacing=1.3, **style)
    return figure
