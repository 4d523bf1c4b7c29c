#!/usr/bin/env python3
"""Writes header, source, test and benchmark of a new kernel, and adds them to the list files.

Usage: new_kernel.py VERB_NOUN [ROOT], as in scale_columns. The kernel it writes works and is tested;
change what it does, then its test.
"""
import os
import re
import sys

HEADER = """\
// TELL: what goes in, what comes out.
#ifndef SWELL_KERNELS_{upper}_H_
#define SWELL_KERNELS_{upper}_H_

#include "kernels/columns.h"
#include "kernels/kernel.h"

namespace swell {{

// to[i] = factor * from[i] for rows [0, count). Rows up to a multiple of kRowPadding are scratch.
SWELL_KERNEL(void, {name}, float factor, In<float> from, size_t count, Out<float> to);

}}  // namespace swell

#endif  // SWELL_KERNELS_{upper}_H_
"""

SOURCE = """\
// TELL: what goes in -> what comes out.
#include "kernels/{stem}.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/{stem}.cc"
#include <hwy/foreach_target.h>

#include "kernels/lanes-inl.h"
HWY_BEFORE_NAMESPACE();
namespace swell::SWELL_WIDTH::HWY_NAMESPACE {{

void {name}(float factor, In<float> from, size_t count, Out<float> to) {{
  const F32 scale = hn::Set(D(), factor);
  for (size_t i = 0; i < count; i += hn::Lanes(D())) {{
    const F32 value = Load(from, i);

    const F32 scaled = hn::Mul(scale, value);

    Store(scaled, to, i);
  }}
}}

}}  // namespace swell::SWELL_WIDTH::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::SWELL_WIDTH {{
HWY_EXPORT({name});
void {name}(float factor, In<float> from, size_t count, Out<float> to) {{
  HWY_DYNAMIC_DISPATCH({name})(factor, from, count, to);
}}
}}  // namespace swell::SWELL_WIDTH
#endif
"""

TEST = """\
// Tests {name} against a scalar loop.
#include "kernels/{stem}.h"

#include <doctest/doctest.h>

#include <vector>

#include "tests/support/for_each_target.h"

namespace swell::test {{
namespace {{

TEST_CASE("{name}: scales every row on every target") {{
  for (const size_t count : kRowCounts) {{
    std::vector<float> from(RoundUpToPadding(count));
    for (size_t i = 0; i < from.size(); ++i) from[i] = static_cast<float>(i) - 3.0f;
    ForEachTarget([&](const char* target, Width width) {{
      INFO(target, ", one lane: ", width == Width::kOneLane, ", rows: ", count);
      std::vector<float> to(from.size());
      {name}(width, 2.5f, from.data(), count, to.data());
      for (size_t i = 0; i < count; ++i) CHECK(to[i] == 2.5f * from[i]);
    }});
  }}
}}

}}  // namespace
}}  // namespace swell::test
"""

BENCH = """\
// Measures {name}: rows per second on one core.
#include "kernels/{stem}.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace swell {{
namespace {{

void BM_{name}(benchmark::State& state, Width width) {{
  constexpr size_t kRows = 4096;
  const std::vector<float> from(kRows, 1.5f);
  std::vector<float> to(kRows);
  for (auto _ : state) {{
    {name}(width, 2.5f, from.data(), kRows, to.data());
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }}
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(kRows));
}}
BENCHMARK_CAPTURE(BM_{name}, wide, Width::kWide);
BENCHMARK_CAPTURE(BM_{name}, one_lane, Width::kOneLane);

}}  // namespace
}}  // namespace swell
"""

# file to write, its text, list file, command that holds the list there
PARTS = [
    ("kernels/{stem}.h", HEADER, None, None),
    ("kernels/{stem}.cc", SOURCE, "kernels/CMakeLists.txt", "set(SWELL_KERNEL_SOURCES"),
    ("tests/kernels/{stem}_test.cc", TEST, "tests/CMakeLists.txt", "swell_add_test(swell_kernel_tests"),
    ("bench/{stem}_bench.cc", BENCH, "bench/CMakeLists.txt", "add_executable(swell_bench"),
]


def problem_of(stem):
    """Why `stem` is no name for a kernel, or None."""
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)+", stem):
        return f"'{stem}' is not verb_noun in snake_case, as scale_columns"
    if "and" in stem.split("_"):
        return f"'{stem}' does two things; write two kernels"
    return None


def add_to_list(text, entry, command):
    """`text` of a CMake file with a line for `entry` in `command`, in sorted place; None without it."""
    lines = text.split("\n")
    first = next((i for i, line in enumerate(lines) if line.startswith(command)), None)
    if first is None:
        return None
    if lines[first] == command + ")":  # no file yet
        return "\n".join(lines[:first] + [command, f"  {entry}", ")"] + lines[first + 1:])
    last = next((i for i in range(first, len(lines)) if lines[i].endswith(")")), len(lines) - 1)
    # Files one a line; not those that a variable holds, nor targets.
    files = [i for i in range(first + 1, last + 1) if re.fullmatch(r"\s+[\w/]+\.cc\)?", lines[i])]
    if not files:
        return None
    if any(lines[i].strip(" )") == entry for i in files):
        return text
    after = [i for i in files if lines[i].strip(" )") > entry]
    place = after[0] if after else files[-1] + 1
    if lines[place - 1].endswith(".cc)"):  # the list's end moves to the new line
        lines[place - 1] = lines[place - 1][:-1]
        entry += ")"
    lines.insert(place, re.match(r"\s*", lines[files[0]]).group(0) + entry)
    return "\n".join(lines)


def main(arguments):
    if len(arguments) not in (1, 2) or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    stem = arguments[0]
    root = arguments[1] if len(arguments) == 2 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    problem = problem_of(stem)
    taken = [path for path in (part[0].format(stem=stem) for part in PARTS)
             if os.path.exists(os.path.join(root, path))]
    if taken:
        problem = f"{taken[0]} exists"
    if problem:
        print(f"new_kernel: {problem}", file=sys.stderr)
        return 1

    words = {"stem": stem, "upper": stem.upper(), "name": "".join(w.capitalize() for w in stem.split("_"))}
    for path, template, list_path, command in PARTS:
        path = path.format(stem=stem)
        os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
        with open(os.path.join(root, path), "w", encoding="utf-8") as file:
            file.write(template.format(**words))
        print(f"wrote {path}")
        if not list_path:
            continue
        entry = path.removeprefix(os.path.dirname(list_path) + "/")
        full = os.path.join(root, list_path)
        changed = None
        if os.path.exists(full):
            with open(full, encoding="utf-8") as file:
                changed = add_to_list(file.read(), entry, command)
        if changed is None:
            print(f"  add it by hand: {list_path} has no list for {entry}")
        else:
            with open(full, "w", encoding="utf-8") as file:
                file.write(changed)
            print(f"  added to {list_path}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
