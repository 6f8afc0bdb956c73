# SPDX-License-Identifier: MIT
"""Tests of rows.py: what is read, and what wrong input says."""

import math
import tempfile
import unittest
from pathlib import Path

from rows import COLUMNS, ChartError, budget_gains, read_machine, read_rows, thread_gains

GOOD = "sweeps,meshes,native,native,,,default,truth,126,0,,1e-9,2e-9,3e-9,,100,200,120,,1,4.5,2,,,,"


class Rows(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name) / "sweeps.csv"

    def tearDown(self):
        self.folder.cleanup()

    def write(self, *lines: str) -> None:
        self.path.write_text("\n".join((",".join(COLUMNS),) + lines) + "\n")

    def wrong(self) -> str:
        with self.assertRaises(ChartError) as caught:
            read_rows(self.path)
        return str(caught.exception)

    def test_a_row_is_read_field_by_field(self):
        self.write(GOOD)
        (row,) = read_rows(self.path)
        self.assertEqual((row.scene, row.setting, row.role), ("meshes", "native", "default"))
        self.assertEqual((row.samples, row.failed, row.error_p99_m, row.ns_p50), (126, 0, 2e-9, 100.0))
        self.assertTrue(math.isnan(row.value) and math.isnan(row.threads))
        self.assertEqual(row.tests_and_iterations, 6.5)

    def test_what_threads_gain_stands_beside_what_the_machine_gives(self):
        def crowd(curve: str, count: int, ns: float) -> str:
            return f"crowds,plane,{curve},{curve},{count},60,default,,100,0,,,,,,{ns},{ns},{ns},,,,,,,,2"

        self.write(
            crowd("crowd; 1 thread", 10, 900),
            crowd("crowd; 1 thread", 1000, 1000),
            crowd("crowd; 2 threads", 1000, 625),
            crowd("machine's ceiling; 2 threads", 1000, 500),
        )
        text = thread_gains(read_rows(self.path))
        self.assertIn("1000 characters: 2 threads are 1.60 times one, the machine's ceiling is 2.00", text)
        self.write(crowd("crowd; 1 thread", 1000, 1000), crowd("crowd; 2 threads", 1000, 625))
        self.assertEqual(thread_gains(read_rows(self.path)), "")

    def test_budgets_are_weighed_against_none(self):
        def budget(mm: int, ns: int) -> str:
            return f"sweeps,budgets,budget,budget,{mm},60,knob,,1,0,,0,0,0,,{ns},,,,,,,,,,"

        self.write(budget(0, 400), budget(5, 408), budget(200, 300))
        self.assertIn("102 % with 5 mm, 75 % with 200 mm.", budget_gains(read_rows(self.path)))
        self.write(budget(5, 408))
        self.assertEqual(budget_gains(read_rows(self.path)), "")

    def test_bytes_that_are_no_text_are_refused(self):
        self.path.write_bytes(bytes([255, 254, 10]))
        self.assertIn("sweeps.csv: is no CSV", self.wrong())

    def test_a_missing_file_is_named(self):
        self.assertIn("sweeps.csv: is not there", self.wrong())

    def test_other_columns_are_refused(self):
        self.path.write_text("family,scene\n")
        self.assertIn("sweeps.csv:1: expected the columns family,scene,curve", self.wrong())

    def test_an_empty_file_is_refused(self):
        self.path.write_text("")
        self.assertIn("sweeps.csv:1: expected the columns", self.wrong())

    def test_a_short_row_names_its_line(self):
        self.write(GOOD, "sweeps,meshes")
        self.assertIn(f"sweeps.csv:3: 2 fields, expected {len(COLUMNS)}", self.wrong())

    def test_a_word_for_a_number_names_line_and_field(self):
        self.write(GOOD.replace("1e-9", "fast"))
        self.assertIn("sweeps.csv:2: error_p50_m is 'fast', expected a number or nothing", self.wrong())

    def test_a_part_of_a_count_names_line_and_field(self):
        self.write(GOOD.replace("126", "12.6"))
        self.assertIn("sweeps.csv:2: samples is '12.6', expected a whole number", self.wrong())

    def test_the_machine_is_pairs(self):
        self.path.write_text('key,value\nflags,"-O3, and more"\n')
        self.assertEqual(read_machine(self.path), [("flags", "-O3, and more")])
        self.path.write_text("key,value\nflags\n")
        with self.assertRaises(ChartError) as caught:
            read_machine(self.path)
        self.assertIn("sweeps.csv:2: 1 fields, expected 2", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
