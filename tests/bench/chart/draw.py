# SPDX-License-Identifier: MIT
"""Draws what tahr_chart measured: SVG and PNG of every chart, hypervolume.csv, and index.html with all of it."""

import argparse
import csv
import sys
from collections.abc import Sequence
from html import escape
from pathlib import Path

try:
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
except ImportError as error:
    wanted = Path(__file__).with_name("requirements.txt")
    sys.exit(f"chart: {error.name} is not there; `make chart` installs it, or: pip install -r {wanted}")

import page
import peers
from families import FAMILIES, Chart, describe, scenes_of
from front import counts, hypervolume, knobs_never_on_front, never_on_front, point_of
from overview import overview
from panel import front_settings
from rows import ChartError, Row, read_machine, read_rows
from style import save

TITLES = {
    "sweeps": "Sweeps: every backend against the truth",
    "movement": "Whole movement",
    "shortcuts": "What each shortcut buys",
    "crowds": "Crowds",
    "scenes": "Size of the scene",
}

# Families that have errors: with a front, and a number for it.
WEIGHED = ("sweeps", "movement", "crowds")

# What a table shows of a row, and its name and unit there.
COLUMNS = [
    ("curve", "curve"),
    ("setting", "setting"),
    ("value", "value"),
    ("role", "there as"),
    ("reference", "judged by"),
    ("samples", "samples"),
    ("failed", "failed"),
    ("why", "how"),
    ("error_p50_m", "median error, m"),
    ("error_p99_m", "p99, m"),
    ("error_max_m", "worst, m"),
    ("penetration_m", "deepest, m"),
    ("ns_p50", "median, ns"),
    ("ns_p99", "p99, ns"),
    ("ns_mean", "mean, ns"),
    ("ns_per_second", "per s, ns"),
    ("queries", "queries"),
    ("tests", "tests"),
    ("iterations", "iterations"),
    ("saved", "saved"),
    ("bytes", "bytes / triangle"),
    ("build_s", "open, s"),
    ("threads", "threads"),
]


def shown(value) -> str | float:
    return value if isinstance(value, str) else float(value)


def rows_table(rows: Sequence[Row]) -> page.Table:
    """The rows of a chart, without columns that none of them has."""
    used = [
        (name, title)
        for name, title in COLUMNS
        if any(shown(getattr(r, name)) not in ("", 0.0) and getattr(r, name) == getattr(r, name) for r in rows)
    ]
    on_front = front_settings(rows)
    cells = [[shown(getattr(r, name)) for name, _ in used] for r in rows]
    marked = {i for i, r in enumerate(rows) if r.setting in on_front}
    return page.Table([title for _, title in used], cells, marked)


def volumes(rows: Sequence[Row]) -> list[tuple[str, float]]:
    """The hypervolume of each scene that has errors, and their mean."""
    found = []
    for scene in scenes_of(rows):
        points = [point_of(r) for r in rows if r.scene == scene and counts(r)]
        if points:
            found.append((scene, hypervolume(points)))
    if found:
        found.append(("mean", sum(v for _, v in found) / len(found)))
    return found


def family_section(name: str, rows: Sequence[Row], charts: Sequence[tuple[Chart, str]]) -> str:
    parts = [page.figure(chart.title, svg, chart.caption, rows_table(chart.rows)) for chart, svg in charts]
    if (found := volumes(rows)) and name in WEIGHED:
        numbers = ", ".join(f"{describe(scene) if scene != 'mean' else 'mean'}: {value:.2f}" for scene, value in found)
        parts.insert(
            0,
            "<p>Hypervolume of the front (decades of p99 error below 1 m times decades of median time below "
            f"100 µs per step of 1/60 s or per sweep; larger is better): {escape(numbers)}. Rows on the "
            "front of their picture are green in the tables; a click on a heading sorts.</p>",
        )
    if name in WEIGHED:
        parts.append(never_section(rows))
    return "\n".join(parts)


def never_section(rows: Sequence[Row]) -> str:
    """Settings that no scene has a use for, and values that are never the ones to choose."""
    never, knobs = never_on_front(rows), knobs_never_on_front(rows)
    lead = (
        "<h3>Never on a front</h3><p>Beaten is what another one of the same backend and rate beats on every scene, "
        "by more than 5 % in time or a factor of 1.5 in error without being worse in the other. Off switches, what is "
        "there for parity and all that a backend's engine can do are not weighed: the tables say of each point what it "
        f"is there as. Settings that are beaten at all of their values, and have to go: {escape(', '.join(knobs))}"
        f"{'' if knobs else 'none'}. Values that are beaten, of settings that have better ones:</p>"
    )
    cells = [[r.setting, r.curve, r.role] for r in never if r.curve not in knobs]
    if any(r.curve == "skin" and r.curve not in knobs for r in never):
        lead += "<p>A skin is off a path that touches the walls by itself; it is chosen for what it keeps apart.</p>"
    return lead + (page.table(page.Table(["value", "setting", "there as"], cells)) if cells else "<p>None.</p>")


def lead_section(machine: Sequence[tuple[str, str]], command: str) -> str:
    pairs = [list(pair) for pair in machine]
    return (
        "<p>What a step of Tahr costs, how wrong it is and where it fails, for each backend and setting. Both axes "
        "are logarithmic; down and to the left is better. Made by</p>"
        f"<pre>{escape(command)}</pre>"
        "<p>on this machine:</p>" + page.table(page.Table(["", "this machine"], pairs))
    )


def write_volumes(path: Path, found: Sequence[tuple[str, str, float]]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["family", "scene", "hypervolume"])
        writer.writerows((family, scene, f"{value:.3f}") for family, scene, value in found)


def draw_family(name: str, folder: Path, out: Path) -> tuple[str, list[Row]] | None:
    """HTML and rows of a family, or None if it was not measured."""
    path = folder / f"{name}.csv"
    if not path.exists():
        print(f"chart: {path} is not there: left out")
        return None
    rows = read_rows(path)
    if not rows:
        print(f"chart: {path} has no rows: left out")
        return None
    charts = [(chart, save(chart.figure, out, chart.name)) for chart in FAMILIES[name](rows)]
    print(f"chart: {name}: {len(charts)} pictures", flush=True)
    return family_section(name, rows, charts), rows


def print_never(name: str, rows: Sequence[Row]) -> None:
    for knob in knobs_never_on_front(rows):
        print(f"never on a front, at no value: {name}: {knob}")
    for row in never_on_front(rows):
        print(f"never on a front: {name}: {row.setting} ({row.role})")


def draw(folder: Path, out: Path, peer_file: Path | None, command: str) -> None:
    out.mkdir(parents=True, exist_ok=True)
    machine = read_machine(folder / "machine.csv")
    others = peers.read_peers(peer_file) if peer_file and peer_file.exists() else None
    sections, found, measured = [], [], {}
    for name in FAMILIES:
        if drawn := draw_family(name, folder, out):
            html, rows = drawn
            measured[name] = rows
            sections.append((name, TITLES[name], html))
            if name in WEIGHED:
                found += [(name, scene, value) for scene, value in volumes(rows)]
                print_never(name, rows)
    if others:
        sections.append(("peers", "Other controllers", peers.section(others, out)))
    else:
        print("chart: peers.csv is not there: without other controllers (make peers)")
    if "sweeps" in measured and "movement" in measured:
        save(overview(measured["sweeps"], measured["movement"]), out, "speed-accuracy")
    write_volumes(out / "hypervolume.csv", found)
    for family, scene, value in found:
        if scene == "mean":
            print(f"hypervolume: {family}: {value:.2f}")
    lead = lead_section(machine, command)
    (out / "index.html").write_text(page.page("Tahr: speed against accuracy", lead, sections))
    print(f"chart: {out / 'index.html'}")


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--in", dest="folder", type=Path, required=True, help="folder with the CSVs of tahr_chart")
    parser.add_argument("--out", type=Path, required=True, help="folder for pictures and page")
    parser.add_argument("--peers", type=Path, help="CSV of make peers")
    parser.add_argument("--command", default="make chart", help="what the page says it was made by")
    options = parser.parse_args(arguments)
    try:
        draw(options.folder, options.out, options.peers, options.command)
    except ChartError as error:
        print(f"chart: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"chart: {error.filename}: cannot be written: {error.strerror}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
