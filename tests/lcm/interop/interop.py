# SPDX-License-Identifier: MIT
"""C to Python and Python to C, by PyPI's lcm and the generated types.

interop.py PROGRAM FOLDER, in a network of its own."""
import os
import subprocess
import sys

import lcm
from tahr import body_t, event_t, input_t, report_t, snapshot_t, state_t, world_t

URL = "udpm://239.255.76.67:7667?ttl=0"
TYPES = {
    "TAHR_STATE": state_t, "TAHR_EVENT": event_t, "TAHR_INPUT": input_t, "TAHR_REPORT": report_t,
    "TAHR_SNAPSHOT": snapshot_t, "TAHR_BODY": body_t, "TAHR_WORLD": world_t,
}
NONE = -1


def signed(text):
    number = int(text, 16)
    return number - (1 << 64) if number >> 63 else number


def check(heard, state_hash):
    """Every kind came, with what interop.c gave it."""
    assert sorted(heard) == sorted(TYPES), sorted(heard)
    s = heard["TAHR_STATE"]
    assert (s.character, s.step, s.sequence, s.time_ns, s.wall_ns) == (7, 1 << 40, 11, -13, 14)
    assert tuple(s.position) == (0.1, -2.0, 1e300) and s.mode == state_t.MODE_WALKING and s.base_body == NONE
    assert s.floor_blocking and s.floor_walkable and not s.floor_perching and s.floor_distance == 0.0125
    e = heard["TAHR_EVENT"]
    assert (e.type, e.value, e.step) == (event_t.LANDED, -4.5, 1 << 40)
    i = heard["TAHR_INPUT"]
    assert (i.dt, tuple(i.drive), i.epoch) == (0.25, (1.0, 2.0, 3.0), 12)
    r = heard["TAHR_REPORT"]
    assert tuple(r.saved) == tuple(range(1, 10)) and r.state_hash == signed("fedcba9876543210")
    n = heard["TAHR_SNAPSHOT"]
    assert n.size == len(n.state) == 512 and n.state_hash == state_hash
    b = heard["TAHR_BODY"]
    assert (b.kind, b.body, b.teleport, b.dt, b.epoch) == (body_t.MOVE, 3, True, 0.5, 2)
    w = heard["TAHR_WORLD"]
    assert (w.level, w.backend, w.config_count) == ("Bühne", "native", 1) and w.size == len(w.configs) > 0


def c_to_python(program):
    heard = {}
    carrier = lcm.LCM(URL)
    carrier.subscribe("TAHR_.*", lambda channel, data: heard.__setitem__(channel, TYPES[channel].decode(data)))
    carrier.fileno()
    said = subprocess.run([program, "say", URL], stdout=subprocess.PIPE, check=True, timeout=60)
    while len(heard) < len(TYPES) and carrier.handle_timeout(5000):
        pass
    check(heard, signed(said.stdout))


def python_to_c(program):
    carrier = lcm.LCM(URL)
    with subprocess.Popen([program, "hear", URL], stdout=subprocess.PIPE, text=True) as listener:
        assert listener.stdout.readline() == "ready\n"
        state = state_t()
        state.position, state.mode, state.base_body = [0.1, -2.0, 1e300], state_t.MODE_FLYING, NONE
        state.floor_walkable, state.character = True, 5
        for step in range(100):
            state.step = (1 << 40) + step
            carrier.publish("TAHR_STATE", state.encode())
        line = listener.stdout.readline().split()
        assert listener.wait(timeout=60) == 0
    assert line[:2] == ["5", str((1 << 40) + 99)], line
    assert [float(x) for x in line[2:5]] == [0.1, -2.0, 1e300] and line[5:] == ["4", "1", "-1"], line


def log_to_python(program, folder):
    path = os.path.join(folder, "said.lcmlog")
    said = subprocess.run([program, "say", "file://" + path], stdout=subprocess.PIPE, check=True, timeout=60)
    events = list(lcm.EventLog(path, "r"))
    assert [event.eventnum for event in events] == list(range(len(TYPES)))
    check({event.channel: TYPES[event.channel].decode(event.data) for event in events}, signed(said.stdout))


def main():
    program, folder = sys.argv[1:]
    c_to_python(program)
    python_to_c(program)
    log_to_python(program, folder)
    print("interop: C and Python understand each other, live and in logs")


main()
