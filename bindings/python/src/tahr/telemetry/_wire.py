# SPDX-License-Identifier: MIT
"""How the fields of a message lie in its bytes, and many messages at once as a NumPy array."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Sequence, Tuple, Type

import numpy as np
import numpy.typing as npt

from .. import messages

Array = npt.NDArray[Any]

#: What is told, in the order of TAHR_MESSAGE_* of the C library, and the type of its messages.
KINDS: Dict[str, Type[messages.Message]] = {
    "state": messages.state_t,
    "event": messages.event_t,
    "input": messages.input_t,
    "report": messages.report_t,
    "snapshot": messages.snapshot_t,
    "body": messages.body_t,
    "world": messages.world_t,
}

#: Bytes before the fields: they tell the type and its version.
FINGERPRINT = 8

# A value of which no byte is 0 in either width, so that a field shows itself in the bytes of a message.
_FULL_REAL = -1.1


def blank(kind: str) -> messages.Message:
    """A message that can be encoded: lcm-gen 1.3 gives its arrays of bytes an empty string, which cannot."""
    message = KINDS[kind]()
    for name in ("", *message.__slots__):
        value = getattr(message, name, None)
        try:
            if value == "":
                setattr(message, name, b"")
            message.encode()
            return message
        except (TypeError, AttributeError):
            if name:
                setattr(message, name, value)
    raise ImportError(f"tahr: a {kind} message without contents cannot be encoded: lcm-gen made something unknown")


def fingerprint(kind: str) -> bytes:
    """The first bytes of every message of a kind."""
    return blank(kind).encode()[:FINGERPRINT]


class Field(NamedTuple):
    """Where a field is: offset from the beginning of the message in bytes, and what it holds in NumPy's words."""

    name: str
    offset: int
    letter: str  # f, i, b (a boolean)
    width: int  # bytes of one number
    length: int  # of an array; 0: none


def _measure(kind: str, name: str) -> "Field | None":
    """Sets one field, and looks where the bytes of the message change; None: the field is of no fixed size."""
    message = blank(kind)
    before = np.frombuffer(message.encode(), np.uint8)
    value = getattr(message, name)
    if isinstance(value, (str, bytes)):
        return None
    count = len(value) if isinstance(value, (list, tuple)) else 0
    sample = value[0] if count else value
    full: "float | bool" = _FULL_REAL if isinstance(sample, float) else True if isinstance(sample, bool) else -1
    setattr(message, name, [full] * count if count else full)
    touched = np.flatnonzero(np.frombuffer(message.encode(), np.uint8) != before)
    letter = "f" if isinstance(full, float) else "b" if isinstance(full, bool) else "i"
    return Field(name, int(touched[0]), letter, len(touched) // max(count, 1), count)


def fields(kind: str) -> List[Field]:
    """The fields of a kind, in order, up to the first one whose size is not always the same."""
    found: List[Field] = []
    for name in KINDS[kind].__slots__:
        field = _measure(kind, name)
        if field is None:
            break
        found.append(field)
    return found


def _native_type(field: Field) -> str:
    if field.letter == "b":
        return "?"
    # The library's hashes have no sign, LCM's numbers all have one.
    return f"{'u' if field.name.endswith('_hash') else field.letter}{field.width}"


def _shaped(name: str, kind: str, count: int) -> Tuple[Any, ...]:
    return (name, kind, (count,)) if count else (name, kind)


class Layout:
    """The messages of one kind as an array.

    wire
        dtype of the bytes as they are sent (fixed part)
    dtype
        dtype of the arrays that users see: the same fields in this machine's byte order
    """

    def __init__(self, kind: str) -> None:
        known = fields(kind)
        self.kind = kind
        self.fingerprint = fingerprint(kind)
        self.whole = len(known) == len(KINDS[kind].__slots__)
        self.wire = np.dtype(
            {
                "names": [field.name for field in known],
                "formats": [
                    (
                        "u1" if field.letter == "b" else f">{field.letter}{field.width}",
                        (field.length,) if field.length else (),
                    )
                    for field in known
                ],
                "offsets": [field.offset for field in known],
                "itemsize": known[-1].offset + known[-1].width * max(known[-1].length, 1),
            }
        )
        self.dtype = np.dtype([_shaped(field.name, _native_type(field), field.length) for field in known], align=True)

    def decode(self, payloads: Sequence[bytes]) -> Array:
        """The fixed parts of n messages as an array, shape (n,); each must be as long as that or longer."""
        size = self.wire.itemsize
        cut = payloads if self.whole else [payload[:size] for payload in payloads]
        raw = np.frombuffer(b"".join(cut), self.wire)
        made = np.empty(len(raw), self.dtype)
        for name in self.wire.names or ():
            made[name] = raw[name]
        return made


_LAYOUTS: Dict[str, Layout] = {}


def layout(kind: str) -> Layout:
    """The layout of a kind; measured when it is first asked for."""
    if kind not in _LAYOUTS:
        _LAYOUTS[kind] = Layout(kind)
    return _LAYOUTS[kind]
