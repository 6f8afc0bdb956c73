# SPDX-License-Identifier: MIT
"""The one picture that says most, for the README."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from families import NS_SECOND, NS_SWEEP
from panel import MEDIAN_ERROR, P99_ERROR, scatter
from rows import Row
from style import panels

SWEEP_CURVES = ("native float", "native double", "ccd advance", "ccd GJK", "ccd MPR", "fcl descend")
MOVEMENT_CURVES = ("precise", "two walls", "stepped", "unreal")


def overview(sweeps: Sequence[Row], movement: Sequence[Row]) -> Figure:
    """Sweeps of every backend on the left; a second of movement at 10 to 960 Hz beside them."""
    figure, (left, middle, right) = panels(3, width=4.0, height=3.8)
    own = [r for r in sweeps if r.scene == "meshes" and r.curve in SWEEP_CURVES and r.role != "off"]
    own = [r for r in own if r.curve != "fcl descend" or r.role == "default"]
    scatter(left, own, P99_ERROR, NS_SWEEP, with_front=True)
    left.set_title("a sweep")
    own = [r for r in movement if r.scene == "playground" and r.curve in MOVEMENT_CURVES]
    scatter(middle, own, MEDIAN_ERROR, NS_SECOND)
    middle.set_title("a second of movement, 10 to 960 Hz")
    scatter(right, own, P99_ERROR, NS_SECOND, with_front=True)
    right.set_title("the same, the worst cases")
    return figure
