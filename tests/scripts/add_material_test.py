"""Adds the material of CONTRIBUTING.md to a scratch copy: it builds, is listed, renders and is tested.

Usage: add_material_test.py [--quick]; --quick only compiles the file.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
SKIPPED = shutil.ignore_patterns("build", "build-*", ".git", "__pycache__")
QUICK = "--quick" in sys.argv

SCENE = """
Film "rgb" "integer xresolution" [ 24 ] "integer yresolution" [ 24 ]
Camera "perspective" "float fov" [ 40 ]
WorldBegin
LightSource "distant" "point3 from" [ 0 0 -1 ] "point3 to" [ 0 0 0 ] "rgb L" [ 1 1 1 ]
Material "lunardust" "rgb albedo" [ 0.8 0.8 0.8 ]
AttributeBegin
Translate 0 0 4
Shape "sphere"
AttributeEnd
"""


class AddMaterial(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = os.path.join(scratch.name, "swell")
        shutil.copytree(ROOT, self.root, ignore=SKIPPED)
        with open(os.path.join(ROOT, "CONTRIBUTING.md"), encoding="utf-8") as file:
            section = file.read().split("\n## Add a material\n")[1].split("\n## ")[0]
        self.path = re.search(r"`(kernels/materials/\w+\.cc)`", section).group(1)
        code = re.findall(r"```cpp\n(.*?)```", section, re.DOTALL)
        self.assertEqual(len(code), 1)
        with open(os.path.join(self.root, self.path), "w", encoding="utf-8") as file:
            file.write(code[0])

    def run_in_scratch(self, *command):
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{' '.join(command)}:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
        return done.stdout

    def test_the_example_is_formatted_and_passes_the_lints(self):
        self.run_in_scratch("clang-format", "--dry-run", "--Werror", self.path)
        self.run_in_scratch(sys.executable, "-B", "scripts/check_style.py", self.root)
        self.run_in_scratch(sys.executable, "-B", "scripts/check_layers.py", self.root)

    @unittest.skipIf(QUICK, "only the lints were asked for")
    def test_the_example_is_listed_renders_and_passes_the_tests_of_all_materials(self):
        # One instruction set compiles in a fraction of the time of all.
        self.run_in_scratch("cmake", "-G", "Ninja", "-B", "build", "-DSWELL_NATIVE=ON", "-DSWELL_BENCH=OFF")
        self.run_in_scratch("ninja", "-C", "build", "swell", "swell_material_tests")
        self.assertIn("\nlunardust\n", self.run_in_scratch("build/bin/swell", "list", "materials"))

        with open(os.path.join(self.root, "moon.pbrt"), "w", encoding="utf-8") as file:
            file.write(SCENE)
        self.run_in_scratch("build/bin/swell", "render", "moon.pbrt", "--spp", "16", "--outfile", "moon.exr",
                            "--quiet")
        self.assertGreater(os.path.getsize(os.path.join(self.root, "moon.exr")), 1000)
        self.run_in_scratch("build/bin/swell_material_tests")


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--quick"])
