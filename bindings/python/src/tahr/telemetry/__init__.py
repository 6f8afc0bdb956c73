# SPDX-License-Identifier: MIT
"""Movement that was published over LCM: logs and live channels as NumPy arrays.

``read_log("run.lcmlog").states["position"]`` is an array of shape (n, 3).
"""
from ._events import Problem
from ._listener import Listener
from ._log import Log, LogWarning, read_log

__all__ = ["Listener", "Log", "LogWarning", "Problem", "read_log"]
