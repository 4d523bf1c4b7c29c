"""Tests of scripts/new_kernel.py on a scratch copy: files, lists, lints, and that the kernel compiles."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import check_layers  # noqa: E402
import check_style  # noqa: E402
import new_kernel  # noqa: E402

FILES = ["kernels/frob_columns.h", "kernels/frob_columns.cc", "tests/kernels/frob_columns_test.cc",
         "bench/frob_columns_bench.cc"]


class NewKernel(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = scratch.name
        shutil.copytree(os.path.join(ROOT, "kernels"), os.path.join(self.root, "kernels"))
        shutil.copytree(os.path.join(ROOT, "tests", "support"), os.path.join(self.root, "tests", "support"))
        shutil.copy(os.path.join(ROOT, ".clang-format"), self.root)

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, "-B", os.path.join(ROOT, "scripts", "new_kernel.py"), *arguments],
                              capture_output=True, text=True)

    def write(self, path, text):
        with open(os.path.join(self.root, path), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            return file.read()

    def test_writes_four_files_that_pass_the_lints_but_for_what_the_author_must_tell(self):
        run = self.run_script("frob_columns", self.root)
        self.assertEqual(run.returncode, 0, run.stderr)
        for path in FILES:
            self.assertIn("FrobColumns", self.read(path))
            self.assertIn(f"wrote {path}", run.stdout)
        ours = [line for line in check_layers.check(self.root) + check_style.check(self.root)
                if "frob_columns" in line]
        self.assertEqual([line.split(":")[0] for line in ours], sorted(FILES[:2]))
        for line in ours:
            self.assertIn("opens with one sentence", line)

    def test_files_are_formatted(self):
        self.run_script("frob_columns", self.root)
        run = subprocess.run(["clang-format", "--style=file", "--dry-run", "--Werror", *FILES], cwd=self.root,
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_kernel_compiles_at_both_widths(self):
        self.run_script("frob_columns", self.root)
        compiler = os.environ.get("CXX", "c++")
        # Only the lowest target: whether it compiles does not depend on the others.
        for width in ([], ["-DSWELL_ONE_LANE"]):
            run = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror",
                                  "-DHWY_BROKEN_EMU128=1", "-DHWY_COMPILE_ONLY_STATIC", *width,
                                  f"-I{self.root}", "kernels/frob_columns.cc"],
                                 cwd=self.root, capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, run.stderr)

    def test_test_and_benchmark_compile(self):
        self.run_script("frob_columns", self.root)
        for path in FILES[2:]:
            run = subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra",
                                  "-Werror", f"-I{self.root}", path], cwd=self.root, capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, run.stderr)

    def test_adds_lines_in_sorted_place(self):
        os.makedirs(os.path.join(self.root, "bench"))
        films = "swell_add_test(swell_film_tests\n  SOURCES\n    kernels/zap_film_test.cc\n  LIBS x)\n"
        tests = "swell_add_test(swell_kernel_tests\n  LABELS kernel\n  SOURCES\n{}    kernels/zip_rays_test.cc\n  LIBS y)\n"
        self.write("kernels/CMakeLists.txt", "set(SWELL_KERNEL_SOURCES\n  ${MORE}\n  blend_rays.cc\n  sort_hits.cc\n)\n")
        self.write("tests/CMakeLists.txt", films + tests.format(""))
        self.write("bench/CMakeLists.txt", "add_executable(swell_bench\n  blend_rays_bench.cc)\n")
        self.run_script("frob_columns", self.root)
        self.assertEqual(self.read("kernels/CMakeLists.txt"),
                         "set(SWELL_KERNEL_SOURCES\n  ${MORE}\n  blend_rays.cc\n  frob_columns.cc\n  sort_hits.cc\n)\n")
        self.assertEqual(self.read("tests/CMakeLists.txt"), films + tests.format("    kernels/frob_columns_test.cc\n"))
        self.assertEqual(self.read("bench/CMakeLists.txt"),
                         "add_executable(swell_bench\n  blend_rays_bench.cc\n  frob_columns_bench.cc)\n")

    def test_adds_to_the_lists_of_this_tree(self):
        for path, _, list_path, command in new_kernel.PARTS:
            if list_path is None or list_path.startswith("bench/"):
                continue
            with open(os.path.join(ROOT, list_path), encoding="utf-8") as file:
                text = file.read()
            entry = path.format(stem="frob_columns").removeprefix(os.path.dirname(list_path) + "/")
            self.assertEqual(len(new_kernel.add_to_list(text, entry, command).split("\n")), len(text.split("\n")) + 1)

    def test_says_what_to_do_where_there_is_no_list(self):
        self.write("kernels/CMakeLists.txt", "add_library(x)\n")
        run = self.run_script("frob_columns", self.root)
        self.assertIn("add it by hand: kernels/CMakeLists.txt", run.stdout)
        self.assertEqual(self.read("kernels/CMakeLists.txt"), "add_library(x)\n")

    def test_begins_an_empty_list(self):
        self.assertEqual(new_kernel.add_to_list("set(SWELL_KERNEL_SOURCES)\n", "a_b.cc", "set(SWELL_KERNEL_SOURCES"),
                         "set(SWELL_KERNEL_SOURCES\n  a_b.cc\n)\n")

    def test_overwrites_nothing(self):
        self.run_script("frob_columns", self.root)
        self.write(FILES[0], "mine")
        run = self.run_script("frob_columns", self.root)
        self.assertEqual(run.returncode, 1)
        self.assertIn("exists", run.stderr)
        self.assertEqual(self.read(FILES[0]), "mine")

    def test_refuses_bad_names(self):
        for name in ["Scale", "scale", "sort_and_shade", "../x_y", ""]:
            run = self.run_script(name, self.root)
            self.assertEqual(run.returncode, 1, name)
            self.assertTrue(run.stderr.startswith("new_kernel: "), run.stderr)

    def test_usage(self):
        self.assertEqual(self.run_script().returncode, 2)
        self.assertEqual(self.run_script("--help").returncode, 2)


if __name__ == "__main__":
    unittest.main()
