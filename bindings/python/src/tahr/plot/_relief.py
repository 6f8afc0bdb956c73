# SPDX-License-Identifier: MIT
"""A level as a picture: the surface nearest to who looks at it, shaded, with walls and drops drawn as lines."""
from __future__ import annotations

from typing import Any, Iterator, NamedTuple, Tuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Array = npt.NDArray[Any]

# Steeper than about 84 degrees against the line of sight: has no area in the picture and is drawn as lines.
_EDGE_ON = 0.1

# Light from the upper left, at 45 degrees, as on printed maps.
_LIGHT = np.array([-0.5, 0.5, 0.7071067811865476])

# Pixels that are looked at in one go; bounds the memory, some 100 bytes each.
_CHUNK = 1 << 20

# Colours of ground that can be walked on, low and high, and of what is steeper; of lines; what each channel ends at.
_GROUND = np.array([[216.0, 227.0, 237.0], [253.0, 238.0, 205.0]])
_STEEP = np.array([[128.0, 134.0, 146.0], [158.0, 154.0, 146.0]])
_INK = np.array([58.0, 66.0, 82.0])


class View(NamedTuple):
    """What is seen: the plane of the picture, and towards whom. Rows are the directions right, up and nearer."""

    directions: Floats  # (3, 3)
    names: Tuple[str, str]  # of the directions right and up

    def project(self, points: Array) -> Floats:
        """(..., 3) in the world to (..., 3) right, up, nearer; m."""
        return np.asarray(points @ self.directions.T, np.float64)


#: From above, north up; from the south; and the side of a world of two dimensions.
ABOVE = View(np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]), ("x", "y"))
SOUTH = View(np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]), ("x", "z"))
FLAT = ABOVE


class Frame(NamedTuple):
    """The rectangle of the plane that is drawn (m), and how finely."""

    left: float
    right: float
    bottom: float
    top: float
    scale: float  # pixels per metre

    @property
    def shape(self) -> Tuple[int, int]:
        """Rows and columns of pixels."""
        return (
            max(1, int(np.ceil((self.top - self.bottom) * self.scale))),
            max(1, int(np.ceil((self.right - self.left) * self.scale))),
        )

    def to_pixels(self, points: Floats) -> Floats:
        """right, up, nearer in m to column, row (from the top) in pixels, nearer in m."""
        made = np.empty_like(points)
        made[..., 0] = (points[..., 0] - self.left) * self.scale
        made[..., 1] = (self.top - points[..., 1]) * self.scale
        made[..., 2] = points[..., 2]
        return made


def _expand(counts: Array) -> Tuple[Array, Array]:
    """For counts 2, 3: whose 0, 0, 1, 1, 1 and which of them 0, 1, 0, 1, 2."""
    whose = np.repeat(np.arange(len(counts)), counts)
    return whose, np.arange(len(whose)) - np.repeat(np.cumsum(counts) - counts, counts)


def _chunks(counts: Array) -> Iterator[slice]:
    """Slices of items whose counts are together no more than _CHUNK, but at least one item."""
    ends = np.cumsum(counts)
    begin = 0
    while begin < len(counts):
        before = ends[begin - 1] if begin else 0
        end = max(begin + 1, int(np.searchsorted(ends, before + _CHUNK, side="right")))
        yield slice(begin, end)
        begin = end


class _Canvas:
    """Depth, normal and ink of each pixel, rows from the top."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.near = np.full(frame.shape, -np.inf)
        self.normal = np.zeros((*frame.shape, 3))
        self.ink = np.full(frame.shape, -np.inf)

    def fill(self, corners: Floats, normals: Floats) -> None:
        """Triangles in pixels, (n, 3, 3), over what is farther away; what was filled before stays."""
        rows, columns = self.near.shape
        free = ~np.isfinite(self.near.ravel())
        low = np.floor(np.clip(corners[:, :, :2].min(axis=1), 0, [columns, rows])).astype(np.int64)
        high = np.ceil(np.clip(corners[:, :, :2].max(axis=1), 0, [columns, rows])).astype(np.int64)
        widths, heights = (high - low).T
        for part in _chunks(widths * heights):
            whose, which = _expand((widths * heights)[part])
            column = low[part, 0][whose] + which % widths[part][whose]
            row = low[part, 1][whose] + which // widths[part][whose]
            near, inside = _interpolate(corners[part][whose], column + 0.5, row + 0.5)
            pixel = row * columns + column
            inside &= free[pixel]
            inside[inside] = near[inside] > self.near.ravel()[pixel[inside]]
            self._put(pixel[inside], near[inside], normals[part][whose[inside]])

    def _put(self, pixel: Array, near: Floats, normals: Floats) -> None:
        order = np.argsort(near, kind="stable")  # where a pixel is named twice the last one stays
        self.near.ravel()[pixel[order]] = near[order]
        self.normal.reshape(-1, 3)[pixel[order]] = normals[order]

    def draw_lines(self, begins: Floats, ends: Floats) -> None:
        """Lines in pixels, (n, 3) each; the nearest of each pixel is kept."""
        rows, columns = self.near.shape
        counts = np.clip(np.abs(ends - begins)[:, :2].max(axis=1), 1, 1e5).astype(np.int64) + 1
        for part in _chunks(counts):
            whose, which = _expand(counts[part])
            along = which / (counts[part][whose] - 1)
            points = begins[part][whose] + (ends - begins)[part][whose] * along[:, None]
            column, row = np.floor(points[:, :2]).astype(np.int64).T
            seen = (column >= 0) & (row >= 0) & (column < columns) & (row < rows)
            np.maximum.at(self.ink.ravel(), (row * columns + column)[seen], points[seen, 2])

    def drops(self) -> Floats:
        """How much farther away the farthest neighbour of each pixel is; lines of drops lie on their nearer side."""
        near = np.where(np.isfinite(self.near), self.near, np.nan)
        padded = np.pad(near, 1, mode="edge")
        around = np.stack([padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]])
        return np.nan_to_num(near - np.fmin.reduce(around))


def _interpolate(corners: Floats, x: Array, y: Array) -> Tuple[Floats, npt.NDArray[np.bool_]]:
    """Depth of one triangle at each place, and whether the place is inside of it."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (corners[:, k].T for k in range(3))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    with np.errstate(divide="ignore", invalid="ignore"):
        u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area
        v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area
        inside = (area != 0) & (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9)
        return u * az + v * bz + (1 - u - v) * cz, inside


def draw(triangles: Floats, view: View, frame: Frame, walkable_cosine: float) -> npt.NDArray[np.uint8]:
    """The picture, shape (rows, columns, 4), of triangles (n, 3, 3) of the world: transparent where nothing is.

    Faces that look towards us by their winding come first, as rooms are modelled whose ceilings should not hide their
    floors; from above those that look away fill what is still empty, from the side they would be walls in front of
    everything. What is steeper than walkable_cosine is grey, seen from above.
    """
    seen = view.project(triangles)
    normals = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals[lengths > 0] / lengths[lengths > 0, None]
    corners = frame.to_pixels(seen[lengths > 0])
    towards = normals[:, 2]
    canvas = _Canvas(frame)
    canvas.fill(corners[towards >= _EDGE_ON], normals[towards >= _EDGE_ON])
    if view is not SOUTH:
        canvas.fill(corners[towards <= -_EDGE_ON], -normals[towards <= -_EDGE_ON])
    thin = corners[np.abs(towards) < _EDGE_ON]
    for k in range(3):
        canvas.draw_lines(thin[:, k], thin[:, (k + 1) % 3])
    return _colour(canvas, walkable_cosine)


def _colour(canvas: _Canvas, walkable_cosine: float) -> npt.NDArray[np.uint8]:
    is_ground = canvas.normal[..., 2] >= walkable_cosine
    heights = canvas.near[is_ground & np.isfinite(canvas.near)]
    low, high = (heights.min(), heights.max()) if len(heights) else (0.0, 0.0)
    tint = np.clip((canvas.near - low) / (high - low), 0, 1) if high > low else np.zeros(canvas.near.shape)
    shade = 0.72 + 0.4 * (canvas.normal @ _LIGHT)
    drop = canvas.drops() - 2 / canvas.frame.scale  # a slope of 63 degrees is no drop
    shade = np.where(drop > 0.03, shade * np.clip(0.8 - 0.4 * drop, 0.35, 1), shade)
    colours = np.where(is_ground[..., None], _mix(_GROUND, tint), _mix(_STEEP, tint)) * shade[..., None]
    colours[(canvas.ink >= canvas.near - 0.02) & np.isfinite(canvas.ink)] = _INK
    opaque = np.isfinite(canvas.near) | np.isfinite(canvas.ink)
    return np.dstack([np.clip(colours, 0, 255), np.where(opaque, 255, 0)]).astype(np.uint8)


def _mix(ends: Floats, along: Floats) -> Floats:
    return np.asarray(ends[0] + (ends[1] - ends[0]) * along[..., None])
