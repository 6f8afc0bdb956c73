# SPDX-License-Identifier: MIT
"""A mode of one's own: a function that moves the character through a piece of time."""

import threading
from typing import Any, Callable, Optional, Tuple

import numpy.typing as npt

from ._callbacks import Functions
from ._constants import OK
from ._error import ClosedError
from ._errors import ArgumentError
from ._record import Floats, numbers
from ._records import Hit, Input
from ._status import check
from ._tahr import ffi, lib
from .query import Fluid
from .state import State


class Step:
    """The step under way, for the function of Mover.set_custom_mode, and only while that runs.

    The function is called as function(step, time), time in seconds. It returns None: all of the time was used and the
    mode goes on; or (mode, time_left): that mode goes on with what is left. To repeat a step it must do the same again.
    """

    __slots__ = ("_step", "_thread")

    def __init__(self, step: Any) -> None:
        self._step = step
        self._thread = threading.get_ident()

    @property
    def _c(self) -> Any:
        if self._step is None or self._thread != threading.get_ident():
            raise ClosedError("Step: it can be used inside the function that it was handed to, and nowhere else")
        return self._step

    @property
    def state(self) -> State:
        """The character as it is now: a copy."""
        return State._copied(lib.tahr_step_state(self._c))

    @property
    def input(self) -> Input:
        """The input of this step: a copy."""
        return Input._copied(lib.tahr_step_input(self._c))

    @property
    def gravity(self) -> Floats:
        """m/s2, world: of the input or of the config."""
        g = lib.tahr_step_gravity(self._c)
        return numbers((g.x, g.y, g.z), (3,), "Step.gravity")

    @staticmethod
    def _vector(value: npt.ArrayLike, what: str) -> Any:
        return ffi.new("tahr_vec3 *", tuple(numbers(value, (3,), what)))

    def set_velocity(self, velocity: npt.ArrayLike) -> None:
        """m/s, world; it moves nothing by itself."""
        check(lib.tahr_step_set_velocity(self._c, self._vector(velocity, "velocity")), "Step.set_velocity")

    def slide(self, motion: npt.ArrayLike) -> Tuple[Floats, Optional[Hit]]:
        """Moves the character by motion (m, world) and along what is in the way. Returns how far it came (m, world) and
        what was met last."""
        moved = ffi.new("tahr_step_moved *")
        check(lib.tahr_step_slide(self._c, self._vector(motion, "motion"), moved), "Step.slide")
        way = numbers((moved.motion.x, moved.motion.y, moved.motion.z), (3,), "Step.slide")
        return way, Hit._copied(ffi.addressof(moved, "last")) if moved.hits else None

    def sweep(self, motion: npt.ArrayLike) -> Hit:
        """Where motion (m, world) would be stopped, without moving; fraction 1 and blocking 0: nowhere."""
        hit = Hit()
        check(lib.tahr_step_sweep(self._c, self._vector(motion, "motion"), hit._c), "Step.sweep")
        return hit

    def ray(self, origin: npt.ArrayLike, motion: npt.ArrayLike) -> Hit:
        """The first thing between origin and origin + motion (m, world)."""
        hit = Hit()
        start, way = self._vector(origin, "origin"), self._vector(motion, "motion")
        check(lib.tahr_step_ray(self._c, start, way, hit._c), "Step.ray")
        return hit

    def fluid(self) -> Fluid:
        """How deep the character is in a fluid."""
        fluid = Fluid()
        check(lib.tahr_step_fluid(self._c, fluid._c), "Step.fluid")
        return fluid

    def event(self, after: float, value: float) -> None:
        """Reports EVENT_CUSTOM with a value of one's own, `after` seconds into the time that was given."""
        check(lib.tahr_step_event(self._c, after, value), "Step.event")


ModeFunction = Callable[[Step, float], Optional[Tuple[int, float]]]


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_custom_mode(user: Any, c_step: Any, time: float, following: Any) -> int:
    functions: Functions = ffi.from_handle(user)
    step = Step(c_step)

    def call() -> int:
        try:
            answer = functions.functions["mode"](step, time)
        finally:
            step._step = None
        if answer is not None:
            try:
                following.mode, following.time_left = answer
            except (TypeError, ValueError, OverflowError) as error:
                raise ArgumentError(f"custom mode: expected (mode, time_left) or None, got {answer!r}") from error
        return OK

    return functions.guard(call)
