# SPDX-License-Identifier: MIT
"""The last seconds of what a Listener hears, drawn anew again and again."""

from __future__ import annotations

import time
from typing import Any, Dict, Optional, Tuple

import numpy as np
from matplotlib.figure import Figure

from ..telemetry import Listener, Log
from . import _relief, _scene, panels
from ._level import Level, load_triangles
from ._paths import seconds

#: Of the page, inches.
SIZE = (14.0, 7.5)

_EVERYTHING = (-np.inf, np.inf, -np.inf, np.inf)


class Live:
    """A picture of the last seconds: the ways from above, height, speed, modes with events.

    Args:
        listener: whose messages are shown
        level: a file for tahr.load_level, or vertices (n, 3), m, z up, and triangles (m, 3)
        up: the axis of the level's file that points up, "y" or "z"
        window: s, simulated time that is shown
        figure: to draw into; None: one without a window
    """

    def __init__(
        self,
        listener: Listener,
        level: Level = None,
        up: str = "y",
        window: float = 10.0,
        figure: Optional[Figure] = None,
    ) -> None:
        if not window > 0:
            raise ValueError(f"Live: window is {window} s, expected more than 0")
        triangles = load_triangles(level, up)
        self.figure = figure if figure is not None else Figure(figsize=SIZE)
        self._listener = listener
        self._window = window
        self._behind = None if triangles is None else _scene.backdrop(triangles, _relief.ABOVE, _EVERYTHING)
        self._axes = self._lay_out()
        self._seen: Tuple[float, int] = (time.monotonic(), 0)
        self._rate = 0.0

    def _lay_out(self) -> Dict[str, Any]:
        grid = self.figure.add_gridspec(3, 2, width_ratios=(1.15, 1), left=0.06, right=0.985, bottom=0.12, top=0.89)
        grid.update(wspace=0.16, hspace=0.12)
        tall = self.figure.add_subplot(grid[0, 1])
        return {
            "ways": self.figure.add_subplot(grid[:, 0]),
            "height": tall,
            "speed": self.figure.add_subplot(grid[1, 1], sharex=tall),
            "modes": self.figure.add_subplot(grid[2, 1], sharex=tall),
        }

    def update(self) -> None:
        """Draws what is known now."""
        log = self._recent()
        for axes in self._axes.values():
            axes.cla()
        panels.ways(self._axes["ways"], log, self._behind, _relief.ABOVE, dots_last=True)
        panels.height(self._axes["height"], log)
        panels.speed(self._axes["speed"], log)
        panels.modes(self._axes["modes"], log)
        for name in ("height", "speed"):
            self._axes[name].set_xlabel("")
            self._axes[name].tick_params(labelbottom=False)
        for old in [*self.figure.texts, *self.figure.legends]:
            old.remove()
        self.figure.text(0.01, 0.975, self._title(), fontsize=14, fontweight="bold", va="top")
        self.figure.text(0.01, 0.935, self._caption(log), fontsize=10, va="top", color="#40444f")
        handles, labels = panels.legend_entries(self._axes["height"], log)
        if handles:
            self.figure.legend(handles, labels, loc="lower center", ncol=len(labels), fontsize=8, frameon=False)

    def _recent(self) -> Log:
        """The messages of the last seconds of each character."""
        states = self._listener.states()
        times = seconds(states)
        first = max(float(times.max()) - self._window, 0.0) if len(times) else 0.0
        found = {kind: self._listener.messages(kind) for kind in ("event", "input", "report", "snapshot")}
        found["state"] = states
        kept = {kind: messages[seconds(messages) > first] for kind, messages in found.items()}
        for kind in ("body", "world"):
            kept[kind] = self._listener.messages(kind)
        return Log("live", 0, "", {kind: (kept[kind], np.arange(len(kept[kind]))) for kind in kept})

    def _title(self) -> str:
        world = self._listener.world
        return f"{world['level'] or 'movement'} on {world['backend']}, live" if world is not None else "movement, live"

    def _caption(self, log: Log) -> str:
        now, received = time.monotonic(), sum(self._listener.received.values())
        before, count = self._seen
        if now - before > 0.5:
            self._rate = (received - count) / (now - before)
            self._seen = (now, received)
        lost, world = sum(self._listener.lost.values()), self._listener.world
        dropped = int(world["dropped"] + world["failed"]) if world is not None else 0
        return (
            f"{len(log.characters)} characters, the last {self._window:g} s; {received} messages, "
            f"{self._rate:.0f} a second; {lost} lost on the way, {dropped} not sent, {self._listener.foreign} foreign"
        )
