# SPDX-License-Identifier: MIT
"""Levels from files, through trimesh."""

import os
from typing import Any, Tuple, Union

import numpy as np

from ._errors import ArgumentError, FileError, NotFoundError, UnsupportedError
from ._record import Floats
from .body import Triangles


def _read(path: str) -> Any:
    try:
        import trimesh
    except ImportError as error:
        raise UnsupportedError("load_level: needs trimesh: pip install tahr[levels]") from error
    if not os.path.exists(path):
        raise NotFoundError(f"load_level: no such file: {path}")
    try:
        return trimesh.load_scene(path, process=False).to_mesh()
    except Exception as error:
        raise FileError(f"load_level: {path} is no level that trimesh reads: {error}") from error


def load_level(path: Union[str, "os.PathLike[str]"], up: str = "y") -> Tuple[Floats, Triangles]:
    """The triangles of all meshes of a file, where its scene places them: vertices (n, 3), m, z up, and triangles
    (m, 3). up: the file's axis, "y" (turned to z) or "z". Vertices of exactly the same place are made one.
    Raises NotFoundError, FileError, UnsupportedError (trimesh is not installed)."""
    if up not in ("y", "z"):
        raise ArgumentError(f"load_level: up is {up!r}, expected 'y' or 'z'")
    mesh = _read(os.fspath(path))
    places = np.asarray(mesh.vertices, dtype=np.float64)
    if len(mesh.faces) == 0:
        raise FileError(f"load_level: {os.fspath(path)} holds no triangles")
    if up == "y":
        places = np.stack([places[:, 0], -places[:, 2], places[:, 1]], axis=1)
    places = places + 0.0  # -0 and 0 are the same place
    vertices, first = np.unique(places, axis=0, return_inverse=True)
    triangles = first.reshape(-1)[np.asarray(mesh.faces)].astype(np.uint32)
    return np.ascontiguousarray(vertices), triangles
