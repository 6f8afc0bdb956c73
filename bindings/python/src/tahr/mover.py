# SPDX-License-Identifier: MIT
"""One character at a time."""

from typing import Optional, Type

from ._callbacks import Functions
from ._errors import ArgumentError
from ._records import Input
from ._status import check
from ._tahr import ffi, lib
from .config import Config
from .custom_mode import ModeFunction
from .report import Report
from .state import State
from .world import World

_step = lib.glue_mover_step
_NO_REPORT = ffi.NULL


class Mover:
    """Steps characters of one config in a world. Holds nothing that matters to them: any mover of the same world and
    config steps any state, with the same bits. Movers may step on different threads at once; one by two raises
    ReentrantError. Raises UnsupportedError (a shape or a plane that the backend does not do), ClosedError."""

    __slots__ = ("world", "config", "_c", "_mode", "__weakref__")

    def __init__(self, world: World, config: Optional[Config] = None) -> None:
        if not isinstance(world, World):
            raise ArgumentError(f"Mover: world is a {type(world).__name__}, expected a tahr.World")
        self.world = world
        self.config = Config() if config is None else config.copy()
        self._mode: Optional[Functions] = None
        made = ffi.new("glue_stepper **")
        check(lib.glue_mover_create(world._c, self.config._c, made), "Mover")
        self._c = ffi.gc(made[0], lib.glue_stepper_drop)

    def step(self, state: State, input: Input, dt: float, report: Optional[Report] = None) -> int:
        """Moves a character through dt seconds (0 to config.max_dt); state is changed in place.

        Returns OK, or the worst of what else there is to say: TRUNCATED, UNKNOWN, STUCK, CRUSHED, QUERY_CAP.
        Raises ArgumentError (dt, input, state: the text names the field), BackendError, ReentrantError, ClosedError,
        and what a function of the world or the custom mode raised; then state and report are as they were.
        """
        try:
            status: int = _step(self._c, input._c, dt, state._c, _NO_REPORT if report is None else report._c)
        except (AttributeError, TypeError) as error:
            raise self._refuse(state, input, dt, report) from error
        if status < 0:
            raised = self._mode.take(False) if self._mode is not None else None
            raise raised if raised is not None else self.world._failed(status, "Mover.step")
        return status

    @staticmethod
    def _refuse(state: object, input: object, dt: object, report: object) -> ArgumentError:
        """Which argument is of the wrong type?"""
        if not isinstance(state, State):
            return ArgumentError(f"Mover.step: state is a {type(state).__name__}, expected a tahr.State")
        if not isinstance(input, Input):
            return ArgumentError(f"Mover.step: input is a {type(input).__name__}, expected a tahr.Input")
        if report is not None and not isinstance(report, Report):
            return ArgumentError(f"Mover.step: report is a {type(report).__name__}, expected a tahr.Report or None")
        return ArgumentError(f"Mover.step: dt is {dt!r}, expected seconds")

    def set_custom_mode(self, function: Optional[ModeFunction]) -> None:
        """The function of MODE_CUSTOM, function(step, time); None: none. See tahr.Step. Raises ReentrantError."""
        mode = None if function is None else Functions(mode=function)
        entry = ffi.NULL if mode is None else lib.python_custom_mode
        user = ffi.NULL if mode is None else mode.handle
        check(lib.glue_mover_set_custom_mode(self._c, entry, user), "Mover.set_custom_mode")
        self._mode = mode

    def close(self) -> None:
        """Frees the mover now. A second time does nothing. Raises ReentrantError while it steps."""
        check(lib.glue_stepper_close(self._c), "Mover.close")

    def __enter__(self) -> "Mover":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: object, traceback: object) -> None:
        self.close()
