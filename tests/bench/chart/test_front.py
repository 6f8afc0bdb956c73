# SPDX-License-Identifier: MIT
"""Tests of front.py, against areas and fronts found by hand."""

import math
import unittest
from dataclasses import replace
from typing import Any

import front
from rows import COLUMNS, COUNTS, TEXTS, Row


def row(**changes) -> Row:
    empty: dict[str, Any] = {name: "" if name in TEXTS else 1 if name in COUNTS else math.nan for name in COLUMNS}
    return replace(Row(**empty), failed=0, **changes)


class Front(unittest.TestCase):
    def test_front_keeps_what_nothing_beats(self):
        points = [(1e-3, 100.0), (1e-6, 1000.0), (1e-4, 100.0), (1e-2, 10.0), (1e-6, 2000.0)]
        self.assertEqual(front.front(points), [(1e-6, 1000.0), (1e-4, 100.0), (1e-2, 10.0)])

    def test_front_of_nothing_is_empty(self):
        self.assertEqual(front.front([]), [])

    def test_hypervolume_of_one_point_is_its_rectangle(self):
        # 6 decades to 1 m, 3 decades to 100 us
        self.assertAlmostEqual(front.hypervolume([(1e-6, 100.0)]), 18.0)

    def test_hypervolume_of_a_stair_is_the_union(self):
        # (1e-6, 1 us) covers 6 x 2; (1e-3, 10 ns) adds 3 x 2 below it
        self.assertAlmostEqual(front.hypervolume([(1e-3, 10.0), (1e-6, 1000.0)]), 18.0)

    def test_hypervolume_ignores_what_is_beyond_the_reference(self):
        self.assertEqual(front.hypervolume([(2.0, 10.0), (1e-3, 2e5)]), 0.0)

    def test_error_of_zero_counts_as_a_picometre(self):
        self.assertEqual(front.point_of(row(error_p99_m=0.0, ns_p50=5.0)), (1e-12, 5.0))

    def test_work_is_that_of_a_sixtieth_of_a_second(self):
        self.assertAlmostEqual(row(ns_p50=300.0, rate_hz=240.0).work, 1200.0)
        self.assertAlmostEqual(row(ns_p50=300.0).work, 300.0)

    def test_failing_settings_are_on_no_front(self):
        self.assertFalse(front.counts(replace(row(error_p99_m=1e-9, ns_p50=1.0), failed=1)))

    def test_settings_that_change_what_is_right_are_on_no_front(self):
        self.assertFalse(front.counts(row(error_p99_m=1e-9, ns_p50=1.0, role="definition")))
        self.assertTrue(front.counts(row(error_p99_m=1e-9, ns_p50=1.0, role="knob")))

    def test_a_tie_within_the_clock_is_not_beaten(self):
        self.assertFalse(front.beaten((1e-6, 103.0), [(1e-6, 100.0)]))
        self.assertTrue(front.beaten((1e-6, 106.0), [(1e-6, 100.0)]))
        self.assertFalse(front.beaten((1.4e-6, 100.0), [(1e-6, 100.0)]))
        self.assertTrue(front.beaten((1.6e-6, 100.0), [(1e-6, 104.0)]))

    def test_settings_compete_within_their_backend_and_rate(self):
        rows = [
            row(scene="a", setting="native", curve="native", role="knob", error_p99_m=1e-3, ns_p50=10.0),
            row(scene="a", setting="ccd", curve="ccd advance", role="knob", error_p99_m=1e-3, ns_p50=99.0),
            row(scene="a", setting="often", curve="precise", role="knob", error_p99_m=1e-3, ns_p50=99.0, rate_hz=120.0),
            row(scene="a", setting="ccd slow", curve="ccd GJK", role="knob", error_p99_m=1e-3, ns_p50=199.0),
        ]
        self.assertEqual([r.setting for r in front.never_on_front(rows)], ["ccd slow"])

    def test_never_on_front_names_only_settings_beaten_on_every_scene(self):
        rows = [
            row(scene="a", setting="fast", role="knob", error_p99_m=1e-3, ns_p50=10.0),
            row(scene="a", setting="slow", role="knob", error_p99_m=1e-3, ns_p50=20.0),
            row(scene="a", setting="off", role="off", error_p99_m=1e-3, ns_p50=30.0),
            row(scene="b", setting="fast", role="knob", error_p99_m=1e-3, ns_p50=10.0),
            row(scene="b", setting="other", role="knob", error_p99_m=1e-2, ns_p50=20.0),
            row(scene="b", setting="slow", role="knob", error_p99_m=1e-3, ns_p50=20.0),
        ]
        self.assertEqual([r.setting for r in front.never_on_front(rows)], ["slow", "other"])
        rescued = rows + [row(scene="c", setting="slow", role="knob", error_p99_m=1e-9, ns_p50=20.0)]
        self.assertEqual([r.setting for r in front.never_on_front(rescued)], ["other"])

    def test_a_setting_goes_only_if_all_of_its_values_are_beaten(self):
        rows = [
            row(scene="a", setting="best", curve="default", role="default", error_p99_m=1e-3, ns_p50=10.0),
            row(scene="a", setting="bad 1", curve="bad", role="knob", error_p99_m=1e-3, ns_p50=20.0),
            row(scene="a", setting="bad 2", curve="bad", role="knob", error_p99_m=1e-2, ns_p50=20.0),
            row(scene="a", setting="good 1", curve="good", role="knob", error_p99_m=1e-3, ns_p50=20.0),
            row(scene="a", setting="good 2", curve="good", role="knob", error_p99_m=1e-9, ns_p50=20.0),
            row(scene="a", setting="slow", curve="threads", role="knob", ns_p50=900.0),
            row(scene="a", setting="without", curve="switch", role="off", error_p99_m=1e-3, ns_p50=90.0),
            row(scene="a", setting="only one", curve="engine", role="only", error_p99_m=1e-3, ns_p50=90.0),
        ]
        self.assertEqual(front.knobs_never_on_front(rows), ["bad"])
        self.assertEqual([r.setting for r in front.never_on_front(rows)], ["bad 1", "bad 2", "good 1"])


if __name__ == "__main__":
    unittest.main()
