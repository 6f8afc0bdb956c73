# SPDX-License-Identifier: MIT
"""Connecting to LCM, with an error that says why not."""

from __future__ import annotations

import os
import socket
from typing import TYPE_CHECKING, Optional
from urllib.parse import urlsplit

from ._events import import_lcm

if TYPE_CHECKING:
    import lcm

# Where LCM publishes when nobody says anything else.
_DEFAULT_URL = "udpm://239.255.76.67:7667"

# Of the socket, bytes, as far as the system allows it: its own default holds a few hundred messages, which is too few
# where a listener has to wait for its turn.
_BUFFER = 1 << 22

_SCHEMES = ("udpm", "mpudpm", "tcpq", "file", "memq")


def connect(url: Optional[str]) -> "lcm.LCM":
    """A connection to url; None: to the environment's LCM_DEFAULT_URL, or else to LCM's own default.

    Raises:
        ValueError: no URL that LCM knows
        ConnectionError: no route for multicast, no such file, or LCM has another reason, which it prints
        ImportError: PyPI's lcm is missing
    """
    library = import_lcm()
    url = url or os.environ.get("LCM_DEFAULT_URL") or _DEFAULT_URL
    parts = urlsplit(url)
    if parts.scheme not in _SCHEMES:
        raise ValueError(f"{url!r} is no URL of LCM: expected one of {', '.join(s + '://' for s in _SCHEMES)}")
    if parts.scheme == "udpm":
        _probe(url, parts.hostname or "239.255.76.67")
        if "recv_buf_size=" not in parts.query:
            url += f"{'&' if parts.query else '?'}recv_buf_size={_BUFFER}"
    path = parts.netloc + parts.path
    if parts.scheme == "file" and "mode=w" not in parts.query and not os.path.exists(path):
        raise ConnectionError(f"{url}: there is no file {path}")
    try:
        connection: "lcm.LCM" = library.LCM(url)
        return connection
    except RuntimeError as error:
        raise ConnectionError(f"{url}: LCM could not be set up: {error}") from error


def _probe(url: str, group: str) -> None:
    """LCM would only fail, after printing nine lines."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect((group, 9))  # sends nothing: asks for a route
        except OSError as error:
            raise ConnectionError(
                f"{url}: {group} cannot be reached ({error.strerror}); on a computer without a network: "
                "ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo"
            ) from error
