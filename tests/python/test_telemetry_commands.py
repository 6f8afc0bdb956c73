# SPDX-License-Identifier: MIT
"""python -m tahr: info, plot, watch; what it says to wrong input."""

import os
import subprocess
import sys

import pytest
from logs import CHANNELS, walk, world_message, write

pytest.importorskip("matplotlib")

from tahr.__main__ import main  # noqa: E402


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    return write(tmp_path_factory.mktemp("commands") / "walk.lcmlog", walk())


@pytest.fixture(scope="module")
def level(tmp_path_factory):
    path = tmp_path_factory.mktemp("level") / "floor.obj"
    path.write_text("v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nf 1 2 3\nf 1 3 4\n")
    return path


def run(capsys, *arguments):
    code = main([str(argument) for argument in arguments])
    said = capsys.readouterr()
    return code, said.out, said.err


def test_info_tells_what_is_in_a_log(capsys, log):
    code, out, err = run(capsys, "info", log)
    assert code == 0 and err == ""
    lines = {line.split()[0]: line.split() for line in out.splitlines() if line.split()}
    assert lines["state"][1:] == ["270", "0", "0.017", "1.500"]
    assert lines["input"][1:] == ["0", "0", "-", "-"]
    assert "flat on native, tahr 0.1.0, 3 characters" in out
    assert "characters: 0-2" in out and "jumped 3" in out and "falling" in out
    assert "0 messages of another type or version" in out


def test_info_tells_of_damage_and_runs(capsys, tmp_path):
    told = walk(characters=1, steps=20)
    path = write(tmp_path / "two.lcmlog", [*told, (CHANNELS["world"], world_message(run=7)), *told[1:], ("X", b"")])
    path.write_bytes(path.read_bytes()[:-3])
    code, out, err = run(capsys, "info", path)
    assert code == 0 and "run 0:" in out and "run 1:" in out
    at = path.stat().st_size - 26
    assert f"problem at byte {at}: the file ends inside of an event" in out
    assert f"byte {at}" in err


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_plot_writes_a_picture(capsys, log, level, tmp_path, kind):
    pytest.importorskip("trimesh")
    path = tmp_path / f"run.{kind}"
    options = ["--level", level, "--characters", "0,2", "--dpi", 50, "--from", 0.5, "--to", 1]
    assert run(capsys, "plot", log, *options, "-o", path) == (0, "", "")
    begin = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[kind]
    assert path.read_bytes().startswith(begin)


def test_plot_shows_the_last_of_several_runs_and_says_so(capsys, tmp_path, monkeypatch):
    import tahr.plot

    drawn, overview = [], tahr.plot.overview
    monkeypatch.setattr(tahr.plot, "overview", lambda log, *rest: drawn.append(log) or overview(log, *rest))
    told = walk(characters=1, steps=20)
    path = write(tmp_path / "two.lcmlog", [*told, (CHANNELS["world"], world_message(run=7)), *told[1:]])
    code, _, err = run(capsys, "plot", path, "-o", tmp_path / "two.png", "--dpi", 50)
    assert code == 0 and "holds 2 runs; this is the last one" in err
    assert drawn[0].worlds["run"].tolist() == [7] and len(drawn[0].states) == 20


def test_watch_draws_what_it_hears(capsys, log, level, tmp_path):
    pytest.importorskip("trimesh")
    path = tmp_path / "live.png"
    options = ["--frames", 3, "-o", path, "--level", level, "--dpi", 50]
    assert run(capsys, "watch", "--lcm", f"file://{log}?speed=0", *options) == (0, "", "")
    assert path.read_bytes().startswith(b"\x89PNG")


def test_watch_says_when_nothing_came(capsys, tmp_path):
    code, _, err = run(capsys, "watch", "--lcm", "memq://", "--frames", 1, "-o", tmp_path / "x.png", "--dpi", 50)
    assert code == 1 and err == "tahr: no message came\n"


def test_watch_needs_a_display_or_a_file(log):
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    command = [sys.executable, "-m", "tahr", "watch", "--lcm", f"file://{log}"]
    done = subprocess.run(command, env={**environment, "MPLBACKEND": "agg"}, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert (
        done.stderr == "tahr: there is no display to show a live plot on; --frames N -o FILE writes one into a file\n"
    )


def test_watch_draws_until_its_window_is_closed(capsys, log, monkeypatch):
    import matplotlib.pyplot as plt
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    plt.switch_backend("agg")
    monkeypatch.setattr(FigureCanvasAgg, "required_interactive_framework", "headless")
    drawn = []

    def pause(_):
        drawn.append(plt.gcf().texts[0].get_text())
        if len(drawn) == 3:
            plt.close("all")

    monkeypatch.setattr(plt, "pause", pause)
    assert run(capsys, "watch", "--lcm", f"file://{log}?speed=0") == (0, "", "")
    assert len(drawn) == 3 and drawn[-1] == "flat on native, live"


@pytest.mark.parametrize(
    "arguments, expected",
    [
        (["info", "no/such.lcmlog"], "No such file or directory: 'no/such.lcmlog'"),
        (["info", __file__], "is no LCM log"),
        (["plot", "LOG", "-o", "x.txt"], "-o x.txt: expected a name that ends in .png, .svg, .pdf"),
        (["plot", "LOG", "-o", "no/such/x.png"], "No such file or directory: 'no/such/x.png'"),
        (["plot", "LOG", "-o", "x.png", "--characters", "1,9"], "no message of character 9; there are 0-2"),
        (["plot", "LOG", "-o", "x.png", "--level", "no.obj"], "no such file: no.obj"),
        (["plot", "LOG", "-o", "x.png", "--prefix", "y/"], "no channels with the prefix 'y/'; there are ''"),
        (["plot", "LOG", "-o", "x.png", "--from", "2", "--to", "1"], "begin is 2.0 s and end 1.0 s"),
        (["watch", "--lcm", "bogus://", "--frames", "1", "-o", "x.png"], "'bogus://' is no URL of LCM"),
        (["watch", "--lcm", "memq://", "--frames", "1"], "--frames N and -o FILE go together"),
        (["watch", "--lcm", "memq://", "--frames", "1", "-o", "x.png", "--window", "0"], "window is 0.0 s"),
    ],
)
def test_wrong_input_is_one_line_and_code_2(capsys, log, tmp_path, monkeypatch, arguments, expected):
    monkeypatch.chdir(tmp_path)
    if "--level" in arguments:
        pytest.importorskip("trimesh")
    code, out, err = run(capsys, *[log if argument == "LOG" else argument for argument in arguments])
    assert code == 2 and out == ""
    assert expected in err and err.startswith("tahr: ") and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "arguments, expected",
    [
        ([], "COMMAND"),
        (["draw"], "invalid choice: 'draw'"),
        (["plot", "x.lcmlog"], "-o"),
        (["plot", "x", "-o", "y.png", "--characters", "1,b"], "'b' is no id; expected such as 0,3,5-8"),
        (["plot", "x", "-o", "y.png", "--characters", "5-3"], "'5-3' names nobody"),
        (["plot", "x", "-o", "y.png", "--dpi", "0"], "0 is less than 1"),
    ],
)
def test_wrong_usage_is_code_2(capsys, arguments, expected):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2 and expected in capsys.readouterr().err


def test_characters_are_given_as_ranges():
    from tahr.__main__ import _ids

    assert _ids("0,3,5-8") == [0, 3, 5, 6, 7, 8]
