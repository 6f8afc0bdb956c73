# SPDX-License-Identifier: MIT
"""Tests of peers.py: what is read, what wrong input says, what is said of Tahr. They need matplotlib."""

import importlib.util
import tempfile
import unittest
from pathlib import Path

from rows import ChartError

if importlib.util.find_spec("matplotlib"):
    import peers

HEAD = (
    "course,method,version,left_out,steps,ns_median,ns_p99,ns_cpu_mean,queries,tunnelled,embedded,invalid,left,stuck,"
    "deepest,clearance,progress,flips,settings\n"
)
TAHR = 'plane,tahr,0.1,,100,200,400,210,2,0,0,0,0,0,0,0.01,0.9,0.2,"the default, as it is"\n'
PEER = "plane,other,2,,100,300,350,310,3,1,0,0,0,0,0.001,-0.001,0.91,0.2,its own\n"
LEFT_OUT = 'plane,third,,"no compiler, no library",,,,,,,,,,,,,,,\n'


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not there")
class Peers(unittest.TestCase):
    def read(self, text: str):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "peers.csv"
            path.write_text(text)
            return peers.read_peers(path)

    def test_rows_and_reasons_are_read(self):
        tahr, other, third = self.read(HEAD + TAHR + PEER + LEFT_OUT)
        self.assertTrue(tahr.own)
        self.assertFalse(other.own)
        self.assertEqual(tahr.settings, "the default, as it is")
        self.assertEqual(other.failures, 1)
        self.assertEqual(third.left_out, "no compiler, no library")

    def test_what_tahr_does_worse_is_said_and_nothing_else(self):
        # p99 of 350 against 400 ns is more than 5 % better; 0.91 of the way against 0.9 is not
        said = peers.worse(self.read(HEAD + TAHR + PEER + LEFT_OUT))
        self.assertEqual(said, ["plane: 99th percentile of the time of a step: other 350 ns, Tahr 400 ns"])

    def test_a_missing_column_is_named(self):
        with self.assertRaises(ChartError) as caught:
            self.read(HEAD.replace("deepest,", "") + TAHR)
        self.assertIn("peers.csv:1: the columns deepest are missing", str(caught.exception))

    def test_a_word_for_a_number_names_line_and_column(self):
        with self.assertRaises(ChartError) as caught:
            self.read(HEAD + TAHR + PEER.replace("300", "fast"))
        self.assertIn("peers.csv:3: ns_median is 'fast', expected a number or nothing", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
