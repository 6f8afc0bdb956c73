# SPDX-License-Identifier: MIT
"""Characters that walk up and down some steps tell of it over LCM, here into a file, which becomes a picture.

python examples/published_walk.py [--log walk.lcmlog] [--picture walk.png] [--seconds 6]
"""

import argparse

import numpy as np

import tahr
from tahr.plot import overview
from tahr.telemetry import Publisher, read_log

RATE = 60


def steps() -> tahr.World:
    """A floor of 30 m, and a pyramid of steps of 25 cm on it."""
    vertices = np.array([[-15, -15, 0], [15, -15, 0], [15, 15, 0], [-15, 15, 0]], dtype=float)
    pyramid = [tahr.Body.box((5 - i, 5 - i, 0.125), position=(0, 0, 0.125 + 0.25 * i)) for i in range(4)]
    return tahr.World.from_mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]), bodies=pyramid)


def publish(path: str, seconds: float) -> None:
    """Six characters walk to the middle and on, each from its own side, and jump now and then."""
    world, config = steps(), tahr.Config(max_speed=4)
    mover = tahr.Mover(world, config)
    angles = np.arange(6) * np.pi / 3
    states = [tahr.State(config, position=(10 * np.cos(a), 10 * np.sin(a), 1)) for a in angles]
    with Publisher(world, config, characters=6, url=f"file://{path}", level="steps") as publisher:
        for tick in range(int(seconds * RATE)):
            for number, (state, angle) in enumerate(zip(states, angles)):
                wish = tahr.Input(move=(-np.cos(angle), -np.sin(angle), 0), jump=(tick + 20 * number) % 150 == 149)
                publisher.step(mover, state, wish, 1 / RATE, character=number)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--log", default="walk.lcmlog")
    parser.add_argument("--picture", default="walk.png")
    parser.add_argument("--seconds", type=float, default=6)
    options = parser.parse_args()
    publish(options.log, options.seconds)
    log = read_log(options.log)
    overview(log).savefig(options.picture, dpi=110)
    stepped = np.count_nonzero(log.events["type"] == tahr.EVENT_STEPPED_UP)
    print(f"{len(log.states)} states, {stepped} steps up, {sum(log.lost.values())} messages lost: {options.picture}")


if __name__ == "__main__":
    main()
