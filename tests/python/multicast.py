# SPDX-License-Identifier: MIT
"""Run by test_telemetry_live.py in a network of its own: what is published over multicast is heard, all of it."""

import time

import lcm
import numpy as np
from logs import walk
from scenes import DT, ground

import tahr
from tahr._tahr import lib
from tahr.telemetry import Listener, Publisher

URL = "udpm://239.255.76.67:7667?ttl=0"


def wait(listener, kind, count):
    """Bounded: for messages on one machine this is ages."""
    for _ in range(1000):
        if listener.received[kind] >= count:
            return
        time.sleep(0.01)
    raise SystemExit(f"{listener.received[kind]} of {count} {kind} messages came, {listener.lost} lost")


def from_python():
    told = walk(characters=2, steps=60)
    connection, sent = lcm.LCM(URL), []
    with Listener(URL) as listener:
        for channel, message in told:
            connection.publish(channel, message.encode())
            if channel.endswith("STATE"):
                sent.append(message.position)
                if len(sent) % 20 == 0:
                    wait(listener, "state", len(sent))  # no more on the way than any buffer holds
        wait(listener, "report", 120)
        assert np.array_equal(listener.states()["position"], sent)
        assert sum(listener.lost.values()) == 0 and listener.foreign == 0
    print("python to python")


def from_the_library():
    world, config = ground(), tahr.Config()
    mover, state = tahr.Mover(world, config), tahr.State(config, position=(0, 0, 1))
    hashes, wish = [], tahr.Input(move=(1, 0, 0))
    with Listener(URL) as listener:
        with Publisher(world, config, url=URL, level="flat") as publisher:
            for step in range(300):
                publisher.step(mover, state, wish, DT)
                hashes.append(state.hash())
                if step % 20 == 19:
                    wait(listener, "report", step + 1)
        sent = {kind: counts["delivered"] for kind, counts in publisher.counts.items()}
        for kind in ("report", "state", "input", "event", "snapshot"):
            wait(listener, kind, sent[kind])
        assert listener.reports()["state_hash"].tolist() == hashes
        assert listener.messages("snapshot")["state"]["position"].tolist() == [[0, 0, 1]]
        assert sum(listener.lost.values()) == 0 and listener.world["level"] == "flat"
        assert np.array_equal(listener.latest(0)["position"], state.position)
    print("library to python")


from_python()
if hasattr(lib, "glue_publisher_open"):
    from_the_library()
else:
    print("library: not built in")
