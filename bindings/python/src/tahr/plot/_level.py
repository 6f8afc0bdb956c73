# SPDX-License-Identifier: MIT
"""The level that movement is shown in."""

from __future__ import annotations

import os
from typing import Any, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

#: A file for tahr.load_level, or its answer: vertices (n, 3), m, z up, and triangles (m, 3).
Level = Union[str, "os.PathLike[str]", Tuple[npt.NDArray[Any], npt.NDArray[Any]], None]


def load_triangles(level: Level, up: str = "y") -> Optional[Floats]:
    """The triangles of a level, shape (n, 3, 3), m. Raises ValueError where arrays are no level, and what
    tahr.load_level raises."""
    if level is None:
        return None
    if isinstance(level, (str, os.PathLike)):
        from .. import load_level

        level = load_level(level, up)
    vertices, triangles = (np.asarray(part) for part in level)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or triangles.ndim != 2 or triangles.shape[1] != 3:
        raise ValueError(
            f"level: expected vertices of shape (n, 3) and triangles of shape (m, 3), got {vertices.shape} and "
            f"{triangles.shape}"
        )
    corners: Floats = np.asarray(vertices, np.float64)[triangles]
    return corners
