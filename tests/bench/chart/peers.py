# SPDX-License-Identifier: MIT
"""Other engines' controllers beside Tahr: what `make peers` measured on the same courses, drawn and weighed."""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import page
from labels import Label, place
from panel import Scale, frame
from rows import ChartError
from style import FAILED, look, panels, save

TEXTS = ("course", "method", "version", "settings", "left_out")
NUMBERS = (
    "steps",
    "ns_median",
    "ns_p99",
    "ns_cpu_mean",
    "queries",
    "tunnelled",
    "embedded",
    "invalid",
    "left",
    "stuck",
    "deepest",
    "clearance",
    "progress",
    "flips",
)
CLEARER = 1.05  # of a time or a share: what is nearer than that is as good


@dataclass(frozen=True)
class Peer:
    """One method on one course. left_out: why it was not measured, or empty. Numbers that are not there are NaN."""

    course: str
    method: str
    version: str
    settings: str
    left_out: str
    numbers: dict[str, float]

    def __getitem__(self, name: str) -> float:
        return self.numbers[name]

    @property
    def failures(self) -> float:
        """Steps that tunnelled, ended embedded or at no number."""
        return self["tunnelled"] + self["embedded"] + self["invalid"]

    @property
    def own(self) -> bool:
        return self.method.startswith("tahr")


def _read_lines(path: Path, reader: csv.DictReader) -> list[Peer]:
    found = []
    missing = [name for name in TEXTS + NUMBERS if name not in (reader.fieldnames or [])]
    if missing:
        raise ChartError(f"{path}:1: the columns {', '.join(missing)} are missing")
    for line in reader:
        numbers = {}
        for name in NUMBERS:
            try:
                numbers[name] = float(line[name]) if line[name] else math.nan
            except (TypeError, ValueError):
                raise ChartError(
                    f"{path}:{reader.line_num}: {name} is '{line[name]}', expected a number or nothing"
                ) from None
        texts = {name: line[name] or "" for name in TEXTS}
        found.append(Peer(**texts, numbers=numbers))
    return found


def read_peers(path: Path) -> list[Peer]:
    try:
        with path.open(newline="") as file:
            return _read_lines(path, csv.DictReader(file))
    except OSError as error:
        raise ChartError(f"{path}: cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise ChartError(f"{path}: is no CSV: {error}") from None


def courses_of(peers: Sequence[Peer]) -> list[str]:
    return list(dict.fromkeys(p.course for p in peers if p.course))


# Error of a controller: how deep it went in; what touched nothing is drawn at a micrometre.
DEEPEST = Scale(lambda p: p["deepest"], "deepest penetration", "m", floor=1e-6)
NS_STEP = Scale(lambda p: p["ns_median"], "median time of a step", "s", 1e-9)

# What is weighed, in words, and whether more is better.
WEIGHED = (
    ("ns_median", "median time of a step", "ns", False),
    ("ns_p99", "99th percentile of the time of a step", "ns", False),
    ("ns_cpu_mean", "mean time of a step", "ns", False),
    ("deepest", "deepest penetration", "m", False),
    ("failures", "steps that tunnelled, ended embedded or at no number", "", False),
    ("stuck", "stretches of 5 s on one spot", "", False),
    ("progress", "way made of the way wished", "", True),
    ("flips", "changes of the ground flag per second", "", False),
)


def _grid(courses: Sequence[str]):
    columns = min(4, len(courses))
    lines = math.ceil(len(courses) / columns)
    figure, axes = panels(columns, width=3.3, height=3.1, left=0.75, lines=lines)
    for spare in axes[len(courses) :]:
        spare.set_visible(False)
    return figure, axes


def _draw_course(axes, members: Sequence[Peer], methods: Sequence[str]) -> None:
    spots = [(max(DEEPEST.of(p), DEEPEST.floor), NS_STEP.of(p), p) for p in members]
    spots = [s for s in spots if not math.isnan(s[0]) and s[1] > 0]
    if not spots:
        return
    frame(axes, spots, DEEPEST, NS_STEP)
    names = []
    for x, y, p in spots:
        colour, marker = look(methods.index(p.method))
        bad = p.failures > 0
        axes.plot([x], [y], color=FAILED if bad else colour, marker="x" if bad else marker, linestyle="", zorder=3)
        text = f"{p.method} ({p.failures:.0f} of {p['steps']:.0f} fail)" if bad else p.method
        names.append(Label(x, y, text, FAILED if bad else colour, needed=True, size=6.8))
    place(axes, names, [(x, y) for x, y, _ in spots])


def _value(peer: Peer, name: str) -> float:
    return peer.failures if name == "failures" else peer[name]


def worse(peers: Sequence[Peer]) -> list[str]:
    """Where another controller beats the best of Tahr's, in words: computed, not chosen."""
    said = []
    for course in courses_of(peers):
        members = [p for p in peers if p.course == course and not p.left_out]
        for name, words, unit, more in WEIGHED:
            own = [_value(p, name) for p in members if p.own and not math.isnan(_value(p, name))]
            if not own:
                continue
            best = max(own) if more else min(own)
            for p in members:
                value = _value(p, name)
                if p.own or math.isnan(value):
                    continue
                if (value > best * CLEARER) if more else (value * CLEARER < best):
                    said.append(
                        f"{course}: {words}: {p.method} {page.number(value)} {unit}".rstrip()
                        + f", Tahr {page.number(best)} {unit}".rstrip()
                    )
    return said


def _table(peers: Sequence[Peer]) -> page.Table:
    columns = [
        "course",
        "method",
        "median, ns",
        "p99, ns",
        "mean, ns",
        "queries",
        "tunnelled",
        "embedded",
        "invalid",
        "left",
        "stuck",
        "deepest, m",
        "clearance, m",
        "progress",
        "flips / s",
    ]
    return page.Table(columns, [[p.course, p.method] + [p[n] for n in NUMBERS if n != "steps"] for p in peers if not p.left_out])


def section(peers: Sequence[Peer], out: Path) -> str:
    """HTML: the picture of all courses, the table, what was chosen, who was left out, and what Tahr does worse."""
    measured = [p for p in peers if not p.left_out]
    methods = list(dict.fromkeys(p.method for p in measured))
    courses = courses_of(measured)
    figure, axes = _grid(courses)
    for one, course in zip(axes, courses):
        one.set_title(course)
        _draw_course(one, [p for p in measured if p.course == course], methods)
    caption = (
        "Character controllers on the same levels with the same starts and wishes at 60 Hz, in one run, judged by "
        "one independent look at the triangles. What never touched anything is drawn at 1 µm. A red cross "
        "tunnelled, ended a step more than 1 mm inside, or at no number."
    )
    parts = [page.figure("Every course", save(figure, out, "peers"), caption, _table(peers))]
    chosen = dict.fromkeys((p.method, p.version, p.settings) for p in measured)
    parts.append(
        "<h3>What was chosen for each</h3>"
        + page.table(page.Table(["method", "version", "settings, and who recommends them"], [list(c) for c in chosen]))
    )
    left_out = list(
        dict.fromkeys(f"{p.method}{' on ' + p.course if p.course else ''}: {p.left_out}" for p in peers if p.left_out)
    )
    if left_out:
        parts.append("<h3>Left out</h3>" + page.bullets(left_out))
    said = worse(peers)
    parts.append(
        "<h3>What Tahr does worse</h3><p>Everything measured in which another controller beats the best of "
        "Tahr's by more than 5 %:</p>" + (page.bullets(said) if said else "<p>Nothing.</p>")
    )
    return "\n".join(parts)
