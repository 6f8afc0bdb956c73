# SPDX-License-Identifier: MIT
"""Run by test_telemetry_live.py where there is no network at all: both sides say so, and go on."""

from scenes import ground

import tahr
from tahr._tahr import lib
from tahr.telemetry import Listener, Publisher

URL = "udpm://239.255.76.67:7667?ttl=0"

try:
    Listener(URL)
    raise SystemExit("a Listener without a route")
except ConnectionError as error:
    assert "239.255.76.67 cannot be reached" in str(error) and "ip route add" in str(error), error
if hasattr(lib, "glue_publisher_open"):
    try:
        Publisher(ground(), tahr.Config(), url=URL)
        raise SystemExit("a Publisher without a route")
    except tahr.NotFoundError as error:
        assert "multicast" in str(error), error
print("said")
