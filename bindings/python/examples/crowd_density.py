# SPDX-License-Identifier: MIT
"""Ten thousand characters go through three gates; where they are, is drawn as their density over the level.

    python crowd_density.py                                    # 10 000 for 60 s; leaves crowd_density.png
    python crowd_density.py --characters 500 --seconds 5 --output small.png

Needs matplotlib: pip install tahr[plot].
"""

import argparse
import time
from typing import Any, List, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import numpy.typing as npt  # noqa: E402
from matplotlib.patches import Rectangle  # noqa: E402

import tahr  # noqa: E402

Array = npt.NDArray[Any]

DT = 1 / 30
HALF = (130.0, 62.0)  # m, half the size of the level
GATES = ((-34.0, 3.0), (0.0, 10.0), (34.0, 5.0))  # m: middle and width of the gaps in the wall at x = 0
PILLARS = [(x, y) for x in (40.0, 60.0, 80.0) for y in (-30.0, -10.0, 10.0, 30.0)]
CELL = 1.0  # m, of the picture

Box = Tuple[float, float, float, float]  # middle x and y, half sizes


def walls() -> List[Box]:
    """Everything upright: the rim, the wall with its gates, pillars behind it."""
    rim: List[Box] = [(0, side * HALF[1], HALF[0], 1) for side in (-1, 1)]
    rim += [(side * HALF[0], 0, 1, HALF[1]) for side in (-1, 1)]
    edges = [-HALF[1], *(edge for middle, width in GATES for edge in (middle - width / 2, middle + width / 2)), HALF[1]]
    parts: List[Box] = [(0, (low + high) / 2, 1, (high - low) / 2) for low, high in zip(edges[::2], edges[1::2])]
    return [*rim, *parts, *((x, y, 1.5, 1.5) for x, y in PILLARS)]


def open_world() -> tahr.World:
    bodies = [tahr.Body.box((*HALF, 1), position=(0, 0, -1))]
    bodies += [tahr.Body.box((half_x, half_y, 2), position=(x, y, 2)) for x, y, half_x, half_y in walls()]
    return tahr.World(bodies, options={"cache_triangles": 32})


def places(count: int) -> Array:
    """Side by side in the west, 1 m apart."""
    rows = 110
    column, row = np.divmod(np.arange(count), rows)
    return np.column_stack([-12.0 - column, row - (rows - 1) / 2, np.full(count, 0.92)])


def wishes(states: Array, goals: Array, inputs: Array) -> None:
    """Through the gate that is nearest, wide ones first, then to his own goal in the east."""
    x, y = states["position"][:, 0], states["position"][:, 1]
    middles = np.array([middle for middle, _ in GATES])
    widths = np.array([width for _, width in GATES])
    gate = np.argmin(np.abs(y[:, None] - middles) - 1.5 * widths, axis=1)
    aim_y = np.clip(y, middles[gate] - widths[gate] / 2 + 0.6, middles[gate] + widths[gate] / 2 - 0.6)
    before = x < 1.5
    inputs["move"][:, 0] = np.where(before, np.maximum(2 - x, 1), HALF[0] - 8 - x)
    inputs["move"][:, 1] = np.where(before, aim_y - y, goals - y)
    length = np.linalg.norm(inputs["move"], axis=1, keepdims=True)
    inputs["move"] *= 0.5 / np.maximum(length, 0.5)  # at a walk: half of max_speed


def simulate(count: int, seconds: float, threads: int) -> Tuple[Array, float]:
    """Mean density, characters per m2, in cells of the level; and ms a tick."""
    crowd = tahr.Crowd(open_world(), capacity=count, threads=threads)
    states, inputs = tahr.states(None, places(count)), tahr.inputs(count)
    goals = np.random.default_rng(1).uniform(-0.9, 0.9, count) * HALF[1]  # m, y of each
    bins = [int(2 * half / CELL) for half in HALF]
    area = [(-half, half) for half in HALF]
    total, looks, spent = np.zeros(bins), 0, 0.0
    for tick in range(round(seconds / DT)):
        wishes(states, goals, inputs)
        begin = time.perf_counter()
        crowd.step(inputs, DT, states)
        spent += time.perf_counter() - begin
        if tick % 5 == 0:
            where = states["position"]
            total += np.histogram2d(where[:, 0], where[:, 1], bins=bins, range=area)[0]
            looks += 1
    return total / looks / CELL**2, 1000 * spent * DT / seconds


def draw(density: Array, count: int, seconds: float, output: str) -> None:
    figure, axes = plt.subplots(figsize=(11, 5.6), layout="constrained")
    shown = np.ma.masked_less_equal(density.T, 0)
    picture = axes.imshow(
        shown,
        origin="lower",
        extent=(-HALF[0], HALF[0], -HALF[1], HALF[1]),
        cmap="YlOrRd",
        vmin=0,
        vmax=max(float(np.percentile(shown.compressed(), 99.5)), 0.1),
        interpolation="nearest",
    )
    for x, y, half_x, half_y in walls():
        axes.add_patch(Rectangle((x - half_x, y - half_y), 2 * half_x, 2 * half_y, color="0.25"))
    for middle, width in GATES:
        axes.annotate(
            f"{width:g} m",
            (0, middle),
            (-3, middle),
            ha="right",
            va="center",
            fontsize=9,
            bbox={"boxstyle": "round,pad=0.2", "fc": "white", "ec": "0.6"},
        )
    figure.colorbar(picture, ax=axes, label="characters per m², mean over the run", shrink=0.8, extend="max")
    axes.set(xlabel="x (m)", ylabel="y (m)", title=f"{count} characters go east through three gates, {seconds:g} s")
    figure.supxlabel(
        "Dark: walls and pillars. Each cell is 1 m². "
        "Everybody starts west of the wall, 1 m apart, and walks at 3 m/s to a place in the east.",
        fontsize=9,
    )
    figure.savefig(output, dpi=120)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--characters", type=int, default=10_000)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--threads", type=int, default=0, help="0: as many as there are processors")
    parser.add_argument("--output", default="crowd_density.png")
    options = parser.parse_args()
    density, milliseconds = simulate(options.characters, options.seconds, options.threads)
    draw(density, options.characters, options.seconds, options.output)
    print(f"{options.characters} characters: {milliseconds:.1f} ms a step; densest {density.max():.1f} per m²")


if __name__ == "__main__":
    main()
