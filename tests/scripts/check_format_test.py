"""Tests of scripts/check_format on small trees."""
import os
import shutil
import subprocess
import unittest

from tree import ROOT, TreeTest

GOOD = "// Says it.\nint F() { return 1; }\n"
BAD = "// Says it.\nint  F( ){return 1;}\n"


class CheckFormat(TreeTest):
    def setUp(self):
        super().setUp()
        shutil.copy(os.path.join(ROOT, ".clang-format"), self.root)

    def run_script(self, *arguments, **environment):
        return subprocess.run([os.path.join(ROOT, "scripts", "check_format"), *arguments, self.root],
                              capture_output=True, text=True, env={**os.environ, **environment})

    def test_passes_what_is_formatted(self):
        self.write("src/base/a.h", GOOD)
        self.assertEqual(self.run_script().returncode, 0)

    def test_names_each_file_that_is_not(self):
        self.write("src/base/a.h", GOOD)
        self.write("kernels/b.cc", BAD)
        self.write("tests/c_test.cc", BAD)
        run = self.run_script()
        self.assertEqual(run.returncode, 1)
        self.assertEqual([line.split(":")[0] for line in run.stdout.splitlines()], ["kernels/b.cc", "tests/c_test.cc"])

    def test_fix_formats(self):
        self.write("src/base/a.h", BAD)
        self.assertEqual(self.run_script("--fix").returncode, 0)
        with open(os.path.join(self.root, "src/base/a.h"), encoding="utf-8") as file:
            self.assertEqual(file.read(), GOOD)

    def test_no_source_is_a_failure(self):
        self.assertEqual(self.run_script().returncode, 1)

    def test_another_version_is_refused(self):
        self.write("src/base/a.h", GOOD)
        for name in ("clang-format", "clang-format-14"):
            self.write(f"bin/{name}", "#!/bin/sh\necho 'clang-format version 15.0.1'\n")
            os.chmod(os.path.join(self.root, "bin", name), 0o755)
        run = self.run_script(PATH=f"{self.root}/bin:{os.environ['PATH']}")
        self.assertEqual(run.returncode, 1)
        self.assertIn("clang-format 14 is needed", run.stderr)


if __name__ == "__main__":
    unittest.main()
