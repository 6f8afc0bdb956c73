# SPDX-License-Identifier: MIT
"""Arrays of many characters and bodies: dtypes as the C structs, and arrays that begin as C expects them."""

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._arrays import pointer_to
from ._errors import ArgumentError
from ._layout import dtype_of
from ._record import numbers
from ._tahr import ffi, lib
from .body import vertices_of
from .config import Config

Array = npt.NDArray[Any]

STATE = dtype_of("tahr_state")
INPUT = dtype_of("tahr_input")
REPORT = dtype_of("tahr_report")
EVENT = dtype_of("tahr_event")
DECISION = dtype_of("tahr_decision")
QUERY_RECORD = dtype_of("tahr_query_record")
MEMBER = dtype_of("tahr_member")
DELAY = dtype_of("tahr_delay")
BODY_POSE = dtype_of("tahr_body_pose")
HIT = dtype_of("tahr_hit")
CONTACT = dtype_of("tahr_contact")


def states(config: Optional[Config], positions: npt.ArrayLike) -> Array:
    """Characters at rest: STATE of shape (n,). positions: (n, 3), m, world. Raises ArgumentError, naming the index."""
    places = vertices_of(positions, "states: positions")
    used = Config() if config is None else config
    made = np.zeros(len(places), STATE)
    done = ffi.new("size_t *")
    from_places = ffi.from_buffer("double[]", places)
    status = lib.glue_states_init(used._c, from_places, len(places), pointer_to(made, "tahr_state", "", "", None), done)
    if status < 0:
        used.check()
        raise ArgumentError(
            f"states: positions[{done[0]}] is {places[done[0]].tolist()}, expected numbers within 1e7 m"
        )
    return made


def hashes(array: Array) -> npt.NDArray[np.uint64]:
    """The hash of each STATE, uint64 of shape (n,)."""
    out = np.zeros(len(array), np.uint64)
    pointer = pointer_to(array, "tahr_state", "hashes", "array", None, write=False)
    lib.glue_states_hash(pointer, len(array), ffi.from_buffer("uint64_t[]", out))
    return out


def inputs(count: int) -> Array:
    """INPUT of shape (count,): nobody wants anything."""
    made = np.zeros(count, INPUT)
    made["struct_size"] = INPUT.itemsize
    return made


def members(count: int) -> Array:
    """MEMBER of shape (count,): ids are indices, everybody meets everybody and has the first config."""
    made = np.zeros(count, MEMBER)
    made["id"] = np.arange(count)
    return made


def poses(bodies: npt.ArrayLike, positions: npt.ArrayLike, orientations: Optional[npt.ArrayLike] = None) -> Array:
    """Where bodies shall be, for World.set and World.move: BODY_POSE of shape (n,). bodies: (n,) ids; positions:
    (n, 3), m, world; orientations: (n, 4) unit quaternions x, y, z, w, None: none is turned."""
    ids = np.asarray(bodies)
    if ids.ndim != 1 or ids.dtype.kind not in "iu" or (ids < 0).any() or (ids > 0xFFFFFFFF).any():
        raise ArgumentError(f"poses: bodies is {bodies!r}, expected ids of bodies, of shape (n,)")
    made = np.zeros(len(ids), BODY_POSE)
    made["body"] = ids
    made["pose"]["position"] = numbers(positions, (len(ids), 3), "poses: positions")
    turned = np.tile((0.0, 0.0, 0.0, 1.0), (len(ids), 1)) if orientations is None else orientations
    made["pose"]["orientation"] = numbers(turned, (len(ids), 4), "poses: orientations")
    return made
