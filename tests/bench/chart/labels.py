# SPDX-License-Identifier: MIT
"""Puts names beside points so that none covers another: greedy, the important ones first."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy
from matplotlib.axes import Axes
from matplotlib.transforms import Bbox

# Directions tried in turn, as parts of the distance from the point, and the distances in points.
DIRECTIONS = [(1, 0), (1, 0.8), (1, -0.8), (-1, 0), (-1, 0.8), (-1, -0.8), (0, 1), (0, -1)]
DISTANCES = [6, 11, 18, 27, 38, 52, 70, 92]
LEADER = 11  # points: from here on a line leads to the label


Point = tuple[float, float]


@dataclass(frozen=True)
class Label:
    """A name for a point, in data coordinates. What is not needed is left out where there is no room."""

    x: float
    y: float
    text: str
    colour: str
    needed: bool = False
    size: float = 7.0


def _size(axes: Axes, label: Label) -> tuple[float, float]:
    """Width and height in pixels."""
    weight = "bold" if label.needed else "normal"
    text = axes.text(0, 0, label.text, fontsize=label.size, fontweight=weight)
    box = text.get_window_extent()
    text.remove()
    return box.width, box.height


def _candidate(at: Point, size: Point, way: Point, far: float) -> Bbox:
    width, height = size
    x = at[0] + way[0] * far - (width if way[0] < 0 else width / 2 if way[0] == 0 else 0)
    y = at[1] + way[1] * far - height / 2
    if way[0] == 0:
        y += way[1] * height / 2
    return Bbox.from_bounds(x, y, width, height)


def _overlap(box: Bbox, others: numpy.ndarray) -> float:
    """Area in common with all of them; others: x0, y0, x1, y1 each."""
    width = numpy.minimum(box.x1, others[:, 2]) - numpy.maximum(box.x0, others[:, 0])
    height = numpy.minimum(box.y1, others[:, 3]) - numpy.maximum(box.y0, others[:, 1])
    return float(numpy.sum(numpy.where((width > 0) & (height > 0), width * height, 0.0)))


def _best(at: Point, size: Point, taken: Sequence[Bbox], frame: Bbox, scale: float) -> tuple[float, float, Bbox]:
    """The first free place, or the one that covers least: covered area, distance, box."""
    others = numpy.array([one.extents for one in taken]).reshape(-1, 4)
    best = (math.inf, 0.0, frame)
    for far in DISTANCES:
        for way in DIRECTIONS:
            box = _candidate(at, size, way, far * scale)
            outside = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
            covered = _overlap(box, others) + (1e6 if outside else 0)
            if covered == 0:
                return 0.0, far, box
            if covered < best[0]:
                best = (covered, far, box)
    return best


def _obstacles(axes: Axes, points: Sequence[Point], lines: Sequence[Sequence[Point]]) -> list[Bbox]:
    """Points, and lines as beads, in pixels."""
    scale = axes.figure.dpi / 72
    spots = [(tuple(axes.transData.transform(p)), 2.6 * scale) for p in points]
    for line in lines:
        ends = [tuple(axes.transData.transform(p)) for p in line]
        for (ax, ay), (bx, by) in zip(ends, ends[1:]):
            beads = int(max(abs(bx - ax), abs(by - ay)) / (4 * scale))
            for k in range(1, beads):
                spots.append(((ax + (bx - ax) * k / beads, ay + (by - ay) * k / beads), 1.2 * scale))
    return [Bbox.from_extents(x - r, y - r, x + r, y + r) for (x, y), r in spots]


def place(axes: Axes, labels: Sequence[Label], points: Sequence[Point], lines: Sequence[Sequence[Point]] = ()) -> int:
    """Names them, away from all points and lines. Limits, scales and the layout must be final. Returns how many were
    left out."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    scale = figure.dpi / 72
    to_axes = axes.transData.inverted()
    frame = axes.get_window_extent().padded(2)
    taken = _obstacles(axes, points, lines)
    left_out = 0
    for label in sorted(labels, key=lambda one: not one.needed):
        at = tuple(axes.transData.transform((label.x, label.y)))
        covered, far, box = _best(at, _size(axes, label), taken, frame, scale)
        if covered > 0 and not label.needed:
            left_out += 1
            continue
        taken.append(box.padded(scale))
        # Held at the side of the point: a viewer with another font must not write over it.
        side = "right" if box.x1 <= at[0] else "left" if box.x0 >= at[0] else "center"
        anchor = {"right": box.x1, "left": box.x0, "center": (box.x0 + box.x1) / 2}[side]
        x, y = to_axes.transform((anchor, box.y0))
        weight = "bold" if label.needed else "normal"
        axes.text(
            x, y, label.text, fontsize=label.size, color=label.colour, fontweight=weight, ha=side, va="bottom", zorder=5
        )
        if far >= LEADER:
            end = (min(max(at[0], box.x0), box.x1), min(max(at[1], box.y0), box.y1))
            ends = to_axes.transform([at, end])
            axes.plot(ends[:, 0], ends[:, 1], color=label.colour, linewidth=0.5, alpha=0.6, zorder=4)
    return left_out
