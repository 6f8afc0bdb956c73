# SPDX-License-Identifier: MIT
"""The messages of a log, sorted by prefix and kind, and made into arrays in large pieces."""

from __future__ import annotations

import re
from typing import Dict, List, Optional, Tuple

import numpy as np

from ._decode import decode, dtype
from ._events import Block, Problem
from ._wire import FINGERPRINT, KINDS, Array, fingerprint

#: PREFIX, TAHR_KIND, and _ID where every character has channels of its own.
CHANNEL = re.compile(r"(?P<prefix>.*)TAHR_(?P<kind>STATE|EVENT|INPUT|REPORT|SNAPSHOT|BODY|WORLD)(_\d+)?", re.DOTALL)

# Messages that are kept as bytes before they become an array: many for NumPy, and small beside a log.
_PIECE = 1 << 16


class Pile:
    """The messages of one kind and one channel."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.payloads: List[bytes] = []
        self.bytes: List[int] = []  # where in the file each of them is
        self._arrays: List[Array] = [np.empty(0, dtype(kind))]
        self._places: List[Array] = [np.empty(0, np.int64)]

    def tidy(self, problems: List[Problem], least: int = 1) -> None:
        """Makes the bytes into an array if there are as many messages as `least`."""
        if len(self.payloads) < least:
            return
        messages, good, faults = decode(self.kind, self.payloads)
        problems.extend(Problem(self.bytes[i], text) for i, text in faults)
        self._arrays.append(messages)
        self._places.append(np.array(self.bytes, np.int64)[good])
        self.payloads.clear()
        self.bytes.clear()

    def arrays(self) -> Tuple[Array, Array]:
        """All of them, and where in the file they are."""
        return np.concatenate(self._arrays), np.concatenate(self._places)


class Gathering:
    """What was found in a log.

    foreign counts messages on channels of ours whose type or version is none of ours, others those on other channels.
    """

    def __init__(self) -> None:
        self.problems: List[Problem] = []
        self.foreign = 0
        self.others = 0
        self._kinds = {fingerprint(kind): kind for kind in KINDS}
        # By channel and first bytes; None: not ours.
        self._piles: Dict[Tuple[str, bytes], Optional[Pile]] = {}

    def add(self, block: Block) -> None:
        """Takes in some events of the log."""
        piles = self._piles
        for place, event in zip(block.bytes, block.events):
            data = event.data
            key = (event.channel, data[:FINGERPRINT])
            try:
                pile = piles[key]
            except KeyError:
                pile = piles[key] = self._begin(*key)
            if pile is None:
                self._count(event.channel)
            else:
                pile.payloads.append(data)
                pile.bytes.append(place)
        for pile in piles.values():
            if pile is not None:
                pile.tidy(self.problems, _PIECE)

    def _begin(self, channel: str, first: bytes) -> Optional[Pile]:
        match = CHANNEL.fullmatch(channel)
        kind = self._kinds.get(first)
        return Pile(kind) if kind and match and kind == match["kind"].lower() else None

    def _count(self, channel: str) -> None:
        if CHANNEL.fullmatch(channel):
            self.foreign += 1
        else:
            self.others += 1

    def prefixes(self) -> List[str]:
        """Those of the channels that hold messages of ours."""
        channels = [channel for (channel, _), pile in self._piles.items() if pile]
        return sorted({match["prefix"] for match in map(CHANNEL.fullmatch, channels) if match})

    def finish(self, prefix: str) -> Dict[str, Tuple[Array, Array]]:
        """Kind -> its messages and where in the file they are, of one prefix, in the order of the log."""
        found = {}
        for kind in KINDS:
            piles = [pile for key, pile in self._piles.items() if pile and pile.kind == kind and _has(key[0], prefix)]
            found[kind] = _merge(kind, piles, self.problems)
        return found


def _has(channel: str, prefix: str) -> bool:
    match = CHANNEL.fullmatch(channel)
    return match is not None and match["prefix"] == prefix


def _merge(kind: str, piles: List[Pile], problems: List[Problem]) -> Tuple[Array, Array]:
    for pile in piles:
        pile.tidy(problems)
    pairs = [pile.arrays() for pile in piles] or [Pile(kind).arrays()]
    if len(pairs) == 1:
        return pairs[0]
    messages, places = (np.concatenate(parts) for parts in zip(*pairs))
    order = np.argsort(places, kind="stable")
    return messages[order], places[order]
