# SPDX-License-Identifier: MIT
"""Panels that families are drawn from: error against work, dots by name, lines over a size."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import EngFormatter, FuncFormatter, LogLocator, NullFormatter, NullLocator

from front import ERROR_FLOOR, counts, front, point_of
from labels import Label, place
from rows import Row
from style import FAILED, GREY, look


@dataclass(frozen=True)
class Scale:
    """What is read off a row for one axis. unit: of the ticks, after factor."""

    of: Callable[[Any], float]
    label: str
    unit: str = ""
    factor: float = 1.0
    floor: float = 0.0


MEDIAN_ERROR = Scale(lambda r: r.error_p50_m, "median error", "m", floor=ERROR_FLOOR)
P99_ERROR = Scale(lambda r: r.error_p99_m, "99th percentile of the error", "m", floor=ERROR_FLOOR)


def _ticks(axis: Axis, decades: float, scale: Scale) -> None:
    """As many ticks as there is room for, with SI prefixes."""
    figure = axis.axes.get_figure(root=True)
    assert figure is not None
    many = int(axis.axes.get_position().width * figure.get_figwidth() * 1.5) + 1
    parts: tuple[float, ...] = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)
    if decades > 0.8:
        parts = (1.0,) if decades > 2.5 else (1.0, 2.0, 5.0)
    axis.set_major_locator(LogLocator(subs=parts, numticks=many if decades > 2.5 else 30))
    between = LogLocator(subs=tuple(float(n) for n in range(2, 10)), numticks=30)
    axis.set_minor_locator(between if decades < 5 else NullLocator())
    axis.set_minor_formatter(NullFormatter())
    prefixes = EngFormatter(unit=scale.unit, places=None)
    plain = not scale.unit
    axis.set_major_formatter(
        FuncFormatter(lambda v, _: f"{v:g}" if plain and 1e-3 < v < 9999 else prefixes(v * scale.factor))
    )


Spot = tuple[float, float, Any]  # x, y, and the row it is read off


def curves_of(rows: Sequence[Row]) -> list[str]:
    """Names of the curves in the order in which they were measured."""
    return list(dict.fromkeys(r.curve for r in rows))


def _short(row: Row) -> str:
    """What tells a point from the others of its curve."""
    if row.value == row.value:
        return f"{row.value:g}"
    return row.setting.removeprefix(row.curve + "; ")


def _read(rows: Sequence[Row], x: Scale, y: Scale) -> list[Spot]:
    found = []
    for row in rows:
        if row.role == "reference":
            continue
        a, b = x.of(row), y.of(row)
        if not (math.isnan(a) or math.isnan(b)) and b > 0:
            found.append((max(a, x.floor), b, row))
    return found


def frame(axes: Axes, points: Sequence[Spot], x: Scale, y: Scale) -> None:
    """Room for labels around the points."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    for set_limits, axis, scale, values in (
        (axes.set_xlim, axes.xaxis, x, [p[0] for p in points]),
        (axes.set_ylim, axes.yaxis, y, [p[1] for p in points]),
    ):
        low, high = math.log10(min(values)), math.log10(max(values))
        pad = max(0.14 * (high - low), 0.6 - 0.5 * (high - low))  # at least 1.2 decades
        set_limits(10 ** (low - pad), 10 ** (high + pad))
        _ticks(axis, high - low + 2 * pad, scale)
    if x.floor and any(p[0] <= x.floor for p in points):
        axes.axvline(x.floor, color=GREY, linewidth=0.6, linestyle=":")
    axes.set_xlabel(x.label)
    axes.set_ylabel(y.label)


def _draw_front(axes: Axes, points: Sequence[Spot]) -> None:
    """What nothing beats, as a grey stair behind the points."""
    kept = front([(a, b) for a, b, row in points if counts(row)])
    if not kept:
        return
    xs, ys = [kept[0][0]], [axes.get_ylim()[1]]
    for i, (a, b) in enumerate(kept):
        xs += [a, kept[i + 1][0] if i + 1 < len(kept) else axes.get_xlim()[1]]
        ys += [b, b]
    axes.plot(xs, ys, color="#d9d9d9", linewidth=4, solid_joinstyle="round", zorder=1)


def scatter(
    axes: Axes, rows: Sequence[Row], x: Scale, y: Scale, with_front: bool = False, order: Sequence[str] = ()
) -> None:
    """Curves of error against work, named at their points. What fails is crossed, told apart and off the curve. order:
    of all curves that shall look the same on several panels."""
    points = _read(rows, x, y)
    if not points:
        axes.text(0.5, 0.5, "nothing measured", transform=axes.transAxes, ha="center", color=GREY)
        return
    frame(axes, points, x, y)
    if with_front:
        _draw_front(axes, points)
    names, lines = [], []
    order = order or curves_of(rows)
    for curve in curves_of(rows):
        colour, marker = look(order.index(curve))
        own = [p for p in points if p[2].curve == curve]
        good = [p for p in own if p[2].failed == 0]
        bad = [p for p in own if p[2].failed > 0]
        for line in _pieces(own):
            axes.plot([p[0] for p in line], [p[1] for p in line], color=colour, zorder=2)
            lines.append(line)
        axes.plot(
            [p[0] for p in good],
            [p[1] for p in good],
            color=colour,
            marker=marker,
            linestyle="",
            zorder=3,
            markeredgecolor="white",
            markeredgewidth=0.4,
        )
        axes.plot([p[0] for p in bad], [p[1] for p in bad], color=FAILED, marker="x", linestyle="", zorder=3)
        names += _names(axes, own, colour)
    place(axes, names, [(p[0], p[1]) for p in points], lines)


def _pieces(own: Sequence[Spot]) -> list[list[tuple[float, float]]]:
    """A knob's curve, cut where it fails."""
    pieces: list[list[tuple[float, float]]] = [[]]
    for x, y, row in own:
        if row.failed or row.value != row.value:
            pieces.append([])
        else:
            pieces[-1].append((x, y))
    return [piece for piece in pieces if len(piece) > 1]


def _heaps(axes: Axes, own: Sequence[Spot]) -> list[list[Spot]]:
    """Points of one curve that cannot be told apart, together."""
    heaps: list[list[Spot]] = []
    for spot in own:
        at = axes.transData.transform(spot[:2])
        for heap in heaps:
            other = axes.transData.transform(heap[0][:2])
            if max(abs(at - other)) < 4 * axes.figure.dpi / 72 and (heap[0][2].failed > 0) == (spot[2].failed > 0):
                heap.append(spot)
                break
        else:
            heaps.append([spot])
    return heaps


def _names(axes: Axes, own: Sequence[Spot], colour: str) -> list[Label]:
    """The whole name at one point (the end of a knob's curve, else the first), a short one at the others."""
    if not own:
        return []
    named = own[-1] if own[-1][2].value == own[-1][2].value else own[0]
    labels = []
    for heap in _heaps(axes, own):
        whole = named in heap
        shorts = [_short(p[2]) for p in heap if p is not named]
        text = ", ".join(([named[2].setting] if whole else []) + shorts)
        colour_here = colour
        if heap[0][2].failed:
            worst = max(p[2].failure_rate for p in heap)
            text += f" ({100 * worst:.2g} % fail)"
            colour_here = FAILED
        labels.append(Label(heap[0][0], heap[0][1], text, colour_here, needed=whole, size=7.2 if whole else 6.4))
    return labels


def dots(axes: Axes, names: Sequence[str], series: Sequence[tuple[str, Sequence[float]]], scale: Scale) -> None:
    """One line a name, the first on top, with a dot for each series."""
    axes.set_xscale("log")
    for index, (title, values) in enumerate(series):
        colour, marker = look(index)
        axes.plot(values, range(len(names)), color=colour, marker=marker, linestyle="", label=title)
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    low, high = axes.get_xlim()
    if high < 2 * low:  # no differences out of nothing
        middle = math.sqrt(low * high)
        axes.set_xlim(middle / math.sqrt(2), middle * math.sqrt(2))
    _ticks(axes.xaxis, math.log10(axes.get_xlim()[1] / axes.get_xlim()[0]), scale)
    axes.set_xlabel(scale.label)
    if len(series) > 1:
        axes.legend(
            loc="lower left",
            bbox_to_anchor=(0, 1),
            ncols=len(series),
            frameon=False,
            fontsize=8,
            handletextpad=0.2,
            borderaxespad=0.2,
        )


def over_size(axes: Axes, rows: Sequence[Row], scales: Sequence[tuple[str, Scale]], size: str) -> None:
    """Lines over row.value, one for each curve and scale, named at their ends."""
    points: list[Spot] = []
    names, lines = [], []
    for index, (curve, (title, scale)) in enumerate((c, s) for c in curves_of(rows) for s in scales):
        own = sorted(
            ((r.value, scale.of(r), r) for r in rows if r.curve == curve and scale.of(r) > 0), key=lambda p: p[0]
        )
        if not own:
            continue
        colour, marker = look(index)
        line = [(p[0], p[1]) for p in own]
        axes.plot(
            [p[0] for p in own],
            [p[1] for p in own],
            color=colour,
            marker=marker,
            markeredgecolor="white",
            markeredgewidth=0.4,
        )
        points += own
        lines.append(line)
        names.append(Label(*line[-1], f"{curve} {title}".strip(), colour, needed=True, size=7.2))
    if not points:
        axes.text(0.5, 0.5, "nothing measured", transform=axes.transAxes, ha="center", color=GREY)
        return
    frame(axes, points, Scale(lambda r: r.value, size), scales[0][1])
    place(axes, names, [(p[0], p[1]) for p in points], lines)


def front_settings(rows: Sequence[Row]) -> set[str]:
    """Names of the settings that are on the front of these rows."""
    good = [r for r in rows if counts(r)]
    kept = set(front([point_of(r) for r in good]))
    return {r.setting for r in good if point_of(r) in kept}
