# SPDX-License-Identifier: MIT
"""Which settings are worth having: the Pareto front over error and work, and one number for it."""

import math
from collections.abc import Sequence

from rows import Row

ERROR_FLOOR = 1e-12  # m: below a picometre nobody moves better; zero has no logarithm
ERROR_REFERENCE = 1.0  # m
WORK_REFERENCE = 1e5  # ns: 100 us
TIE = 1.05  # clocks repeat to about 5 %: what is that near is as good
TIE_ERROR = 1.5  # the 99th percentile of some hundred errors is not known better than that

Point = tuple[float, float]


def point_of(row: Row) -> Point:
    """Error of 99 % of the answers, m, and median work, ns."""
    return max(row.error_p99_m, ERROR_FLOOR), row.work


def counts(row: Row) -> bool:
    """A setting that fails has no place on a front, nor one that was not measured or changes what is right."""
    error, work = point_of(row)
    return (
        row.failed == 0 and row.role not in ("reference", "definition") and error == error and work == work and work > 0
    )


def front(points: Sequence[Point]) -> list[Point]:
    """Those that no other is better than in one way and as good in the other, by growing error."""
    best = math.inf
    kept = []
    for error, work in sorted(set(points)):
        if work < best:
            kept.append((error, work))
            best = work
    return kept


def hypervolume(points: Sequence[Point]) -> float:
    """Area between the front and the reference point, in decades of error times decades of work."""
    area = 0.0
    top = math.log10(WORK_REFERENCE)
    kept = [p for p in front(points) if p[0] < ERROR_REFERENCE and p[1] < WORK_REFERENCE]
    for i, (error, work) in enumerate(kept):
        until = kept[i + 1][0] if i + 1 < len(kept) else ERROR_REFERENCE
        area += (math.log10(until) - math.log10(error)) * (top - math.log10(work))
    return area


def beaten(point: Point, others: Sequence[Point]) -> bool:
    """Whether another is clearly better in one way, and as good in the other."""
    error, work = point
    for e, w in others:
        cheaper, as_cheap = w * TIE < work, w <= work * TIE
        better, as_good = e * TIE_ERROR < error, e <= error * TIE_ERROR
        if (cheaper and as_good) or (better and as_cheap):
            return True
    return False


def backend_of(row: Row) -> str:
    """Settings are for a backend: what another one does better is no reason to drop one of this."""
    first = row.curve.split()[0] if row.curve else ""
    return first if first in ("ccd", "fcl", "box2d") else "native"


def weighed(row: Row) -> bool:
    """What could be on a front: it has an error, or fails where others have one."""
    return row.role != "reference" and (row.failed > 0 or not math.isnan(row.error_p99_m))


def never_on_front(rows: Sequence[Row]) -> list[Row]:
    """One row of each setting that is there for nothing else, and that another of its backend and its rate beats on
    every scene. What has no error, and is for its time alone, is not weighed."""
    groups: dict[tuple[str, str, str], list[Row]] = {}
    for row in rows:
        if weighed(row):
            groups.setdefault((row.scene, str(row.rate_hz), backend_of(row)), []).append(row)
    good: set[str] = set()
    seen: dict[str, Row] = {}
    for members in groups.values():
        points = [point_of(r) for r in members if counts(r)]
        for row in members:
            seen.setdefault(row.setting, row)
            if counts(row) and not beaten(point_of(row), points):
                good.add(row.setting)
    return [row for name, row in seen.items() if name not in good and row.role in ("knob", "default")]


def knobs_never_on_front(rows: Sequence[Row]) -> list[str]:
    """The curves of which no point is ever on a front: what is to go, as a whole."""
    never = {row.setting for row in never_on_front(rows)}
    candidates: dict[str, bool] = {}
    for row in rows:
        if weighed(row) and row.role in ("knob", "default"):
            candidates[row.curve] = candidates.get(row.curve, True) and row.setting in never
    return [curve for curve, all_never in candidates.items() if all_never]
