"""Tests of scripts/count_tests.py with real results of ctest."""
import os
import subprocess
import sys
import unittest

from tree import ROOT, TreeTest

PROJECT = """\
cmake_minimum_required(VERSION 3.25)
project(scratch NONE)
enable_testing()
"""


class CountTests(TreeTest):
    def count(self, *tests):
        """What is printed, and the exit code, after ctest ran a project of these lines."""
        self.write("CMakeLists.txt", PROJECT + "\n".join(tests) + "\n")
        subprocess.run(["cmake", "-G", "Ninja", "-S", self.root, "-B", f"{self.root}/b"], check=True, capture_output=True)
        subprocess.run(["ctest", "--test-dir", f"{self.root}/b", "--output-junit", f"{self.root}/tests.xml"],
                       capture_output=True)
        return self.run_script(f"{self.root}/tests.xml")

    def run_script(self, path):
        run = subprocess.run([sys.executable, "-B", os.path.join(ROOT, "scripts", "count_tests.py"), path],
                             capture_output=True, text=True)
        return run.stdout, run.returncode

    def test_counts_what_passed(self):
        self.assertEqual(self.count("add_test(NAME a COMMAND true)", "add_test(NAME b COMMAND true)"),
                         ("2 passed, 0 failed\n", 0))

    def test_counts_what_failed(self):
        self.assertEqual(self.count("add_test(NAME a COMMAND true)", "add_test(NAME b COMMAND false)"),
                         ("1 passed, 1 failed\n", 1))

    def test_what_cannot_start_has_failed(self):
        self.assertEqual(self.count("add_test(NAME a COMMAND true)", "add_test(NAME b COMMAND /no/such/program)"),
                         ("1 passed, 1 failed\n", 1))

    def test_what_takes_too_long_has_failed(self):
        self.assertEqual(self.count("add_test(NAME a COMMAND sleep 20)", "set_tests_properties(a PROPERTIES TIMEOUT 1)"),
                         ("0 passed, 1 failed\n", 1))

    def test_what_is_disabled_has_failed(self):
        self.assertEqual(self.count("add_test(NAME a COMMAND true)", "add_test(NAME b COMMAND true)",
                                    "set_tests_properties(b PROPERTIES DISABLED TRUE)"),
                         ("1 passed, 1 failed\n", 1))

    def test_what_skips_itself_is_counted_apart(self):
        self.assertEqual(self.count("add_test(NAME a COMMAND true)", "add_test(NAME b COMMAND false)",
                                    "set_tests_properties(b PROPERTIES SKIP_RETURN_CODE 1)"),
                         ("1 passed, 0 failed, 1 skipped\n", 0))

    def test_no_test_is_a_failure(self):
        self.write("tests.xml", "<testsuite/>")
        self.assertEqual(self.run_script(f"{self.root}/tests.xml"), ("0 passed, 0 failed\n", 1))

    def test_no_file_is_a_failure(self):
        self.assertEqual(self.run_script(f"{self.root}/none.xml"), ("", 1))


if __name__ == "__main__":
    unittest.main()
