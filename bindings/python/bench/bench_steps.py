# SPDX-License-Identifier: MIT
"""What Python adds to a step: the same world, characters and inputs in this process and in a C program, in turns.

    python bench_steps.py --prefix PREFIX     # where Tahr is installed (make install PREFIX=...), for the C program

Prints the medians of CPU time over blocks that take turns, in several launches, and their ratio. The states of both
must have the same hash after each block.
"""

import argparse
import pathlib
import statistics
import subprocess
import tempfile
import time
from typing import Any, Callable, List, Tuple

import numpy as np

import tahr

DT = 1 / 60


def hills(cells: int, size: float) -> Tuple[Any, Any]:
    """A square of gentle hills around the origin: vertices (n, 3), triangles (m, 3)."""
    side = np.linspace(-size / 2, size / 2, cells + 1)
    x, y = np.meshgrid(side, side)
    z = 1.5 * np.sin(x / 9) * np.cos(y / 7)
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    right, above = corner + 1, corner + cells + 1
    lower = np.stack([corner, right, above + 1], axis=-1)
    upper = np.stack([corner, above + 1, above], axis=-1)
    return vertices, np.concatenate([lower, upper]).astype(np.uint32)


class Scene:
    """The Python side, and the files of the C side."""

    def __init__(self, count: int, threads: int, folder: pathlib.Path) -> None:
        vertices, triangles = hills(160, 320.0)
        self.world = tahr.World.from_mesh(vertices, triangles)
        self.mover = tahr.Mover(self.world)
        self.crowd = tahr.Crowd(self.world, capacity=count, threads=threads)
        side = int(np.ceil(np.sqrt(count)))
        places = np.stack(np.divmod(np.arange(count), side), axis=-1) * 2.0 - side
        random = np.random.default_rng(1)
        heading = random.uniform(0, 2 * np.pi, count)
        self.inputs = tahr.inputs(count)
        self.inputs["move"][:, 0] = np.cos(heading)
        self.inputs["move"][:, 1] = np.sin(heading)
        self.states = tahr.states(None, np.column_stack([places, np.full(count, 3.0)]))
        for _ in range(60):  # onto the ground
            self.crowd.step(self.inputs, DT, self.states)
        self.begin = self.states.copy()
        vertices.tofile(folder / "vertices.bin")
        triangles.tofile(folder / "triangles.bin")
        self.states.tofile(folder / "states.bin")
        self.inputs.tofile(folder / "inputs.bin")

    def crowd_steps(self, steps: int) -> None:
        for _ in range(steps):
            self.crowd.step(self.inputs, DT, self.states)

    def mover_steps(self, steps: int) -> None:
        middle = len(self.states) // 2
        state = tahr.State.of(self.states, middle)
        one = tahr.Input.from_bytes(self.inputs[middle].tobytes())
        step = self.mover.step
        for _ in range(steps):
            step(state, one, DT)

    def hash(self) -> int:
        return int(np.bitwise_xor.reduce(tahr.hashes(self.states)))


Times = Tuple[List[float], List[float]]


def measure(scene: Scene, other: Any, what: str, blocks: int, steps: int, times: Times) -> None:
    """Adds ns of CPU time per step, of Python and of C, in turns. Each block begins with the same states."""
    run: Callable[[int], None] = scene.crowd_steps if what == "crowd" else scene.mover_steps
    mine, theirs = times

    def ours() -> None:
        scene.states[:] = scene.begin
        begin = time.process_time_ns()
        run(steps)
        mine.append((time.process_time_ns() - begin) / steps)

    def c_side() -> int:
        other.stdin.write(f"{what} {steps}\n")
        other.stdin.flush()
        ns, hashed = other.stdout.readline().split()
        theirs.append(int(ns) / steps)
        return int(hashed)

    for block in range(blocks):
        if block % 2:
            ours()
        hashed = c_side()
        if not block % 2:
            ours()
        if hashed != scene.hash():
            raise SystemExit(f"{what}: the states of Python and of C differ")


def launch(program: pathlib.Path, options: argparse.Namespace, threads: int, crowd: Times, mover: Times) -> None:
    """Both sides with memory of their own: where that lies makes up to a tenth of a step's time."""
    with tempfile.TemporaryDirectory() as made:
        scene = Scene(options.characters, threads, pathlib.Path(made))
        command = [str(program), made, str(options.characters), str(threads)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
            measure(scene, other, "crowd", 6, 5, crowd)
            measure(scene, other, "mover", 20, 400, mover)
            assert other.stdin is not None
            other.stdin.close()


def build(options: argparse.Namespace, folder: pathlib.Path) -> pathlib.Path:
    libraries = [str(next(options.prefix.glob(f"lib*/**/{name}"))) for name in ("libtahr_threads.a", "libtahr.a")]
    program = folder / "bench_steps"
    source = str(pathlib.Path(__file__).with_suffix(".c"))
    flags = ["-std=c11", "-O2", "-D_POSIX_C_SOURCE=200809L", f"-I{options.prefix}/include"]
    command = [options.cc, *flags, source, *libraries, "-lm", "-pthread", "-ldl", "-o", str(program)]
    subprocess.run(command, check=True)
    return program


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", type=pathlib.Path, required=True, help="where Tahr is installed")
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--characters", type=int, default=10_000)
    parser.add_argument("--launches", type=int, default=10)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as made:
        program = build(options, pathlib.Path(made))
        for threads in (1, 2):
            crowd: Times = ([], [])
            mover: Times = ([], [])
            for _ in range(options.launches):
                launch(program, options, threads, crowd, mover)
            python, c = map(statistics.median, crowd)
            print(
                f"crowd of {options.characters}, {threads} threads: C {c / 1e6:.2f} ms of CPU time a step, "
                f"Python {python / 1e6:.2f} ms: {100 * (python / c - 1):+.2f} %"
            )
            python, c = map(statistics.median, mover)
            print(f"one mover, walking: C {c:.0f} ns a step, Python {python:.0f} ns: {python - c:+.0f} ns")


if __name__ == "__main__":
    main()
