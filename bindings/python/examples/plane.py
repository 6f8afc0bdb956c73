# SPDX-License-Identifier: MIT
"""A collision engine in ten lines: all that the movement asks is "how far can this shape go?"; here Python answers.

The whole world is a plane with a wall across it; the character walks up to the wall and slides along it.
"""

from typing import Dict, Optional

import numpy as np

import tahr

UP, WEST = np.array([0.0, 0.0, 1.0]), np.array([-1.0, 0.0, 0.0])
WALL = 3.0  # m: nothing gets beyond this x


def sweep(query: tahr.Sweep) -> Optional[tahr.Hit]:
    """The first of the two planes that the shape comes within query.margin of."""
    first: Optional[tahr.Hit] = None
    for normal, behind, half in ((UP, 0.0, query.shape.half_height), (WEST, -WALL, query.shape.radius)):
        gap = float(query.position @ normal) - behind - half  # m, between the shape and the plane
        closing = -float(query.motion @ normal)  # m of it that the motion uses up
        if gap < 0:
            return tahr.Hit(start_overlap=1, depth=-gap, normal=normal)
        fraction = max(gap - query.margin, 0) / closing if closing > 0 else 2.0
        if fraction <= 1 and (first is None or fraction < first.fraction):
            first = tahr.Hit(blocking=1, fraction=fraction, normal=normal)
    return first


def main() -> None:
    mover = tahr.Mover(tahr.World.from_callbacks(sweep))
    state = tahr.State(mover.config, position=(0, 0, 1))
    report = tahr.Report(events=8)
    seen: Dict[str, float] = {}  # s: when each kind of event came first
    for tick in range(90):
        mover.step(state, tahr.Input(move=(0.8, 0.6, 0)), 1 / 60, report)
        for event in report.events:
            seen.setdefault(tahr.event_name(event["type"]), tick / 60 + event["time"])
    print(f"landed at {seen['landed']:.3f} s, met the wall at {seen['hit']:.3f} s")
    gap = WALL - mover.config.shape.radius - state.position[0]
    print(f"{state.mode_name} along the wall, {1000 * gap:.1f} mm from it, {state.velocity[1]:.2f} m/s")


if __name__ == "__main__":
    main()
