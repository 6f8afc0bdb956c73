# SPDX-License-Identifier: MIT
"""Messages of one kind as an array, whether all of them are of one size or not."""

from __future__ import annotations

import struct
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from . import _wire
from ._wire import KINDS, Array, layout

#: Index of a message that could not be decoded, and why.
Faults = List[Tuple[int, str]]


def _state_dtype() -> "np.dtype[Any]":
    from .. import STATE  # not at the top: the types of messages are of use without the library

    return STATE.newbyteorder("<")


def dtype(kind: str) -> "np.dtype[Any]":
    """The dtype of the arrays of a kind."""
    if kind == "snapshot":
        return np.dtype([*_members(layout(kind).dtype, "size"), ("state", _state_dtype())])
    if kind == "world":
        return np.dtype([_member(name, value) for name, value in _values(_wire.blank(kind)).items()])
    return layout(kind).dtype


def decode(kind: str, payloads: Sequence[bytes]) -> Tuple[Array, List[int], Faults]:
    """An array of those messages that are whole, shape (n,), their indices, and what is wrong with the others."""
    if kind == "world":
        return _decode_worlds(payloads)
    if kind == "snapshot":
        return _decode_snapshots(payloads)
    size = layout(kind).wire.itemsize
    good, faults = _sift([len(payload) for payload in payloads], size, kind)
    return layout(kind).decode([payloads[i] for i in good] if faults else payloads), good, faults


def _sift(lengths: Sequence[int], expected: int, kind: str) -> Tuple[List[int], Faults]:
    good = [i for i, length in enumerate(lengths) if length == expected]
    if len(good) == len(lengths):
        return good, []
    wrong = [(i, length) for i, length in enumerate(lengths) if length != expected]
    article = "an" if kind[0] in "aei" else "a"
    return good, [(i, f"{article} {kind} message of {length} bytes, expected {expected}") for i, length in wrong]


def _members(known: "np.dtype[Any]", without: str) -> List[Tuple[str, Any]]:
    return [(name, known[name]) for name in known.names or () if name != without]


def _decode_snapshots(payloads: Sequence[bytes]) -> Tuple[Array, List[int], Faults]:
    head, states = layout("snapshot"), _state_dtype()
    good, faults = _sift([len(payload) for payload in payloads], head.wire.itemsize + states.itemsize, "snapshot")
    whole = [payloads[i] for i in good]
    made = np.empty(len(whole), dtype("snapshot"))
    fields = head.decode(whole)
    for name in made.dtype.names or ():
        if name != "state":
            made[name] = fields[name]
    made["state"] = np.frombuffer(b"".join(payload[head.wire.itemsize :] for payload in whole), states)
    return made, good, faults


def _values(message: Any) -> Dict[str, Any]:
    """Field -> value, without the counts of bytes, which the arrays of bytes know themselves."""
    return {name: getattr(message, name) for name in message.__slots__ if name != "size"}


def _member(name: str, value: Any) -> Tuple[str, Any]:
    if isinstance(value, (str, bytes)):
        return name, np.object_
    return name, np.float64 if isinstance(value, float) else np.uint64 if name.endswith("_hash") else np.int64


def _decode_worlds(payloads: Sequence[bytes]) -> Tuple[Array, List[int], Faults]:
    rows, good, faults = [], [], []
    kinds = dtype("world")
    for i, payload in enumerate(payloads):
        try:
            values = _values(KINDS["world"].decode(payload))
        except (struct.error, ValueError, UnicodeDecodeError) as error:
            faults.append((i, f"a world message of {len(payload)} bytes that cannot be decoded: {error}"))
            continue
        rows.append(tuple(v % 2**64 if kinds[n] == np.uint64 else v for n, v in values.items()))
        good.append(i)
    return np.array(rows, kinds), good, faults
