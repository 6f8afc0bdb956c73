# SPDX-License-Identifier: MIT
"""The types of the messages that Tahr publishes over LCM, as lcm-gen makes them from the .lcm files.

``state_t().encode()`` gives the bytes of a message, ``state_t.decode(data)`` reads them; the fields and their units
are those of the .lcm files. Constants are attributes: ``state_t.MODE_WALKING``.

:mod:`tahr.telemetry` reads many messages at once, into NumPy arrays.
"""

from __future__ import annotations

import importlib
from typing import Any, ClassVar, Dict, Protocol, Type, cast

__all__ = ["Message", "body_t", "event_t", "input_t", "report_t", "snapshot_t", "state_t", "world_t", "constants"]


class Message(Protocol):
    """What every type of message has, beside its own fields."""

    __slots__: ClassVar[Any]

    def encode(self) -> bytes:
        """The message as it is sent: 8 bytes that tell its type and version, then its fields, highest byte first."""

    @staticmethod
    def decode(data: bytes) -> Any:
        """The message of these bytes. Raises ValueError where they are of another type or version."""

    def __getattr__(self, name: str) -> Any: ...

    def __setattr__(self, name: str, value: Any) -> None: ...


def _load(name: str) -> Type[Message]:
    try:
        module = importlib.import_module(f"tahr._messages.{name}")
    except ImportError as error:
        raise ModuleNotFoundError(
            "tahr was built without the types of its LCM messages: lcm-gen was not found. Install it (Debian: "
            "liblcm-bin; PyPI: lcm) and build tahr again",
            name=__name__,
        ) from error
    return cast(Type[Message], getattr(module, name))


def constants(message: Type[Message], prefix: str = "") -> Dict[int, str]:
    """Number -> name of the constants of a type that begin with prefix, in lower case and without it.

    ``constants(state_t, "MODE_")[1]`` is ``"walking"``, ``constants(event_t)[1]`` is ``"landed"``.
    """
    names = [name for name in vars(message) if name.isupper() and name.startswith(prefix)]
    return {int(getattr(message, name)): name[len(prefix) :].lower() for name in names}


body_t = _load("body_t")
event_t = _load("event_t")
input_t = _load("input_t")
report_t = _load("report_t")
snapshot_t = _load("snapshot_t")
state_t = _load("state_t")
world_t = _load("world_t")
