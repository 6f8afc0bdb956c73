# SPDX-License-Identifier: MIT
"""Pictures of movement that was logged (:mod:`tahr.telemetry`), by matplotlib.

``overview(read_log("run.lcmlog"), "level.obj").savefig("run.png")``
"""

from ._live import Live
from ._overview import overview
from .panels import above, height, modes, queries, side, speed

__all__ = ["Live", "above", "height", "modes", "overview", "queries", "side", "speed"]
