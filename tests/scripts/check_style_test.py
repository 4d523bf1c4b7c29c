"""Tests of scripts/check_style.py on small trees, most of them bad."""
import unittest

from tree import TreeTest
import check_style

LINE = "int x;\n"


class CheckStyle(TreeTest):
    def expect(self, path, text, *parts):
        self.write(path, text)
        found = check_style.check(self.root)
        self.assertEqual(len(found), len(parts), found)
        for line, part in zip(found, parts):
            self.assertTrue(line.startswith(f"{path}:"), line)
            self.assertIn(part, line)

    def test_a_file_may_open_with_a_sentence_over_two_lines(self):
        self.expect("src/base/a.h", "// Aborts with file and line on a bug, and\n// never otherwise.\n#ifndef X\n")

    def test_a_file_without_a_comment_is_a_breach(self):
        self.expect("src/base/a.h", "#ifndef X\n", "opens with one sentence")

    def test_a_comment_without_a_sentence_is_a_breach(self):
        self.expect("src/base/a.h", "// helpers\n#ifndef X\n", "opens with one sentence")

    def test_an_unfinished_opening_is_a_breach(self):
        self.expect("kernels/a.h", "// TELL: what goes in, what comes out.\n", "opens with one sentence")

    def test_an_empty_file_is_a_breach(self):
        self.expect("tests/a_test.cc", "", "opens with one sentence")

    def test_scripts_and_cmake_open_with_a_sentence_too(self):
        self.write("scripts/good.py", '#!/usr/bin/env python3\n"""Says what it does.\n"""\n')
        self.write("scripts/good", "#!/usr/bin/env bash\n# Says what it does.\n")
        self.write("cmake/Good.cmake", "# good(NAME): makes it so.\n")
        self.expect("cmake/Bad.cmake", "set(x 1)\n", "opens with one sentence")

    def test_a_kernel_header_has_at_most_40_lines(self):
        head = "// Declares a kernel.\nSWELL_KERNEL(void, F, int);\n"
        self.write("kernels/good.h", head + LINE * 38)
        self.expect("kernels/bad.h", head + LINE * 39, "41 lines, 40 are allowed")

    def test_a_header_without_a_kernel_may_be_longer(self):
        self.expect("kernels/records.h", "// Declares records, not SWELL_KERNEL(.\n#define SWELL_KERNEL(x)\n" + LINE * 100)

    def test_a_source_has_at_most_300_lines(self):
        self.write("src/base/good.cc", "// Does it well.\n" + LINE * 299)
        self.expect("src/base/zbad.cc", "// Does it too long.\n" + LINE * 300, "301 lines, 300 are allowed")

    def test_inl_headers_count_as_sources(self):
        self.expect("kernels/a-inl.h", "// Does it too long.\n" + LINE * 300, "301 lines, 300 are allowed")

    def test_kernels_do_not_estimate(self):
        self.expect("kernels/a.cc", "// Estimates a value.\nhn::ApproximateReciprocal(x);\nasm(rcpps);\n"
                    "hn::ApproximateReciprocalSqrt(x);\n_mm256_rcp_ps(x);\n",
                    "ApproximateReciprocal", "rcpps", "ApproximateReciprocalSqrt", "_mm256_rcp_ps")

    def test_a_comment_may_say_what_kernels_do_not(self):
        self.expect("kernels/a.cc", "// Divides a value.\n// ApproximateReciprocal differs by vendor.\n")

    def test_no_target_or_fast_maths_in_cmake(self):
        self.expect("src/CMakeLists.txt", "a\nadd(-mavx2)\nadd(-ffast-math)\n", "-mavx2", "-ffast-math")

    def test_the_data_model_names_every_column(self):
        self.write("kernels/records.h", "// Holds records.\ntemplate <class C> struct Vec3Fields { C<float> x, y, z; };\n"
                   "template <class C> struct RayFields {\n  Vec3Fields<C> org;  // where\n  C<float> u, v;\n};\n")
        self.expect("docs/data-model.md", "# Data model\n`v`\n## RayFields\n| `org` | `u` |\n## HitFields\n`v`\n",
                    "section RayFields does not name the column `v`")

    def test_an_exception_must_exist(self):
        self.addCleanup(check_style.LONGER.clear)
        check_style.LONGER["kernels/gone.cc"] = "a table"
        self.assertEqual(check_style.check(self.root), ["kernels/gone.cc:1: is an exception but does not exist"])

    def test_an_exception_may_be_longer(self):
        self.addCleanup(check_style.LONGER.clear)
        check_style.LONGER["kernels/a.cc"] = "a table"
        self.expect("kernels/a.cc", "// Holds a table.\n" + LINE * 400)


if __name__ == "__main__":
    unittest.main()
