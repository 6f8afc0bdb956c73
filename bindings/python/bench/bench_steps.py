# SPDX-License-Identifier: MIT
"""What Python adds to a step: the same world, characters and inputs in this process and in a C program, in turns.

    python bench_steps.py --prefix PREFIX     # where Tahr is installed (make install PREFIX=...), for the C program

Prints the medians of blocks that take turns, and their ratio. The states of both must have the same hash after each.
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


def measure(scene: Scene, other: Any, what: str, blocks: int, steps: int) -> Tuple[float, float]:
    """Medians of ns per step, of Python and of C. Each block begins with the same states."""
    run: Callable[[int], None] = scene.crowd_steps if what == "crowd" else scene.mover_steps
    mine: List[float] = []
    theirs: List[float] = []

    def ours() -> None:
        scene.states[:] = scene.begin
        begin = time.perf_counter_ns()
        run(steps)
        mine.append((time.perf_counter_ns() - begin) / steps)

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
    return statistics.median(mine), statistics.median(theirs)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--prefix", type=pathlib.Path, required=True, help="where Tahr is installed")
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--characters", type=int, default=10_000)
    parser.add_argument("--blocks", type=int, default=40)
    options = parser.parse_args()
    here = pathlib.Path(__file__).parent
    libraries = [str(next(options.prefix.glob(f"lib*/**/{name}"))) for name in ("libtahr_threads.a", "libtahr.a")]
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        program = folder / "bench_steps"
        compile_it = [options.cc, "-std=c11", "-O2", "-D_POSIX_C_SOURCE=200809L", f"-I{options.prefix}/include"]
        source = str(here / "bench_steps.c")
        subprocess.run([*compile_it, source, *libraries, "-lm", "-pthread", "-ldl", "-o", str(program)], check=True)
        for threads in (1, 2):
            scene = Scene(options.characters, threads, folder)
            command = [str(program), str(folder), str(options.characters), str(threads)]
            pipe = subprocess.PIPE
            with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True) as other:
                python, c = measure(scene, other, "crowd", options.blocks, 20)
                print(
                    f"crowd of {options.characters}, {threads} threads: C {c / 1e3:.1f} us a step, "
                    f"Python {python / 1e3:.1f} us: {100 * (python / c - 1):+.2f} %"
                )
                python, c = measure(scene, other, "mover", 10 * options.blocks, 400)
                print(f"one mover, walking: C {c:.0f} ns a step, Python {python:.0f} ns: {python - c:+.0f} ns")
                assert other.stdin is not None
                other.stdin.close()


if __name__ == "__main__":
    main()
