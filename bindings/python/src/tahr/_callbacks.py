# SPDX-License-Identifier: MIT
"""Python functions that C calls. What they are handed is theirs to keep; what they raise comes out of the step."""

import threading
from typing import Any, Callable, Dict, Optional, Sequence, Type, TypeVar

from ._constants import E_BACKEND, E_NOT_FOUND, OK, TRUNCATED
from ._errors import ArgumentError
from ._record import Record
from ._records import Contact, Hit
from ._tahr import ffi
from .query import BodyMotion, ContactQuery, Fluid, FluidQuery, Ray, Sweep

R = TypeVar("R", bound=Record)

SweepFunction = Callable[[Sweep], Optional[Hit]]
ContactsFunction = Callable[[ContactQuery], Sequence[Contact]]
RayFunction = Callable[[Ray], Optional[Hit]]
SensorsFunction = Callable[[Sweep], Sequence[Hit]]
BodyFunction = Callable[[int], Optional[BodyMotion]]
FluidFunction = Callable[[FluidQuery], Optional[Fluid]]


class Functions:
    """The functions behind a world or a mode, by name, and what they raised, by thread."""

    def __init__(self, **functions: Any) -> None:
        self.functions: Dict[str, Any] = functions
        self.raised: Dict[int, BaseException] = {}
        self.handle = ffi.new_handle(self)

    def take(self, any_thread: bool) -> Optional[BaseException]:
        """What was raised on this thread, and is now raised again; of a crowd also on others, which work for it."""
        found = self.raised.pop(threading.get_ident(), None)
        if found is None and any_thread and self.raised:
            found = self.raised.popitem()[1]
        return found

    def guard(self, call: Callable[[], int]) -> int:
        """Nothing leaves a function that C called."""
        try:
            return call()
        except BaseException as error:
            self.raised[threading.get_ident()] = error
            return E_BACKEND


def _expect(name: str, answer: object, kind: Type[R]) -> R:
    if not isinstance(answer, kind):
        raise ArgumentError(f"{name}: expected the function to return a tahr.{kind.__name__}, got {answer!r}")
    return answer


def _one(user: Any, name: str, query: Any, kind: Type[R], out: Any, missing: int = OK) -> int:
    functions: Functions = ffi.from_handle(user)

    def call() -> int:
        answer = functions.functions[name](query)
        if answer is None:
            return missing
        out[0] = _expect(name, answer, kind)._c[0]
        return OK

    return functions.guard(call)


def _many(user: Any, name: str, query: Any, kind: Type[R], out: Any, capacity: int, count: Any) -> int:
    functions: Functions = ffi.from_handle(user)

    def call() -> int:
        answers = functions.functions[name](query)
        if not isinstance(answers, (list, tuple)):
            raise ArgumentError(
                f"{name}: expected the function to return a list of tahr.{kind.__name__}, got {answers!r}"
            )
        for i, answer in enumerate(answers[:capacity]):
            out[i] = _expect(name, answer, kind)._c[0]
        count[0] = min(len(answers), capacity)
        return TRUNCATED if len(answers) > capacity else OK

    return functions.guard(call)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_sweep(user: Any, query: Any, hit: Any) -> int:
    return _one(user, "sweep", Sweep._copied(query), Hit, hit)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_ray(user: Any, query: Any, hit: Any) -> int:
    return _one(user, "ray", Ray._copied(query), Hit, hit)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_body(user: Any, body: int, motion: Any) -> int:
    return _one(user, "body", body, BodyMotion, motion, E_NOT_FOUND)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_fluid(user: Any, query: Any, fluid: Any) -> int:
    return _one(user, "fluid", FluidQuery._copied(query), Fluid, fluid)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_contacts(user: Any, query: Any, contacts: Any, capacity: int, count: Any) -> int:
    return _many(user, "contacts", ContactQuery._copied(query), Contact, contacts, capacity, count)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_sensors(user: Any, query: Any, hits: Any, capacity: int, count: Any) -> int:
    return _many(user, "sensors", Sweep._copied(query), Hit, hits, capacity, count)


@ffi.def_extern()  # type: ignore[untyped-decorator]
def python_line(user: Any, level: int, line: Any) -> None:
    ffi.from_handle(user).append(ffi.string(line).decode("utf-8", "replace"))
