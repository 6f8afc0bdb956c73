# SPDX-License-Identifier: MIT
"""All that decides a character's future: 512 bytes."""

from typing import Any, Optional

import numpy.typing as npt

from ._arrays import pointer_to
from ._errors import ArgumentError
from ._record import numbers
from ._records import StateFields
from ._status import check
from ._tahr import ffi, lib
from .config import Config


class State(StateFields):
    """A character at rest at a place (m, world; the centre of its shape), falling until a step finds the floor.

    Plain data: copy() is a snapshot, == and hash() compare, assign() goes back, bytes() can be sent. config None is the
    preset "precise". Raises ArgumentError for a place that is not three finite numbers within 1e7 m.
    """

    __slots__ = ()

    def __init__(
        self, config: Optional[Config] = None, position: npt.ArrayLike = (0.0, 0.0, 0.0), **fields: Any
    ) -> None:
        super().__init__()
        used = Config() if config is None else config
        place = ffi.new("tahr_vec3 *", tuple(numbers(position, (3,), "State.position")))
        if lib.tahr_state_init(self._c, used._c, place) < 0:
            used.check()
            raise ArgumentError(f"State: position is {position!r}, expected finite numbers within 1e7 m")
        self.update(**fields)

    @classmethod
    def of(cls, states: npt.NDArray[Any], index: int) -> "State":
        """A view of one character of a crowd: states[index], to be read, hashed, written. No copy."""
        if not -len(states) <= index < len(states):
            raise ArgumentError(f"State.of: index is {index}, expected one of {len(states)} states")
        base = pointer_to(states, "tahr_state", "State.of", "states", None)
        index %= len(states)
        return cls._view(base + index, states[index : index + 1].reshape(()))

    def teleport(self, position: npt.ArrayLike) -> None:
        """Puts the character somewhere else (m, world): floor, base and touched sensors are forgotten, velocity and
        mode stay. Raises ArgumentError."""
        place = ffi.new("tahr_vec3 *", tuple(numbers(position, (3,), "State.teleport: position")))
        if lib.tahr_state_teleport(self._c, place) < 0:
            raise ArgumentError(f"State.teleport: position is {position!r}, expected finite numbers within 1e7 m")

    def hash(self) -> int:
        """64 bits, the same on every machine for equal states, -0.0 taken for 0.0."""
        return int(lib.tahr_state_hash(self._c))

    @property
    def mode_name(self) -> str:
        """ "walking", "falling", ..."""
        return mode_name(self.mode)


def mode_name(mode: int) -> str:
    """The name of a MODE_*; "?" for a number that is none."""
    return str(ffi.string(lib.tahr_mode_name(mode)).decode())
