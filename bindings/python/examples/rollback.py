# SPDX-License-Identifier: MIT
"""Rollback, as networked games do it: a late input arrives, the game goes back and plays the ticks again.

A character is 512 bytes: a snapshot is a copy, and who plays the same inputs from it comes to the same hash.
"""

from typing import Dict, List

import numpy as np

import tahr

DT = 1 / 60
Inputs = List[tahr.Input]


class Game:
    """One character on a field with a step in it, and what it was at the begin of each tick."""

    def __init__(self) -> None:
        ground = tahr.Body.box((20, 20, 1), position=(0, 0, -1))
        stair = tahr.Body.box((2, 20, 0.15), position=(4, 0, 0.15))
        self.mover = tahr.Mover(tahr.World([ground, stair]))
        self.state = tahr.State(self.mover.config, position=(0, 0, 0.91))
        self.snapshots: Dict[int, tahr.State] = {}

    def play(self, inputs: Inputs, begin: int) -> None:
        """The ticks from begin on."""
        for tick in range(begin, len(inputs)):
            self.snapshots[tick] = self.state.copy()
            self.mover.step(self.state, inputs[tick], DT)

    def roll_back(self, inputs: Inputs, tick: int) -> None:
        """Plays everything from `tick` on again, with what is known now."""
        self.state.assign(self.snapshots[tick])
        self.play(inputs, tick)


def main() -> None:
    random = np.random.default_rng(7)
    turns = np.repeat(random.uniform(-1.5, 1.5, 8), 15)  # rad: another way every quarter of a second
    truth = [tahr.Input(move=(np.cos(turn), np.sin(turn), 0)) for turn in turns]
    server, client = Game(), Game()
    server.play(truth, 0)

    guessed = truth[:90] + [truth[89].copy() for _ in range(30)]  # the last 30 have not arrived yet
    client.play(guessed, 0)
    away = float(np.linalg.norm(client.state.position - server.state.position))
    print(f"guessed: {away:.3f} m from the server's")

    client.roll_back(truth, 90)  # now they have
    print(f"rolled back and played again: the same hash is {client.state.hash() == server.state.hash()}")


if __name__ == "__main__":
    main()
