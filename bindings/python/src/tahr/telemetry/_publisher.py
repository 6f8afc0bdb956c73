# SPDX-License-Identifier: MIT
"""Publishing what is stepped in Python, over LCM."""

from __future__ import annotations

import os
import weakref
from typing import TYPE_CHECKING, Any, Dict, Optional, Sequence, Tuple, Type, Union

import numpy as np
import numpy.typing as npt

from ._wire import KINDS

if TYPE_CHECKING:
    from .. import Config, Crowd, Input, Mover, Report, State, World

Array = npt.NDArray[Any]

#: Kind -> how many messages.
Counts = Dict[str, Dict[str, int]]

_SUMS = ("offered", "thinned", "dropped", "delivered", "failed")


class Publisher:
    """Publishes steps taken in Python as the C library does: they leave their messages in a ring in memory, and a
    thread of the library's, not of Python's, sends them. A network that stalls holds up no step; what finds no room in
    the ring is dropped and counted.

        with tahr.telemetry.Publisher(world, config, characters=1) as publisher:
            publisher.step(mover, state, tahr.Input(move=(1, 0, 0)), 1 / 60)

    It is used by one thread at a time, another one raises ReentrantError. After a fork the child has no such thread: it
    raises UnsupportedError there, open another one.

    Args:
        world: in which the steps are taken
        configs: those of the movers or of the crowd, one or several
        characters: ids are below this
        url: udpm://, file:// (to be written), memq://; None: the environment's LCM_DEFAULT_URL, or else LCM's default
        prefix: put before the names of the channels
        level: name of the scene; level_hash: equal scenes have equal ones
        every: the state of every n-th step of a character; state_rate: Hz, and no more states than these in a
            simulated second; 0: all
        ring_bytes: of the ring in memory, 4096 to 2^30; 0: 4 MiB
        bodies: the most bodies that move
        id_suffix: the channels of characters end in _ID

    Raises:
        UnsupportedError: built without LCM; a URL of a kind that is not published to
        ArgumentError: names the field; FileError: cannot be written; NotFoundError: no route for multicast
    """

    def __init__(
        self,
        world: World,
        configs: "Union[Config, Sequence[Config], None]" = None,
        characters: int = 1,
        url: Optional[str] = None,
        *,
        prefix: Optional[str] = None,
        level: str = "",
        level_hash: int = 0,
        every: int = 1,
        state_rate: float = 0.0,
        ring_bytes: int = 0,
        bodies: int = 1024,
        id_suffix: bool = False,
    ) -> None:
        from .. import Config, UnsupportedError
        from .._status import check
        from .._tahr import ffi, lib

        if not hasattr(lib, "glue_publisher_open"):
            raise UnsupportedError("Publisher: this package was built without LCM (liblcm and lcm-gen were not found)")
        chosen = [Config()] if configs is None else [configs] if isinstance(configs, Config) else list(configs)
        copied = ffi.new("tahr_config[]", len(chosen) or 1)
        for i, config in enumerate(chosen):
            copied[i] = config._c[0]
        texts = {name: ffi.new("char[]", text.encode()) for name, text in _texts(world, url, prefix, level).items()}
        channels = ffi.new("tahr_lcm_desc *")
        lib.tahr_lcm_desc_init(channels, ffi.sizeof("tahr_lcm_desc"))
        channels.flags = lib.TAHR_LCM_ID_SUFFIX if id_suffix else 0
        channels.url, channels.prefix = texts.get("url", ffi.NULL), texts.get("prefix", ffi.NULL)
        channels.log = lib.glue_log()
        desc = ffi.new("tahr_telemetry_desc *")
        lib.tahr_telemetry_desc_init(desc, ffi.sizeof("tahr_telemetry_desc"))
        _fill(desc, characters=characters, every=every, state_rate=state_rate, ring_bytes=ring_bytes, bodies=bodies)
        _fill(desc, level_hash=level_hash, revision=world.revision, config_count=len(chosen), configs=copied)
        desc.level, desc.backend, desc.log = texts["level"], texts["backend"], lib.glue_log()
        made = ffi.new("glue_publisher **")
        check(lib.glue_publisher_open(channels, desc, made), "Publisher")
        self.world = world
        self._ffi, self._lib, self._check = ffi, lib, check
        self._c = ffi.gc(made[0], lib.glue_publisher_drop)
        self._whom = ffi.new("glue_published *")
        self._told: Any = None  # what is in it; keeps the mover
        self._ends = (characters, len(chosen))
        self._last: Any = None
        self._reports: "tuple[Array, Array, Array] | None" = None
        self._left: Any = None
        _opened.add(self)

    def step(
        self,
        mover: Mover,
        state: State,
        input: Input,
        dt: float,
        report: "Optional[Report]" = None,
        *,
        character: int = 0,
        config: int = 0,
    ) -> int:
        """Mover.step, and published: as this character's, with this one of the configs. Raises what Mover.step raises,
        and ArgumentError (character, config)."""
        try:
            whom = (mover, character, config, 0 if mover._mode is None else self._lib.TAHR_STEP_CUSTOM)
            if whom != self._told:
                self._tell(whom)
            used = self._ffi.NULL if report is None else report._c
            status: int = self._lib.glue_publisher_step(self._c, self._whom, input._c, dt, state._c, used)
        except (AttributeError, TypeError) as error:
            raise _refuse(mover, state, input, dt, report) from error
        if status < 0:
            raised = mover._mode.take(False) if mover._mode is not None else None
            raise raised if raised is not None else self.world._failed(status, "Publisher.step")
        return status

    def _tell(self, whom: Tuple[Mover, int, int, int]) -> None:
        from .. import ArgumentError

        for name, value, end in zip(("character", "config"), whom[1:], self._ends):
            if not isinstance(value, int) or not 0 <= value < end:
                raise ArgumentError(f"Publisher.step: {name} is {value!r}, expected 0 to {end - 1}")
        self._whom.mover = whom[0]._c
        self._whom.character, self._whom.config, self._whom.flags = whom[1:]
        self._told = whom

    def step_crowd(
        self,
        crowd: Crowd,
        inputs: Array,
        dt: float,
        states: Array,
        *,
        members: Optional[Array] = None,
        reports: Optional[Array] = None,
        events: Optional[Array] = None,
        statuses: Optional[Array] = None,
        delays: Optional[Array] = None,
    ) -> int:
        """Crowd.step, and published: the character at index i with the id i. Raises what Crowd.step raises, and
        ArgumentError where there are more characters than the publisher was made for."""
        from .. import ArgumentError

        own = self._room_for(len(states) if hasattr(states, "__len__") else 0)
        if len(own[0]) > self._ends[0]:
            raise ArgumentError(f"Publisher.step_crowd: {len(own[0])} characters, expected up to {self._ends[0]}")
        if reports is None:
            reports, events = own[0], own[1] if events is None else events
        given = {
            "members": members,
            "reports": reports,
            "statuses": own[2] if statuses is None else statuses,
            "delays": delays,
        }
        tick, happened, room, kept = crowd._tick("Publisher.step_crowd", inputs, dt, states, events, given)
        status: int = self._lib.glue_publisher_crowd_step(self._c, crowd._c, tick, happened, room)
        del kept
        if status < 0:
            raise self.world._failed(status, "Publisher.step_crowd", any_thread=True)
        return status

    def _room_for(self, count: int) -> "tuple[Array, Array, Array]":
        """Reports, events and statuses for who wants none."""
        from .. import EVENT, REPORT

        if self._reports is None or len(self._reports[0]) != count:
            self._reports = np.zeros(count, REPORT), np.zeros((count, 16), EVENT), np.zeros(count, np.int32)
        return self._reports

    def set(self, poses: Array) -> None:
        """World.set, and published."""
        self._change("set", self._lib.TAHR_CHANGE_SET, poses, 0.0)

    def move(self, poses: Array, dt: float) -> None:
        """World.move, and published."""
        from .. import ArgumentError

        if not 0 < dt:
            raise ArgumentError(f"Publisher.move: dt is {dt!r}, expected seconds above 0")
        self._change("move", self._lib.TAHR_CHANGE_MOVE, poses, dt)

    def touch(self) -> None:
        """World.touch, and published."""
        self._change("touch", self._lib.TAHR_CHANGE_TOUCH, None, 0.0)

    def _change(self, name: str, kind: int, poses: Optional[Array], dt: float) -> None:
        from .._arrays import pointer_to

        caller = f"Publisher.{name}"
        out, count = self._ffi.NULL, 0
        if poses is not None:
            out = pointer_to(poses, "tahr_body_pose", caller, "poses", None, write=False)
            count = len(poses)
        status = self._lib.glue_publisher_change(self._c, self.world._c, kind, out, count, dt)
        if status < 0:
            raise self.world._failed(status, caller)

    def latest(self, character: int = 0) -> State:
        """The state of a character after its last step, whatever became of the messages. Any thread may ask. Raises
        ArgumentError, NotFoundError (it has not been stepped yet)."""
        from .. import State

        state = State()
        self._check(self._lib.glue_publisher_latest(self._c, character, state._c), "Publisher.latest")
        return state

    @property
    def counts(self) -> Counts:
        """Kind -> how many messages were offered, thinned (not due), dropped (no room), delivered and failed so far;
        after close() all of them."""
        if self._last is None:
            counts = self._ffi.new("tahr_telemetry_counts *")
            counts.struct_size = self._ffi.sizeof("tahr_telemetry_counts")
            self._check(self._lib.glue_publisher_counts(self._c, counts), "Publisher.counts")
        else:
            counts = self._last
        return {kind: {name: int(getattr(counts, name)[i]) for name in _SUMS} for i, kind in enumerate(KINDS)}

    def close(self, timeout: float = 2.0, drain: bool = True) -> None:
        """Ends publishing, after at most timeout seconds; drain False: what is in the ring is dropped. A second time
        does nothing. Raises TimeoutError where the network does not take a message at all, ArgumentError (timeout)."""
        counts = self._ffi.new("tahr_telemetry_counts *")
        counts.struct_size = self._ffi.sizeof("tahr_telemetry_counts")
        how = self._lib.TAHR_STOP_DRAIN if drain else self._lib.TAHR_STOP_ABANDON
        status = self._lib.glue_publisher_close(self._c, how, timeout, counts)
        if self._last is None and any(counts.offered):  # those of the world are, if it was open
            self._last = counts
        self._check(status, "Publisher.close")

    def __enter__(self) -> "Publisher":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: object, traceback: object) -> None:
        self.close()


_opened: "weakref.WeakSet[Publisher]" = weakref.WeakSet()


def _leave_behind() -> None:
    """In a fork: the thread that publishes is not there. What is left of it is kept, so that nobody frees it."""
    for publisher in _opened:
        if publisher._c is not None:
            publisher._left, publisher._c = publisher._c, publisher._ffi.NULL


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_leave_behind)


def _refuse(mover: object, state: object, input: object, dt: object, report: object) -> Exception:
    """Which argument is of the wrong type?"""
    from .. import ArgumentError, Mover

    if not isinstance(mover, Mover):
        return ArgumentError(f"Publisher.step: mover is a {type(mover).__name__}, expected a tahr.Mover")
    return mover._refuse(state, input, dt, report)


def _texts(world: World, url: Optional[str], prefix: Optional[str], level: str) -> Dict[str, str]:
    texts = {"url": url, "prefix": prefix, "level": level, "backend": world.backend}
    return {name: text for name, text in texts.items() if text is not None}


def _fill(desc: Any, **fields: Any) -> None:
    """Sets fields of a C struct, or raises ArgumentError."""
    from .. import ArgumentError

    for name, value in fields.items():
        try:
            setattr(desc, name, value)
        except (OverflowError, TypeError) as error:
            raise ArgumentError(f"Publisher: {name} is {value!r}, expected a number of its range") from error
