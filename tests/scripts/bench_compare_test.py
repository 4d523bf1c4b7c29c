"""Tests of scripts/bench_compare.py: what its table says of given rates, and how it refuses bad input."""
import os
import subprocess
import sys
import unittest

from tree import ROOT

sys.path.insert(0, os.path.join(ROOT, "scripts"))
import bench_compare  # noqa: E402


def runs(*rates, name="Sort/wide"):
    return [{name: rate * 1e6} for rate in rates]


class Table(unittest.TestCase):
    def test_gives_medians_ranges_and_the_ratio_of_neighbouring_runs(self):
        lines, slower = bench_compare.table(runs(100, 80, 120), runs(110, 120, 120), "abc")
        self.assertIn("| Sort/wide | 100 (80-120) | 120 (110-120) | 1.100 (1.000-1.500) |", lines)
        self.assertEqual(slower, [])

    def test_calls_slower_what_is_slower_in_every_run(self):
        _, slower = bench_compare.table(runs(100, 90), runs(89, 80), "abc")
        self.assertEqual(slower, ["Sort/wide"])

    def test_calls_overlapping_runs_noise(self):
        _, slower = bench_compare.table(runs(100, 90), runs(91, 80), "abc")
        self.assertEqual(slower, [])

    def test_leaves_out_cases_that_one_side_lacks(self):
        lines, slower = bench_compare.table(runs(100), runs(50, name="New/wide"), "abc")
        self.assertEqual((len(lines), slower), (2, []))


class CommandLine(unittest.TestCase):
    def test_an_unknown_revision_is_one_line_and_exit_code_2(self):
        run = subprocess.run([sys.executable, "-B", os.path.join(ROOT, "scripts", "bench_compare.py"),
                              "--base", "no-such-revision"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("no-such-revision", run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
