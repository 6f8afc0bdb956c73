# SPDX-License-Identifier: MIT
"""Live channels: a thread that receives, and what it received as arrays."""

from __future__ import annotations

import collections
import os
import struct
import threading
from typing import TYPE_CHECKING, Any, Deque, Dict, List, Mapping, Optional, Tuple, Type
from types import TracebackType

import numpy as np
import numpy.typing as npt

from ._connect import connect
from ._decode import decode, dtype
from ._gather import CHANNEL
from ._log import PLURALS
from ._wire import FINGERPRINT, KINDS, Array, fingerprint, layout

if TYPE_CHECKING:
    import lcm

# How long the thread waits for a message before it looks whether it shall end.
_WAIT_MS = 50

# Messages that LCM keeps for us when the thread comes late: by itself it keeps 30.
_QUEUE = 1 << 16


# What is none of ours, on a channel of ours and on another one.
_FOREIGN, _OTHER = "foreign", "other"


def _numbers(kind: str) -> Optional[struct.Struct]:
    """Reads character and sequence out of a message; None where a kind has none."""
    places: Mapping[str, Any] = layout(kind).wire.fields or {}
    if "character" not in places:
        return None
    character, sequence = int(places["character"][1]), int(places["sequence"][1])
    return struct.Struct(f">{character}xi{sequence - character - 4}xq")


class _Ring:
    """The last messages of a kind, as bytes; and which are missing."""

    def __init__(self, kind: str, capacity: int) -> None:
        self.kind = kind
        self.received = 0
        self.lost = 0
        self.last: Dict[int, bytes] = {}  # by character; 0 where the kind has none
        self._payloads: Deque[bytes] = collections.deque(maxlen=capacity)
        self._numbers = _numbers(kind)
        self._sequences: Dict[int, int] = {}
        self._size = layout(kind).wire.itemsize
        self._whole = layout(kind).whole

    def fits(self, payload: bytes) -> bool:
        """Whether a message is as long as those of this kind are."""
        return len(payload) == self._size if self._whole else len(payload) > self._size

    def add(self, payload: bytes) -> None:
        """Takes one in; the oldest goes when the ring is full."""
        self._payloads.append(payload)
        self.received += 1
        if self._numbers is None:
            self.last[0] = payload
            return
        character, sequence = self._numbers.unpack_from(payload)
        before = self._sequences.get(character, sequence - 1)
        self.lost += max(sequence - before - 1, 0)
        self._sequences[character] = sequence
        self.last[character] = payload

    def payloads(self) -> List[bytes]:
        """Those that are there, the oldest first."""
        return list(self._payloads)


class Listener:
    """Receives what is published over LCM, on a thread of its own, and keeps the last messages of each kind.

        with tahr.telemetry.Listener() as listener:
            ...
            listener.latest(0)["position"]

    All methods may be called on any thread. After a fork the child has no such thread: its methods raise RuntimeError;
    open another Listener there.

    Args:
        url: of LCM: udpm://, file:// (a log, played as fast as it was recorded), ...; None: the environment's
            LCM_DEFAULT_URL, or else LCM's own default
        channels: regular expression, as LCM has them, of the channels
        capacity: messages of each kind that are kept

    Raises:
        ValueError: url is none of LCM's; capacity is less than 1
        ConnectionError: no route for multicast, no such file
        ImportError: PyPI's lcm is missing
    """

    def __init__(self, url: Optional[str] = None, channels: str = "TAHR_.*", capacity: int = 1 << 16) -> None:
        if capacity < 1:
            raise ValueError(f"Listener: capacity is {capacity}, expected at least 1")
        self._rings = {kind: _Ring(kind, capacity) for kind in KINDS}
        self._known: "Dict[Tuple[str, bytes], _Ring | str]" = {}  # by channel and first bytes
        self._foreign = 0
        self._lock = threading.Lock()
        self._ends = threading.Event()
        self._process = os.getpid()
        self._error: Optional[BaseException] = None
        self._lcm: "Optional[lcm.LCM]" = connect(url)
        self._plays_log = (url or os.environ.get("LCM_DEFAULT_URL", "")).startswith("file:")
        self._lcm.subscribe(channels, self._receive).set_queue_capacity(_QUEUE)
        self._thread = threading.Thread(target=self._run, name="tahr.telemetry.Listener", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            while not self._ends.is_set() and self._lcm is not None:
                self._lcm.handle_timeout(_WAIT_MS)
        except BaseException as error:  # raised again to whoever asks next
            # LCM says no more than that where a log that it plays has ended.
            self._error = None if self._plays_log and isinstance(error, OSError) else error

    @property
    def ended(self) -> bool:
        """Whether nothing more will come: it was closed, or the log that it plays is over."""
        return not self._thread.is_alive()

    def _receive(self, channel: str, data: bytes) -> None:
        key = (channel, data[:FINGERPRINT])
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._recognize(*key)
        with self._lock:
            if known is _FOREIGN or (isinstance(known, _Ring) and not known.fits(data)):
                self._foreign += 1
            elif isinstance(known, _Ring):
                known.add(data)

    def _recognize(self, channel: str, first: bytes) -> "_Ring | str":
        match = CHANNEL.fullmatch(channel)
        if match is None:
            return _OTHER
        ring = self._rings[match["kind"].lower()]
        return ring if fingerprint(ring.kind) == first else _FOREIGN

    def _check(self) -> None:
        if os.getpid() != self._process:
            raise RuntimeError("Listener: its thread has stayed in the process that forked; open another one here")
        if self._error is not None:
            raise RuntimeError(f"Listener: its thread has ended: {self._error}") from self._error

    def _ring(self, kind: str) -> _Ring:
        self._check()
        for singular, plural in PLURALS.items():
            if kind in (singular, plural):
                return self._rings[singular]
        raise ValueError(f"no kind of messages is called {kind!r}; there are {', '.join(KINDS)}")

    def messages(self, kind: str) -> Array:
        """The messages of a kind ("state", "event", ...) that are kept, the oldest first; fields as in a Log.

        Raises ValueError where there is no such kind.
        """
        ring = self._ring(kind)
        with self._lock:
            payloads = ring.payloads()
        return decode(ring.kind, payloads)[0]

    def states(self) -> Array:
        """Where characters were, shape (n,)."""
        return self.messages("state")

    def events(self) -> Array:
        """What happened to them, shape (n,)."""
        return self.messages("event")

    def inputs(self) -> Array:
        """What their steps were given, shape (n,)."""
        return self.messages("input")

    def reports(self) -> Array:
        """What their steps came to, shape (n,)."""
        return self.messages("report")

    def latest(self, character: Optional[int] = None) -> Any:
        """The last state of a character, or None as long as there is none; without an id those of all, shape (n,)."""
        ring = self._ring("state")
        with self._lock:
            last = dict(ring.last)
        if character is None:
            return decode("state", [last[number] for number in sorted(last)])[0]
        return decode("state", [last[character]])[0][0] if character in last else None

    @property
    def world(self) -> Any:
        """The last message of the world (level, backend, drops), or None."""
        ring = self._ring("world")
        with self._lock:
            last = list(ring.last.values())
        worlds = decode("world", last)[0]
        return worlds[0] if len(worlds) else None

    @property
    def received(self) -> Dict[str, int]:
        """Kind -> messages so far."""
        self._check()
        return {kind: ring.received for kind, ring in self._rings.items()}

    @property
    def lost(self) -> Dict[str, int]:
        """Kind -> messages so far that were sent, but did not come, by their sequence numbers."""
        self._check()
        return {kind: ring.lost for kind, ring in self._rings.items() if "character" in (dtype(kind).names or ())}

    @property
    def foreign(self) -> int:
        """Messages on channels of Tahr's so far that are of another type or version."""
        self._check()
        return self._foreign

    @property
    def characters(self) -> npt.NDArray[np.int32]:
        """Ids of the characters whose states came, ascending, shape (n,)."""
        self._check()
        with self._lock:
            return np.array(sorted(self._rings["state"].last), np.int32)

    def close(self) -> None:
        """Ends the thread and the connection; what was received stays. Again: nothing happens."""
        if os.getpid() == self._process:
            self._ends.set()
            self._thread.join()
        self._lcm = None

    def __enter__(self) -> "Listener":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()
