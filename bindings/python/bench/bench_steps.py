# SPDX-License-Identifier: MIT
"""What Python adds to a step: the same world, characters and inputs in this process and in a C program, in turns.

    python bench_steps.py --prefix PREFIX     # where Tahr is installed (make install PREFIX=...), for the C program

The crowd's also in a loop of C in this process, over the same memory. Prints the medians of CPU time over blocks that
take turns, in several launches, and their ratio. The states of both must have the same hash after each block.
"""

import argparse
import ctypes
import pathlib
import statistics
import subprocess
import tempfile
import time
from typing import Any, Callable, List, Tuple

import numpy as np

import tahr
from tahr._tahr import ffi, lib

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


class Loop:
    """Steps the crowd of a scene in a loop of C, in this process."""

    def __init__(self, library: pathlib.Path, scene: Scene) -> None:
        self.loop = ctypes.CDLL(str(library)).bench_loop
        self.loop.restype = ctypes.c_int64
        self.loop.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int32]
        states = ffi.from_buffer("tahr_state[]", scene.states)
        inputs = ffi.from_buffer("tahr_input[]", scene.inputs)
        tick = ffi.new("tahr_crowd_tick *", {"struct_size": ffi.sizeof("tahr_crowd_tick"), "dt": DT})
        tick.count, tick.states, tick.inputs = len(scene.states), states, inputs
        pointers = (ffi.addressof(lib, "glue_crowd_step"), scene.crowd._c, tick)
        self.kept = (states, inputs, *pointers)
        self.arguments = [int(ffi.cast("uintptr_t", pointer)) for pointer in pointers]

    def step(self, steps: int) -> int:
        return int(self.loop(*self.arguments, steps))


def measure_in_one(scene: Scene, loop: Loop, blocks: int, steps: int, times: Times) -> None:
    """As measure, of the crowd alone and in one process."""
    mine, theirs = times

    def ours() -> int:
        begin = time.process_time_ns()
        scene.crowd_steps(steps)
        return time.process_time_ns() - begin

    for block in range(blocks):
        hashes = set()
        for python in (bool(block % 2), not block % 2):
            scene.states[:] = scene.begin
            (mine if python else theirs).append((ours() if python else loop.step(steps)) / steps)
            hashes.add(scene.hash())
        if len(hashes) != 1:
            raise SystemExit("the states of Python and of the loop of C differ")


class Results:
    """Of one number of threads."""

    def __init__(self) -> None:
        self.in_one: Times = ([], [])
        self.crowd: Times = ([], [])
        self.mover: Times = ([], [])


def launch(folder: pathlib.Path, options: argparse.Namespace, threads: int, results: Results) -> None:
    """Both sides with memory of their own: where that lies makes up to a tenth of a step's time."""
    with tempfile.TemporaryDirectory() as made:
        scene = Scene(options.characters, threads, pathlib.Path(made))
        measure_in_one(scene, Loop(folder / "bench_loop.so", scene), 6, 5, results.in_one)
        command = [str(folder / "bench_steps"), made, str(options.characters), str(threads)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
            measure(scene, other, "crowd", 6, 5, results.crowd)
            measure(scene, other, "mover", 20, 400, results.mover)
            assert other.stdin is not None
            other.stdin.close()


def build(options: argparse.Namespace, folder: pathlib.Path) -> None:
    here = pathlib.Path(__file__).parent
    libraries = [str(next(options.prefix.glob(f"lib*/**/{name}"))) for name in ("libtahr_threads.a", "libtahr.a")]
    flags = [options.cc, "-std=c11", "-O2", "-D_POSIX_C_SOURCE=200809L", f"-I{options.prefix}/include"]
    libraries += ["-lm", "-pthread", "-ldl"]
    subprocess.run([*flags, str(here / "bench_steps.c"), *libraries, "-o", str(folder / "bench_steps")], check=True)
    loop = [str(here / "bench_loop.c"), "-shared", "-fPIC", "-o", str(folder / "bench_loop.so")]
    subprocess.run([*flags, *loop], check=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", type=pathlib.Path, required=True, help="where Tahr is installed")
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--characters", type=int, default=10_000)
    parser.add_argument("--launches", type=int, default=10)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        build(options, folder)
        for threads in (1, 2):
            results = Results()
            for _ in range(options.launches):
                launch(folder, options, threads, results)
            for what, times in (("one process", results.in_one), ("two processes", results.crowd)):
                python, c = map(statistics.median, times)
                print(
                    f"crowd of {options.characters}, {threads} threads, {what}: C {c / 1e6:.2f} ms of CPU time a step, "
                    f"Python {python / 1e6:.2f} ms: {100 * (python / c - 1):+.2f} %"
                )
            python, c = map(statistics.median, results.mover)
            print(f"one mover, walking: C {c:.0f} ns a step, Python {python:.0f} ns: {python - c:+.0f} ns")


if __name__ == "__main__":
    main()
