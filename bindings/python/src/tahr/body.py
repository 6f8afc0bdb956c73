# SPDX-License-Identifier: MIT
"""The bodies of a scene."""

from typing import Any, List, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._constants import (
    BODY_BOX,
    BODY_CAPSULE,
    BODY_CHAIN,
    BODY_CONE,
    BODY_CYLINDER,
    BODY_ELLIPSOID,
    BODY_HEIGHTS,
    BODY_HULL,
    BODY_MESH,
    BODY_SPHERE,
)
from ._errors import ArgumentError
from ._record import Floats, numbers
from ._records import BodyFields
from ._status import check
from ._tahr import ffi, lib

Triangles = npt.NDArray[np.uint32]


def vertices_of(value: npt.ArrayLike, what: str) -> Floats:
    """float64 of shape (n, 3), contiguous."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"{what}: expected numbers of shape (n, 3), got {array.dtype} of shape {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def triangles_of(value: npt.ArrayLike, count: int, what: str) -> Triangles:
    """uint32 of shape (m, 3), contiguous, each below count."""
    array = np.asarray(value)
    if array.dtype.kind not in "iu" or array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"{what}: expected integers of shape (m, 3), got {array.dtype} of shape {array.shape}")
    bad = np.flatnonzero(((array < 0) | (array >= count)).any(axis=1))
    if len(bad):
        raise ArgumentError(f"{what}[{bad[0]}] is {array[bad[0]].tolist()}, expected indices of {count} vertices")
    return np.ascontiguousarray(array, dtype=np.uint32)


class Body(BodyFields):
    """One body of a scene; made by the functions below. Its id is its index in the list that a World is opened with.

    Fields beside those of its shape, as keywords: position (m) and orientation (unit quaternion x, y, z, w), which are
    short for those of pose, flags (BODY_*), mask, surface, walkable_rule, walkable_angle (rad), surface_velocity (m/s),
    mass (kg), fluid_friction (1/s). What is wrong with them World says, when it is opened.
    """

    __slots__ = ("_kept",)

    def __init__(self, type: int, **fields: Any) -> None:
        super().__init__()
        self._kept: List[Any] = []
        check(lib.tahr_body_desc_init(self._c, self.dtype.itemsize, type), "Body")
        for name in ("position", "orientation"):
            if name in fields:
                setattr(self.pose, name, fields.pop(name))
        self.update(**fields)

    def _keep(self, ctype: str, array: npt.NDArray[Any]) -> Any:
        pointer = ffi.from_buffer(ctype, array)
        self._kept.append(pointer)
        return pointer

    def _take_vertices(self, vertices: npt.ArrayLike, what: str) -> int:
        array = vertices_of(vertices, what)
        self._c.vertices = self._keep("double[]", array)
        self._c.vertex_count = len(array)
        return len(array)

    @classmethod
    def mesh(cls, vertices: npt.ArrayLike, triangles: npt.ArrayLike, **fields: Any) -> "Body":
        """Triangles. vertices: (n, 3), m, local; triangles: (m, 3) indices, counter-clockwise seen from the front."""
        body = cls(BODY_MESH, **fields)
        count = body._take_vertices(vertices, "Body.mesh: vertices")
        indices = triangles_of(triangles, count, "Body.mesh: triangles")
        body._c.indices = body._keep("uint32_t[]", indices)
        body._c.triangle_count = len(indices)
        return body

    @classmethod
    def box(cls, half_extents: npt.ArrayLike, **fields: Any) -> "Body":
        """half_extents: 3, m."""
        return cls(BODY_BOX, half_extents=half_extents, **fields)

    @classmethod
    def sphere(cls, radius: float, **fields: Any) -> "Body":
        """radius: m."""
        return cls(BODY_SPHERE, radius=radius, **fields)

    @classmethod
    def capsule(cls, radius: float, half_height: float, **fields: Any) -> "Body":
        """Along local z; half_height: m, with the caps in it."""
        return cls(BODY_CAPSULE, radius=radius, half_height=half_height, **fields)

    @classmethod
    def cylinder(cls, radius: float, half_height: float, **fields: Any) -> "Body":
        """Along local z; m. Not of the native backend."""
        return cls(BODY_CYLINDER, radius=radius, half_height=half_height, **fields)

    @classmethod
    def cone(cls, radius: float, half_height: float, **fields: Any) -> "Body":
        """Along local z, its apex at +half_height; m. Not of the native backend."""
        return cls(BODY_CONE, radius=radius, half_height=half_height, **fields)

    @classmethod
    def ellipsoid(cls, half_extents: npt.ArrayLike, **fields: Any) -> "Body":
        """half_extents: 3 semi-axes, m. Not of the native backend."""
        return cls(BODY_ELLIPSOID, half_extents=half_extents, **fields)

    @classmethod
    def hull(cls, vertices: npt.ArrayLike, **fields: Any) -> "Body":
        """The convex hull of (n, 3) vertices, m, local; 4 to 256 of them."""
        body = cls(BODY_HULL, **fields)
        body._take_vertices(vertices, "Body.hull: vertices")
        return body

    @classmethod
    def chain(cls, vertices: npt.ArrayLike, **fields: Any) -> "Body":
        """A line through (n, 3) vertices, m, local, in a world of two dimensions; z does not count."""
        body = cls(BODY_CHAIN, **fields)
        body._take_vertices(vertices, "Body.chain: vertices")
        return body

    @classmethod
    def heights(
        cls, heights: npt.ArrayLike, half_extents: Union[Tuple[float, float], npt.ArrayLike], **fields: Any
    ) -> "Body":
        """A field of heights (rows, columns), m along local z; NaN: a hole. half_extents: 2, m, half its size along
        local x (columns) and y (rows)."""
        array = np.asarray(heights)
        if array.dtype.kind not in "fiu" or array.ndim != 2:
            found = f"{array.dtype} of shape {array.shape}"
            raise ArgumentError(f"Body.heights: heights: expected numbers of shape (rows, columns), got {found}")
        half = numbers(half_extents, (2,), "Body.heights: half_extents")
        body = cls(BODY_HEIGHTS, half_extents=(half[0], half[1], 0.0), **fields)
        array = np.ascontiguousarray(array, dtype=np.float64)
        body._c.heights = body._keep("double[]", array)
        body._c.rows, body._c.columns = array.shape
        return body
