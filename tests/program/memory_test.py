"""What large scenes take of memory: a mesh of a million triangles as PLY and as OBJ, and a quarter of a
million instances. Peaks are of the process, less what it takes for one triangle: libraries, mostly.
"""
import json
import os
import subprocess
import sys

import program
from program import swell

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench"))
import make_grid_ply  # noqa: E402
import make_instances_pbrt  # noqa: E402

MOST = 1.3             # peak over the arrays of scene and tree
MOST_INSTANCED = 1.5e9  # bytes, for a million instances of 10^5 triangles
SIDE = 707             # of the grid: a million triangles


def write_grid_obj(n, path):
    with open(path, "w", encoding="utf-8") as file:
        for y in range(n + 1):
            file.writelines(f"v {x / n:.6f} {y / n:.6f} {x * y % 7 * 1e-4:.6f}\n" for x in range(n + 1))
        for y in range(n):
            first = y * (n + 1) + 1
            file.writelines(f"f {i} {i + 1} {i + n + 2} {i + n + 1}\n" for i in range(first, first + n))


class Memory(program.ProgramTest):
    def path(self, name):
        return os.path.join(self.folder, name)

    def info(self, path):
        run = swell("info", "--json", path)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def check_ratio(self, path, triangles):
        with open(self.path("one.obj"), "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        base = self.info(self.path("one.obj"))["peak_rss_bytes"]["build"]
        facts = self.info(path)
        self.assertEqual(facts["triangles"]["unique"], triangles)
        held = facts["memory_bytes_together"] - facts["memory_bytes"]["film"]
        self.assertLess((facts["peak_rss_bytes"]["build"] - base) / held, MOST)
        os.remove(path)

    def test_ply_is_held_once(self):
        make_grid_ply.write(SIDE, self.path("grid.ply"))
        self.check_ratio(self.path("grid.ply"), 2 * SIDE * SIDE)

    def test_obj_is_held_once(self):
        write_grid_obj(SIDE, self.path("grid.obj"))
        self.check_ratio(self.path("grid.obj"), 2 * SIDE * SIDE)

    def test_instances_share_their_triangles(self):
        make_instances_pbrt.write(500, self.folder)
        code = ("import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True); "
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024)")
        run = subprocess.run([sys.executable, "-c", code, program.SWELL, "render", self.path("scene.pbrt"), "--quiet",
                              "--outfile", self.path("i.png")], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertLess(int(run.stdout), MOST_INSTANCED / 4)


if __name__ == "__main__":
    program.main()
