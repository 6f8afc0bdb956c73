# SPDX-License-Identifier: MIT
"""The one picture that says most, for the README."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from families import NS_SECOND, NS_SWEEP
from panel import P99_ERROR, scatter
from rows import Row
from style import panels

SWEEP_CURVES = ("native", "ccd advance", "ccd GJK", "ccd MPR", "fcl descend")
MOVEMENT_CURVES = ("precise", "two walls", "stepped", "unreal")


def overview(sweeps: Sequence[Row], movement: Sequence[Row]) -> Figure:
    """Sweeps of every backend on the left; a second of movement at 10 to 1000 Hz beside them, free and among things."""
    figure, (left, middle, right) = panels(3, width=4.0, height=3.8)
    own = [r for r in sweeps if r.scene == "meshes" and r.curve in SWEEP_CURVES and r.role != "off"]
    own = [r for r in own if r.curve != "fcl descend" or r.role == "default"]
    scatter(left, own, P99_ERROR, NS_SWEEP, with_front=True)
    left.set_title("a sweep against a small mesh")
    for axes, scene, title in (
        (middle, "plane", "speed up, brake, jump; 10 to 1000 Hz"),
        (right, "playground", "a second of the playground, likewise"),
    ):
        own = [r for r in movement if r.scene == scene and r.curve in MOVEMENT_CURVES]
        scatter(axes, own, P99_ERROR, NS_SECOND, with_front=True, order=MOVEMENT_CURVES)
        axes.set_title(title)
    return figure
