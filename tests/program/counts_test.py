"""Models of the shared data have as many triangles as assimp counts in them (assimp_counts.tsv).

Usage: counts_test.py SWELL DATA
"""
import json
import os
import subprocess
import sys
import unittest

SWELL = DATA = ""
TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "assimp_counts.tsv")


def rows():
    """(file, count) of each line; the count is 'error' where there is nothing to render."""
    with open(TABLE, encoding="utf-8") as file:
        for line in file:
            if not line.startswith("#"):
                cells = line.rstrip("\n").split("\t")
                yield cells[0], cells[2] if len(cells) > 2 else cells[1]


class Counts(unittest.TestCase):
    def test_triangles_are_as_many_as_assimp_counts(self):
        for name, expected in rows():
            with self.subTest(name):
                path = os.path.join(DATA, name)
                run = subprocess.run([SWELL, "info", "--json", path], capture_output=True, text=True, timeout=120,
                                     check=False)
                if expected == "error":
                    self.assertEqual(run.returncode, 1)
                    self.assertRegex(run.stderr, r"\Aswell: error: .+: (has no faces|all its faces).*\n\Z")
                    continue
                self.assertEqual((run.returncode, run.stderr), (0, ""))
                triangles = json.loads(run.stdout)["triangles"]
                self.assertEqual(str(triangles["unique"] + triangles["left_out"]), expected)

    def test_every_model_is_in_the_table(self):
        there = {os.path.relpath(os.path.join(folder, name), DATA)
                 for folder, _, names in os.walk(DATA) for name in names if name.endswith((".obj", ".ply"))}
        self.assertEqual(there - {name for name, _ in rows()}, set())


if __name__ == "__main__":
    DATA = sys.argv.pop(2)
    SWELL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
