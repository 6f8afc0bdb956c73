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

# Pixels that are looked at in one go; bounds the memory, some 50 bytes each.
_CHUNK = 1 << 20

# So much beside a side a pixel's middle is still on it: as much as the sums above it are wrong by.
_ON_EDGE = 1e-9

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


class _Spans(NamedTuple):
    """Rows of pixels that triangles cover, each from its first pixel on."""

    owner: Array  # which triangle
    first: Array  # pixel
    length: Array  # pixels
    near: Floats  # at the first one, m
    slope: Floats  # by how much it grows to the next one


def _spans(corners: Floats, rows: int, columns: int) -> _Spans:
    """What triangles in pixels, (n, 3, 3), cover: the pixels whose middle is inside of them."""
    x, y, z = (corners[:, :, k] for k in range(3))
    begin = np.clip(np.ceil(y.min(axis=1) - 0.5), 0, rows).astype(np.int64)
    end = np.clip(np.floor(y.max(axis=1) - 0.5), -1, rows - 1).astype(np.int64)
    owner, which = _expand(np.maximum(end - begin + 1, 0))
    row = begin[owner] + which
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        for k, m in ((0, 1), (1, 2), (2, 0)):  # where each side crosses the middle of the row, if it does
            part = (row + 0.5 - y[owner, k]) / (y[owner, m] - y[owner, k])
            at = np.where((part >= 0) & (part <= 1), x[owner, k] + part * (x[owner, m] - x[owner, k]), np.nan)
            left, right = np.fmin(left, at), np.fmax(right, at)
        area = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0])
        slope_x = ((z[:, 1] - z[:, 0]) * (y[:, 2] - y[:, 0]) - (z[:, 2] - z[:, 0]) * (y[:, 1] - y[:, 0])) / area
        slope_y = ((x[:, 1] - x[:, 0]) * (z[:, 2] - z[:, 0]) - (x[:, 2] - x[:, 0]) * (z[:, 1] - z[:, 0])) / area
    first = np.ceil(np.clip(left - 0.5 - _ON_EDGE, 0, columns)).astype(np.int64)
    last = np.floor(np.clip(right - 0.5 + _ON_EDGE, -1, columns - 1)).astype(np.int64)
    near = z[owner, 0] + slope_x[owner] * (first + 0.5 - x[owner, 0]) + slope_y[owner] * (row + 0.5 - y[owner, 0])
    kept = (last >= first) & np.isfinite(near)
    spans = _Spans(owner, row * columns + first, last - first + 1, near, slope_x[owner])
    return _Spans(*(column[kept] for column in spans))


class _Canvas:
    """The nearest triangle of each pixel, how near it is, and the ink upon it; rows from the top."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.near = np.full(frame.shape, -np.inf)
        self.owner = np.zeros(frame.shape, np.int64)
        self.ink = np.full(frame.shape, -np.inf)

    def fill(self, corners: Floats, numbers: Array) -> None:
        """Triangles in pixels, (n, 3, 3), with these numbers, into what is still empty."""
        near, owner = self.near.ravel(), self.owner.ravel()
        free = ~np.isfinite(near)
        spans = _spans(corners, *self.near.shape)
        for part in _chunks(spans.length):
            whose, which = _expand(spans.length[part])
            pixel = spans.first[part][whose] + which
            here = spans.near[part][whose] + spans.slope[part][whose] * which
            here[~free[pixel]] = -np.inf
            np.maximum.at(near, pixel, here)
            nearest = (here == near[pixel]) & free[pixel]
            owner[pixel[nearest]] = numbers[spans.owner[part][whose[nearest]]]

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
        return np.asarray(np.nan_to_num(near - np.fmin.reduce(around)))


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
    front, back = np.flatnonzero(towards >= _EDGE_ON), np.flatnonzero(towards <= -_EDGE_ON)
    canvas.fill(corners[front], front)
    if view is not SOUTH:
        canvas.fill(corners[back], back)
    normals[back] *= -1
    thin = corners[np.abs(towards) < _EDGE_ON]
    for k in range(3):
        canvas.draw_lines(thin[:, k], thin[:, (k + 1) % 3])
    return _colour(canvas, normals, walkable_cosine)


def _colour(canvas: _Canvas, normals: Floats, walkable_cosine: float) -> npt.NDArray[np.uint8]:
    normal = normals[canvas.owner] if len(normals) else np.zeros((*canvas.near.shape, 3))
    is_ground = normal[..., 2] >= walkable_cosine
    heights = canvas.near[is_ground & np.isfinite(canvas.near)]
    low, high = (heights.min(), heights.max()) if len(heights) else (0.0, 0.0)
    tint = np.clip((canvas.near - low) / (high - low), 0, 1) if high > low else np.zeros(canvas.near.shape)
    shade = 0.72 + 0.4 * (normal @ _LIGHT)
    drop = canvas.drops() - 2 / canvas.frame.scale  # a slope of 63 degrees is no drop
    shade = np.where(drop > 0.03, shade * np.clip(0.8 - 0.4 * drop, 0.35, 1), shade)
    colours = np.where(is_ground[..., None], _mix(_GROUND, tint), _mix(_STEEP, tint)) * shade[..., None]
    colours[(canvas.ink >= canvas.near - 0.02) & np.isfinite(canvas.ink)] = _INK
    opaque = np.isfinite(canvas.near) | np.isfinite(canvas.ink)
    return np.dstack([np.clip(colours, 0, 255), np.where(opaque, 255, 0)]).astype(np.uint8)


def _mix(ends: Floats, along: Floats) -> Floats:
    return np.asarray(ends[0] + (ends[1] - ends[0]) * along[..., None])
