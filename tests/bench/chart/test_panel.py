# SPDX-License-Identifier: MIT
"""Tests of panel.py and labels.py: curves are cut where they fail, labels keep clear of points and of each other."""

import importlib.util
import math
import unittest
from dataclasses import replace
from typing import Any

from rows import COLUMNS, COUNTS, TEXTS, Row

if importlib.util.find_spec("matplotlib"):
    import labels
    import panel
    import style


def row(**changes) -> Row:
    empty: dict[str, Any] = {name: "" if name in TEXTS else 100 if name in COUNTS else math.nan for name in COLUMNS}
    return replace(Row(**empty), failed=0, **changes)


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not there")
class Panel(unittest.TestCase):
    def test_a_curve_is_cut_where_it_fails(self):
        good, bad = row(value=1.0), replace(row(value=1.0), failed=1)
        spots = [(1.0, 1.0, good), (2.0, 2.0, good), (3.0, 3.0, bad), (4.0, 4.0, good), (5.0, 5.0, good)]
        self.assertEqual(panel._pieces(spots), [[(1.0, 1.0), (2.0, 2.0)], [(4.0, 4.0), (5.0, 5.0)]])

    def test_settings_without_a_number_are_no_curve(self):
        self.assertEqual(panel._pieces([(1.0, 1.0, row()), (2.0, 2.0, row())]), [])

    def test_labels_keep_clear_of_points_and_of_each_other(self):
        figure, (axes,) = style.panels(1)
        points = [(0.50, 0.5), (0.52, 0.5), (0.54, 0.5), (0.5, 0.52)]
        names = [labels.Label(x, y, f"number {i}", "black", needed=True) for i, (x, y) in enumerate(points)]
        axes.plot([p[0] for p in points], [p[1] for p in points])
        axes.set_xlim(0, 1)
        axes.set_ylim(0, 1)
        self.assertEqual(labels.place(axes, names, points), 0)
        figure.draw_without_rendering()
        boxes = [text.get_window_extent() for text in axes.texts]
        self.assertEqual(len(boxes), 4)
        for i, box in enumerate(boxes):
            for other in boxes[i + 1 :]:
                self.assertFalse(box.overlaps(other))
            for point in points:
                self.assertFalse(box.contains(*axes.transData.transform(point)))

    def test_what_has_no_room_and_is_not_needed_is_left_out(self):
        _, (axes,) = style.panels(1)
        points = [(0.5, 0.5)] * 80
        names = [labels.Label(0.5, 0.5, "a long name that fills the panel", "black") for _ in points]
        left_out = labels.place(axes, names, points)
        self.assertGreater(left_out, 0)
        self.assertEqual(len(axes.texts), 80 - left_out)


if __name__ == "__main__":
    unittest.main()
