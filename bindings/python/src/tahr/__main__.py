# SPDX-License-Identifier: MIT
"""``python -m tahr``: pictures of logs and of live channels. What is logged and published is ``tahr run --lcm``'s, or
your own program's."""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from typing import TYPE_CHECKING, Any, Callable, List, Optional, Sequence

import numpy as np

from . import Error

if TYPE_CHECKING:
    from .telemetry import Listener, Log

#: What matplotlib is asked for.
_PICTURES = (".png", ".svg", ".pdf")

# Between two pictures of `watch`, s.
_PAUSE = 0.2


class _Wrong(Exception):
    """Wrong input: one line, and exit code 2."""


def _progress() -> Optional[Callable[[float], None]]:
    """Shows how far a log is read, where somebody sits there and it takes longer than a second."""
    if not sys.stderr.isatty():
        return None
    begin = time.monotonic()

    def show(part: float) -> None:
        if time.monotonic() - begin > 1:
            end = "\r" if part < 1 else "\r\x1b[K"
            print(f"reading: {part:4.0%}", end=end, file=sys.stderr, flush=True)

    return show


def _read(options: argparse.Namespace) -> "Log":
    from .telemetry import LogWarning, read_log

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", LogWarning)
        log = read_log(options.file, options.prefix, _progress())
    for warning in caught:
        print(f"tahr: {warning.message}", file=sys.stderr)
    return log


def _check_picture(path: str) -> None:
    if not path.lower().endswith(_PICTURES):
        raise _Wrong(f"-o {path}: expected a name that ends in {', '.join(_PICTURES)}")


def _plot(options: argparse.Namespace) -> int:
    from .plot import overview

    _check_picture(options.output)
    log = _read(options)
    if len(log.runs) > 1:
        print(f"tahr: {options.file} holds {len(log.runs)} runs; this is the last one", file=sys.stderr)
        log = log.runs[-1]
    if options.begin is not None or options.end is not None:
        log = log.between(
            -np.inf if options.begin is None else options.begin, np.inf if options.end is None else options.end
        )
    figure = overview(log, options.level, options.characters, options.up)
    figure.savefig(options.output, dpi=options.dpi)
    return 0


def _info(options: argparse.Namespace) -> int:
    log = _read(options)
    print(f"{log.path}: {log.size / 1e6:.3f} MB" + (f", channels {log.prefix}TAHR_*" if log.prefix else ""))
    for number, run in enumerate(log.runs):
        for line in _describe(run, number if len(log.runs) > 1 else None):
            print(line)
    print(f"{log.foreign} messages of another type or version on these channels, {log.others} on other channels")
    for problem in log.problems:
        print(f"problem at {problem}")
    return 0


def _describe(log: "Log", number: Optional[int]) -> List[str]:
    from .plot._style import EVENTS, MODES
    from .telemetry import KINDS, ranges

    lines = [f"run {number}:"] if number is not None else []
    if len(log.worlds):
        world = log.worlds[-1]
        lines.append(
            f"{world['level'] or 'unnamed level'} on {world['backend']}, tahr {world['version']}, "
            f"{world['characters']} characters, {world['dropped']} messages dropped and {world['failed']} failed there"
        )
    lines.append(f"{'':10} {'messages':>10} {'lost':>8} {'from s':>10} {'to s':>10}")
    for kind in KINDS:
        messages = log.messages(kind)
        timed = len(messages) > 0 and "time_ns" in (messages.dtype.names or ())
        span = [f"{at(messages['time_ns']) * 1e-9:10.3f}" for at in (np.min, np.max)] if timed else [f"{'-':>10}"] * 2
        lines.append(f"{kind:10} {len(messages):10} {log.lost.get(kind, '-'):>8} {' '.join(span)}")
    lines.append(f"characters: {ranges(log.characters)}")
    lines.append("modes: " + _shares(log.states["mode"], MODES))
    lines.append("events: " + _counts(log.events["type"], EVENTS))
    return lines


def _shares(numbers: Any, names: "dict[int, str]") -> str:
    found, counts = np.unique(numbers, return_counts=True)
    pairs = sorted(zip(counts, found), reverse=True)
    return ", ".join(f"{names.get(int(n), n)} {count / len(numbers):.1%}" for count, n in pairs) or "none"


def _counts(numbers: Any, names: "dict[int, str]") -> str:
    found, counts = np.unique(numbers, return_counts=True)
    pairs = sorted(zip(counts, found), reverse=True)
    return ", ".join(f"{names.get(int(n), n)} {count}" for count, n in pairs) or "none"


def _watch(options: argparse.Namespace) -> int:
    from .telemetry import Listener

    if (options.output is None) != (options.frames is None):
        raise _Wrong("--frames N and -o FILE go together")
    if options.output is not None:
        _check_picture(options.output)
    with Listener(options.lcm, options.channels) as listener:
        return _watch_file(listener, options) if options.output is not None else _watch_window(listener, options)


def _watch_file(listener: "Listener", options: argparse.Namespace) -> int:
    from .plot import Live

    live = Live(listener, options.level, options.up, options.window)
    for _ in range(options.frames):
        time.sleep(_PAUSE)
        live.update()
    live.figure.savefig(options.output, dpi=options.dpi)
    if sum(listener.received.values()) == 0:
        print("tahr: no message came", file=sys.stderr)
        return 1
    return 0


def _watch_window(listener: "Listener", options: argparse.Namespace) -> int:
    import matplotlib.pyplot as plt

    from .plot import Live
    from .plot._live import SIZE

    figure = plt.figure(figsize=SIZE)
    if figure.canvas.required_interactive_framework is None:
        raise _Wrong("there is no display to show a live plot on; --frames N -o FILE writes one into a file")
    live = Live(listener, options.level, options.up, options.window, figure)
    try:
        while plt.fignum_exists(figure.number):
            live.update()
            plt.pause(_PAUSE)
    except KeyboardInterrupt:
        pass
    return 0


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} is less than 1")
    return number


def _ids(text: str) -> List[int]:
    """0,3,5-8"""
    found: List[int] = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        try:
            found.extend(range(int(first), int(last or first) + 1))
        except ValueError:
            raise argparse.ArgumentTypeError(f"{part!r} is no id; expected such as 0,3,5-8") from None
    if not found:
        raise argparse.ArgumentTypeError(f"{text!r} names nobody; expected such as 0,3,5-8")
    return found


def _add_level(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--level", metavar="FILE", help="mesh of the level: OBJ, glTF, ...")
    parser.add_argument("--up", choices=("y", "z"), default="y", help="which axis of it points up (y)")
    parser.add_argument("--dpi", type=_positive, default=120, help="dots per inch of a .png (120)")


def _add_log(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE.lcmlog", help="what tahr record or lcm-logger wrote")
    parser.add_argument("--prefix", help="of the channels, where the log has those of several")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tahr", description="Pictures of logged and of live movement.")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    plot = commands.add_parser("plot", help="a log as a picture")
    _add_log(plot)
    plot.add_argument("-o", dest="output", metavar="FILE", required=True, help=", ".join(_PICTURES))
    plot.add_argument("--characters", metavar="IDS", type=_ids, help="only these: 0,3,5-8")
    plot.add_argument(
        "--from", dest="begin", metavar="S", type=float, help="only what happened after S simulated seconds"
    )
    plot.add_argument("--to", dest="end", metavar="S", type=float, help="and up to S")
    _add_level(plot)
    plot.set_defaults(run=_plot)

    watch = commands.add_parser("watch", help="live movement in a window")
    watch.add_argument("--lcm", metavar="URL", help="default: LCM_DEFAULT_URL, or else LCM's own")
    watch.add_argument("--channels", metavar="REGEX", default="TAHR_.*", help="which channels (TAHR_.*)")
    watch.add_argument("--window", metavar="S", type=float, default=10.0, help="seconds that are shown (10)")
    watch.add_argument("--frames", metavar="N", type=_positive, help="pictures until it ends; needs -o")
    watch.add_argument("-o", dest="output", metavar="FILE", help="the last picture goes here, no window opens")
    _add_level(watch)
    watch.set_defaults(run=_watch)

    info = commands.add_parser("info", help="what is in a log")
    _add_log(info)
    info.set_defaults(run=_info)
    return parser


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs a command; the exit code: 0 well, 1 nothing came, 2 wrong input."""
    options = _parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except (_Wrong, Error, OSError, ValueError, ImportError) as error:
        print(f"tahr: {' '.join(str(error).split())}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
