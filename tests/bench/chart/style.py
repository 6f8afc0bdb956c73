# SPDX-License-Identifier: MIT
"""How charts look, and how they are saved: the same bytes from the same numbers."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

# M. Okabe and K. Ito's colours, told apart by the colour-blind too; their yellow is too pale for lines on white. The
# last two are told apart from them by how dark they are.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7a5195", "#8a8a8a"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">"]
GREY = "#8a8a8a"
FAILED = "#b00020"

matplotlib.rcParams.update(
    {
        "font.family": "sans-serif",
        "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial"],
        "font.size": 9,
        "axes.titlesize": 9.5,
        "axes.titlelocation": "left",
        "axes.labelsize": 9,
        "axes.edgecolor": "#444444",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e6e6e6",
        "grid.linewidth": 0.6,
        "xtick.labelsize": 8,
        "ytick.labelsize": 8,
        "lines.linewidth": 1.4,
        "lines.markersize": 4.5,
        "figure.facecolor": "white",
        "savefig.facecolor": "white",
        "svg.fonttype": "none",
        "path.simplify": True,
    }
)


def panels(count: int, width: float = 4.5, height: float = 4.2, left: float = 0.75, lines: int = 1):
    """A figure of panels side by side in some lines, laid out for good, and its axes. width, height, left: inches, of
    one panel with what stands around it, and of what stands left of it."""
    figure, axes = pyplot.subplots(lines, count, figsize=(width * count, height * lines), squeeze=False)
    right, bottom, top = 0.22, 0.5, 0.35
    figure.subplots_adjust(
        left=left / (width * count),
        right=1 - right / (width * count),
        bottom=bottom / (height * lines),
        top=1 - top / (height * lines),
        wspace=(left + right) / (width - left - right),
        hspace=(bottom + top) / (height - bottom - top),
    )
    return figure, [one for line in axes for one in line]


def look(index: int) -> tuple[str, str]:
    """Colour and marker of the n-th curve of a chart."""
    return COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)]


def save(figure: Figure, folder: Path, name: str) -> str:
    """Writes name.svg and name.png; returns the SVG."""
    matplotlib.rcParams["svg.hashsalt"] = name
    svg = folder / f"{name}.svg"
    figure.savefig(svg, metadata={"Date": None, "Creator": None})
    figure.savefig(folder / f"{name}.png", dpi=110, metadata={"Software": None})
    pyplot.close(figure)
    return svg.read_text()
