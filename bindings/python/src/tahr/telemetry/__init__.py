# SPDX-License-Identifier: MIT
"""Movement that was published over LCM: logs and live channels as NumPy arrays.

``read_log("run.lcmlog").states["position"]`` is an array of shape (n, 3).
"""

from ._events import Problem
from ._listener import Listener
from ._log import Log, LogWarning, ranges, read_log
from ._publisher import Publisher
from ._wire import KINDS

__all__ = ["KINDS", "Listener", "Log", "LogWarning", "Problem", "Publisher", "ranges", "read_log"]
