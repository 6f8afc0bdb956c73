# SPDX-License-Identifier: MIT
"""Many characters in one step."""

from typing import Any, Optional, Sequence, Type, Union

import numpy.typing as npt

from ._arrays import pointer_to
from ._errors import ArgumentError, StructSizeError
from ._layout import dtype_of
from ._records import CrowdCounts
from ._status import check
from ._tahr import ffi, lib
from .config import Config
from .world import World

Array = npt.NDArray[Any]

_INPUT_SIZE = ffi.sizeof("tahr_input")


class Crowd:
    """Up to capacity characters in a world, each an obstacle of the others, in one deterministic step.

    configs: one, or a list that members choose from. threads: how many work on a step, 0: as many as there are
    processors; the result is the same with any number. flags: CROWD_*. One call uses a crowd at a time, another raises
    ReentrantError. After a fork the child starts threads of its own with its first step.
    Raises ArgumentError, UnsupportedError, MemoryError, ReentrantError (the world is in use), ClosedError.
    """

    __slots__ = ("world", "capacity", "_c", "__weakref__")

    def __init__(
        self,
        world: World,
        configs: Union[Config, Sequence[Config], None] = None,
        capacity: int = 1024,
        *,
        threads: int = 1,
        flags: int = 0,
        tasks: int = 0,
    ) -> None:
        if not isinstance(world, World):
            raise ArgumentError(f"Crowd: world is a {type(world).__name__}, expected a tahr.World")
        chosen = [Config()] if configs is None else [configs] if isinstance(configs, Config) else list(configs)
        for i, config in enumerate(chosen):
            if not isinstance(config, Config):
                raise ArgumentError(f"Crowd: configs[{i}] is a {type(config).__name__}, expected a tahr.Config")
        for name, value, most in (("capacity", capacity, 1 << 22), ("threads", threads, 256), ("tasks", tasks, 4096)):
            if not isinstance(value, int) or not (name == "capacity") <= value <= most:
                raise ArgumentError(f"Crowd: {name} is {value!r}, expected {int(name == 'capacity')} to {most}")
        copied = ffi.new("tahr_config[]", len(chosen) or 1)
        for i, config in enumerate(chosen):
            copied[i] = config._c[0]
        desc = ffi.new("tahr_crowd_desc *")
        lib.tahr_crowd_desc_init(desc, ffi.sizeof("tahr_crowd_desc"))
        desc.flags, desc.capacity, desc.tasks = flags, capacity, tasks
        desc.configs, desc.config_count = copied, len(chosen)
        made = ffi.new("glue_stepper **")
        check(lib.glue_crowd_create(world._c, desc, threads, made), "Crowd")
        self.world = world
        self.capacity = capacity
        self._c = ffi.gc(made[0], lib.glue_stepper_drop)

    def step(
        self,
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
        """Moves n characters through dt seconds, states in place; other Python threads run meanwhile.

        All arrays are contiguous, of shape (n,), n up to capacity, in the same order:
        inputs INPUT (tahr.inputs(n); one whose first struct_size is 0 gets them set); states STATE; members MEMBER
        (tahr.members(n)), None: ids are indices and everybody meets everybody; reports REPORT, written; events EVENT of
        shape (n, room), needs reports: reports["event_count"] says how many; statuses np.int32, written: what each step
        came to; delays DELAY (zeros at first), needed where a member has a budget.

        Returns OK or the largest positive status of all. Raises ArgumentError (names the array, or the character and
        its field), StructSizeError, BackendError, ReentrantError, ClosedError: a character that fails keeps its state,
        the others have moved.
        """
        count = len(states) if hasattr(states, "__len__") else 0
        tick = ffi.new("tahr_crowd_tick *")
        tick.struct_size = _TICK_SIZE
        tick.states = kept_states = pointer_to(states, "tahr_state", "Crowd.step", "states", None)
        tick.inputs = kept_inputs = self._inputs(inputs, count)
        tick.count = count
        tick.dt = dt
        kept = [kept_states, kept_inputs]
        for name, array, ctype in (
            ("members", members, "tahr_member"),
            ("reports", reports, "tahr_report"),
            ("statuses", statuses, "int32_t"),
            ("delays", delays, "tahr_delay"),
        ):
            if array is not None:
                pointer = pointer_to(array, ctype, "Crowd.step", name, count, write=name != "members")
                setattr(tick, name, pointer)
                kept.append(pointer)
        room, happened = 0, ffi.NULL
        if events is not None:
            room = self._room(events, reports, count)
            happened = pointer_to(events.reshape(-1), "tahr_event", "Crowd.step", "events", None)
        status: int = lib.glue_crowd_step(self._c, tick, happened, room)
        if status < 0:
            raise self.world._failed(status, "Crowd.step", any_thread=True)
        return status

    @staticmethod
    def _inputs(inputs: Array, count: int) -> Any:
        pointer = pointer_to(inputs, "tahr_input", "Crowd.step", "inputs", count, write=False)
        size = pointer[0].struct_size if count else _INPUT_SIZE
        if size == 0:
            if not inputs.flags.writeable:
                raise ArgumentError("Crowd.step: inputs is read-only without struct_size; make it with tahr.inputs(n)")
            inputs["struct_size"] = _INPUT_SIZE
        elif size != _INPUT_SIZE:  # C takes the first one's for the distance between two
            raise StructSizeError(f"Crowd.step: inputs[0].struct_size is {size}, expected {_INPUT_SIZE} or 0")
        return pointer

    @staticmethod
    def _room(events: Array, reports: Optional[Array], count: int) -> int:
        """How many events each character may have."""
        if reports is None:
            raise ArgumentError("Crowd.step: events without reports, which say how many there are")
        if getattr(events, "dtype", None) != dtype_of("tahr_event") or events.ndim != 2 or len(events) != count:
            found = f"{events.dtype} of shape {events.shape}" if hasattr(events, "dtype") else type(events).__name__
            raise ArgumentError(f"Crowd.step: events is {found[:120]}, expected tahr.EVENT of shape ({count}, room)")
        if not events.flags.c_contiguous or not events.flags.writeable:
            raise ArgumentError(
                "Crowd.step: events is read-only or not contiguous, expected a writeable array in C order"
            )
        return int(events.shape[1])

    def counts(self) -> CrowdCounts:
        """What all ticks came to since the crowd was made."""
        counts = CrowdCounts()
        check(lib.glue_crowd_counts(self._c, counts._c), "Crowd.counts")
        return counts

    def close(self) -> None:
        """Frees the crowd now. A second time does nothing. Raises ReentrantError while it or its world is in use."""
        check(lib.glue_stepper_close(self._c), "Crowd.close")

    def __enter__(self) -> "Crowd":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: object, traceback: object) -> None:
        self.close()


_TICK_SIZE = ffi.sizeof("tahr_crowd_tick")
