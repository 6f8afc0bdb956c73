# SPDX-License-Identifier: MIT
"""Reads what tahr_chart wrote: measured points, one CSV per family, and the machine."""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path


class ChartError(Exception):
    """Wrong input: says the file, the line and what was expected."""


@dataclass(frozen=True)
class Row:
    """One point. Numbers that were not measured are NaN. Names and units are those of row.h."""

    family: str
    scene: str
    curve: str
    setting: str
    value: float
    rate_hz: float
    role: str
    reference: str
    samples: int
    failed: int
    why: str
    error_p50_m: float
    error_p99_m: float
    error_max_m: float
    penetration_m: float
    ns_p50: float
    ns_p99: float
    ns_mean: float
    ns_per_second: float
    queries: float
    tests: float
    iterations: float
    saved: float
    bytes: float
    build_s: float
    threads: float

    @property
    def failure_rate(self) -> float:
        return self.failed / self.samples if self.samples else 0.0

    @property
    def work(self) -> float:
        """ns: the median of a call; of steps that of as many as 1/60 s takes, whatever their rate."""
        return self.ns_p50 if math.isnan(self.rate_hz) else self.ns_p50 * self.rate_hz / 60

    @property
    def tests_and_iterations(self) -> float:
        return self.tests + self.iterations

    @property
    def queries_per_second(self) -> float:
        return self.queries * self.rate_hz


COLUMNS = [f.name for f in fields(Row)]
TEXTS = {"family", "scene", "curve", "setting", "role", "reference", "why"}
COUNTS = {"samples", "failed"}


def _field(name: str, text: str, where: str):
    if name in TEXTS:
        return text
    try:
        if name in COUNTS:
            return int(text)
        return float(text) if text else math.nan
    except ValueError:
        kind = "a whole number" if name in COUNTS else "a number or nothing"
        raise ChartError(f"{where}: {name} is '{text}', expected {kind}") from None


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    try:
        with path.open(newline="") as file:
            reader = csv.reader(file)
            return [(reader.line_num, line) for line in reader]
    except FileNotFoundError:
        raise ChartError(f"{path}: is not there; tahr_chart --out writes it") from None
    except OSError as error:
        raise ChartError(f"{path}: cannot be read: {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise ChartError(f"{path}: is no CSV: {error}") from None


def read_rows(path: Path) -> list[Row]:
    """All points of one family."""
    lines = _lines(path)
    if not lines or lines[0][1] != COLUMNS:
        raise ChartError(f"{path}:1: expected the columns {','.join(COLUMNS)}")
    rows = []
    for number, line in lines[1:]:
        where = f"{path}:{number}"
        if len(line) != len(COLUMNS):
            raise ChartError(f"{where}: {len(line)} fields, expected {len(COLUMNS)}")
        rows.append(Row(**{name: _field(name, text, where) for name, text in zip(COLUMNS, line)}))
    return rows


def read_machine(path: Path) -> list[tuple[str, str]]:
    """What was measured on, as pairs of name and text."""
    lines = _lines(path)
    if not lines or lines[0][1] != ["key", "value"]:
        raise ChartError(f"{path}:1: expected the columns key,value")
    pairs = []
    for number, line in lines[1:]:
        if len(line) != 2:
            raise ChartError(f"{path}:{number}: {len(line)} fields, expected 2")
        pairs.append((line[0], line[1]))
    return pairs


def thread_gains(rows: Sequence[Row]) -> str:
    """What threads gained where most characters were, beside what as many processes gained that share nothing."""
    most = max((r.value for r in rows), default=0)
    at = {r.curve: r.ns_p50 for r in rows if r.value == most}
    one = at.get("crowd; 1 thread")
    gains = []
    for curve, ns in at.items():
        threads = curve.removeprefix("crowd; ").removesuffix(" threads")
        ceiling = at.get(f"machine's ceiling; {threads} threads")
        if one and ceiling and curve.startswith("crowd; "):
            gains.append(f"{threads} threads are {one / ns:.2f} times one, the machine's ceiling is {one / ceiling:.2f}")
    if not gains:
        return ""
    return f" {most:.0f} characters: {'; '.join(gains)} (as many crowds, each in a process of its own, side by side)."


def budget_gains(rows: Sequence[Row]) -> str:
    """What the time of a tick is with each budget of error, in parts of that without."""
    exact = next((r.ns_p50 for r in rows if r.value == 0), 0.0)
    gains = [f"{100 * r.ns_p50 / exact:.0f} % with {r.value:g} mm" for r in rows if r.value > 0 and exact > 0]
    return f" Median time of a tick, of that without a budget: {', '.join(gains)}." if gains else ""
