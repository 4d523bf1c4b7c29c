"""Tests of scripts/check_layers.py on small trees, most of them bad."""
import os
import subprocess
import sys
import unittest

from tree import ROOT, TreeTest
import check_layers


class CheckLayers(TreeTest):
    def expect(self, path, text, *breaches):
        """`text` at `path` gives these breaches: (line, part of the rule)."""
        self.write(path, text)
        found = check_layers.check(self.root)
        self.assertEqual(len(found), len(breaches), found)
        for line, (number, part) in zip(found, breaches):
            self.assertTrue(line.startswith(f"{path}:{number}: "), line)
            self.assertIn(part, line)

    def test_a_kernel_may_include_kernels_highway_and_plain_headers(self):
        self.expect("kernels/a.cc", '#include "kernels/a.h"\n#include <hwy/highway.h>\n#include <cstdint>\n'
                    '#include <cmath>\n#include HWY_TARGET_INCLUDE\n')

    def test_a_kernel_may_not_include_the_host(self):
        self.expect("kernels/a.cc", '// A.\n#include "src/base/check.h"\n', (2, "src/base/check.h"))

    def test_a_kernel_may_not_allocate_print_or_thread(self):
        self.expect("kernels/a.h", "#include <vector>\n#include <iostream>\n#include <thread>\n#include <tbb/task.h>\n",
                    (1, "<vector>"), (2, "<iostream>"), (2, "only src/cli prints"), (3, "<thread>"), (4, "<tbb/task.h>"))

    def test_a_kernel_in_a_subfolder_is_held_to_the_same(self):
        self.expect("kernels/materials/a.cc", "  #  include <string>\n", (1, "<string>"))

    def test_no_inl_header_leaves_kernels(self):
        self.expect("src/stages/a.cc", '#include "kernels/lanes-inl.h"\n', (1, "no -inl.h leaves kernels/"))

    def test_folders_include_lower_folders_and_themselves(self):
        self.expect("src/stages/a.cc", '#include "src/stages/b.h"\n#include "src/wave/wave.h"\n'
                    '#include "src/stats/stats.h"\n#include "src/base/check.h"\n#include "kernels/sort_hits.h"\n')

    def test_folders_do_not_include_higher_ones(self):
        self.expect("src/base/a.h", '#include "src/scene/scene.h"\n', (1, "src/base lies below or beside src/scene"))

    def test_stats_lie_below_stages(self):
        self.expect("src/stats/a.h", '#include "src/stages/pipeline.h"\n', (1, "below or beside src/stages"))

    def test_folders_do_not_include_neighbours(self):
        self.expect("src/film/a.h", '#include "src/bvh/bvh.h"\n', (1, "below or beside src/bvh"))

    def test_folders_do_not_include_unknown_ones(self):
        self.expect("src/cli/a.h", '#include "src/util/b.h"\n', (1, "below or beside src/util"))

    def test_an_unknown_folder_is_a_breach(self):
        self.expect("src/util/a.h", "// A.\n", (1, "lies in one of base"))

    def test_a_file_directly_in_src_is_a_breach(self):
        self.expect("src/a.cc", "// A.\n", (1, "lies in one of base"))

    def test_src_does_not_include_tests(self):
        self.expect("src/cli/a.cc", '#include "tests/support/x.h"\n', (1, "does not know"))

    def test_paths_start_at_the_root(self):
        self.expect("src/cli/a.cc", '#include "options.h"\n', (1, "start at the repository root"))

    def test_only_cli_prints(self):
        self.write("src/cli/main.cc", "int main() { std::cout << 1; std::fprintf(stderr, \"x\"); }\n")
        self.expect("src/stages/a.cc", 'void F() {\n  std::cout << 1;\n  printf("x");\n  std::fprintf(stderr, "x");\n'
                    '  puts("x");\n}\n', (2, "std::cout"), (3, "printf"), (4, "stderr"), (5, "puts"))

    def test_formatting_into_memory_and_words_are_no_printing(self):
        self.expect("src/stages/a.cc", '// printf(stderr) is not used here\nvoid F() { std::snprintf(b, 4, "printf(stderr)"); '
                    'std::fprintf(file, "x"); x.puts(); }\n/* std::cerr */\n')

    def test_check_may_print(self):
        self.expect("src/base/check.h", 'void F() { std::fprintf(stderr, "x"); }\n')

    def test_images_only_in_film_and_import(self):
        self.write("src/film/a.cc", "#include <OpenImageIO/imageio.h>\n")
        self.write("src/import/a.cc", "#include <OpenImageIO/imageio.h>\n")
        self.expect("src/cli/a.cc", "#include <OpenImageIO/imageio.h>\n", (1, "OpenImageIO"))

    def test_threads_only_in_schedule_and_bvh(self):
        for folder in ("schedule", "bvh"):
            self.write(f"src/{folder}/a.cc", "#include <tbb/parallel_for.h>\nstd::thread t;\n")
        self.expect("src/stages/a.cc", "#include <tbb/parallel_for.h>\n#include <atomic>\nstd::thread t;\nstd::async(f);\n",
                    (1, "TBB"), (2, "a lock or an atomic"), (3, "std::thread"), (4, "std::async"))

    def test_what_all_workers_share_may_lock(self):
        self.expect("src/wave/units.h", "#include <atomic>\n")
        self.expect("src/wave/wave.h", "#include <atomic>\n", (1, "a lock or an atomic"))

    def test_asking_for_the_number_of_threads_is_no_thread(self):
        self.expect("src/stats/a.cc", "#include <thread>\nint n = std::thread::hardware_concurrency();\n")

    def test_embree_is_only_for_tests_and_benchmarks(self):
        self.expect("src/bvh/a.cc", "#include <embree3/rtcore.h>\n", (1, "only for tests and benchmarks"))

    def test_the_program_fails_on_a_breach_and_not_without(self):
        script = os.path.join(ROOT, "scripts", "check_layers.py")
        self.write("src/base/a.h", "// A.\n")
        self.assertEqual(subprocess.run([sys.executable, "-B", script, self.root], capture_output=True).returncode, 0)
        self.write("src/base/b.h", '#include "src/cli/a.h"\n')
        run = subprocess.run([sys.executable, "-B", script, self.root], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("src/base/b.h:1: ", run.stdout)


if __name__ == "__main__":
    unittest.main()
