# SPDX-License-Identifier: MIT
"""Live channels: a log that is played, and multicast in a network of the test's own."""

import os
import pathlib
import shutil
import subprocess
import sys
import time

import numpy as np
import pytest
from logs import CHANNELS, walk, world_message, write

from tahr import messages
from tahr.telemetry import Listener, read_log


def listen_to(path, until=None, **options):
    """A Listener that has heard all of a log."""
    listener = Listener(f"file://{path}?speed=0", **options)
    while not listener.ended and (until is None or not until(listener)):
        time.sleep(0.01)
    return listener


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    return write(tmp_path_factory.mktemp("live") / "walk.lcmlog", walk())


def test_what_is_heard_is_what_is_in_the_log(played):
    log = read_log(played)
    with listen_to(played) as listener:
        for kind in ("state", "event", "report"):
            assert np.array_equal(listener.messages(kind), log.messages(kind)), kind
        assert listener.received["state"] == len(log.states) and listener.lost["state"] == 0
        assert listener.characters.tolist() == [0, 1, 2] and listener.foreign == 0
        assert listener.world["level"] == "flat"
        for number in range(3):
            assert np.array_equal(listener.latest(number)["position"], log.of(number).states["position"][-1])
        assert listener.latest(3) is None
        assert listener.latest()["character"].tolist() == [0, 1, 2]
    assert listener.ended and len(listener.states()) == len(log.states)
    listener.close()


def test_only_the_last_messages_are_kept(played):
    log = read_log(played)
    with listen_to(played, capacity=10) as listener:
        assert np.array_equal(listener.states(), log.states[-10:])
        assert listener.received["state"] == len(log.states)


def test_gaps_and_foreign_messages_are_counted(tmp_path):
    told = [(c, m) for c, m in walk() if not (c == CHANNELS["state"] and m.character == 2 and 20 <= m.step < 25)]
    told += [(CHANNELS["state"], b"\0" * 275), (CHANNELS["event"], messages.state_t()), ("POSE", b"1")]
    told += [(CHANNELS["state"], messages.state_t().encode()[:-1])]
    with listen_to(write(tmp_path / "gaps.lcmlog", told)) as listener:
        assert listener.lost["state"] == 5 and listener.lost["event"] == 0
        assert listener.foreign == 3
        assert len(listener.states()) == 265


def test_channels_may_be_chosen(tmp_path):
    told = [("arena/" + c, m) for c, m in walk(characters=1, steps=10)] + [(CHANNELS["world"], world_message(run=9))]
    path = write(tmp_path / "arena.lcmlog", told)
    with listen_to(path, channels="arena/TAHR_STATE") as listener:
        assert listener.received["state"] == 10 and listener.received["report"] == 0 and listener.world is None
    with listen_to(path) as listener:
        assert listener.received["state"] == 0 and listener.world["run"] == 9


def test_wrong_arguments_are_refused(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match="'bogus://x' is no URL of LCM: expected one of udpm://"):
        Listener("bogus://x")
    monkeypatch.setenv("LCM_DEFAULT_URL", "nonsense")
    with pytest.raises(ValueError, match="'nonsense' is no URL of LCM"):
        Listener()
    with pytest.raises(ConnectionError, match="there is no file /no/such/log"):
        Listener("file:///no/such/log")
    with pytest.raises(ValueError, match="capacity is 0"):
        Listener("memq://", capacity=0)
    with Listener("memq://") as listener:
        with pytest.raises(ValueError, match="no kind of messages is called 'stat'"):
            listener.messages("stat")
        assert len(listener.states()) == 0 and listener.latest().shape == (0,) and listener.world is None


def test_a_fork_is_told_that_it_has_no_thread(played):
    with listen_to(played) as listener:
        child = os.fork()
        if child == 0:
            code = 1
            try:
                listener.states()
            except RuntimeError as error:
                code = 0 if "open another one here" in str(error) else 2
            listener.close()
            os._exit(code)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
        assert len(listener.states()) == 270


NETWORK = "ip link set lo up; ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo; "


def in_a_network_of_its_own(script, route=True):
    """Runs a Python script where no message leaves; skips where that is not permitted."""
    if shutil.which("unshare") is None or shutil.which("ip") is None:
        pytest.skip("unshare or ip is missing (Debian: util-linux, iproute2)")
    alone = ["unshare", "-n", "-p", "-f", "--kill-child", *([] if os.geteuid() == 0 else ["-r"])]
    if subprocess.run([*alone, "true"], capture_output=True).returncode != 0:
        pytest.skip("network namespaces are not permitted here")
    here = pathlib.Path(__file__).parent
    command = (NETWORK if route else "") + f"exec '{sys.executable}' -B '{here / script}'"
    done = subprocess.run([*alone, "sh", "-ec", command], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return done


def test_multicast_from_the_library_to_python_and_back():
    lines = in_a_network_of_its_own("multicast.py").stdout.splitlines()
    assert lines == ["python to python", "library to python" if publishes() else "library: not built in"]


def publishes():
    from tahr._tahr import lib

    return hasattr(lib, "glue_publisher_open")


def test_without_a_route_it_is_said_what_to_do():
    done = in_a_network_of_its_own("no_route.py", route=False)
    assert done.stdout.splitlines()[-1] == "said"
    assert done.stderr == ""
