# SPDX-License-Identifier: MIT
"""Small worlds that the tests share."""

import numpy as np

import tahr

DT = 1 / 60

# A square of 40 m, its front up.
VERTICES = np.array([[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]], dtype=np.float64)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32)


def ground(**more):
    return tahr.World.from_mesh(VERTICES, TRIANGLES, **more)


def walk(mover, state, steps, move=(1, 0, 0), report=None):
    wish = tahr.Input(move=move)
    for _ in range(steps):
        mover.step(state, wish, DT, report)
    return state


def plane_sweep(query):
    """The plane z = 0, as the C quick start has it."""
    gap = query.position[2] - query.shape.half_height - query.margin
    drop = -query.motion[2]
    if gap < -query.margin:
        return tahr.Hit(start_overlap=1, depth=-gap - query.margin, normal=(0, 0, 1))
    if drop > 0 and gap <= drop:
        return tahr.Hit(blocking=1, fraction=max(gap, 0) / drop, normal=(0, 0, 1))
    return None
