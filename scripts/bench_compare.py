#!/usr/bin/env python3
"""Compares the kernels' benchmarks of two revisions: builds both, alternates their runs, prints a table.

Usage: bench_compare.py --base REV [--filter NAME] [--repetitions N] [--folder DIR]

The base is checked out to DIR/source (default: build/compare) and built beside it; the other side
is the working tree. The ratio is the new rate over the base's: above 1 is faster. Exit code 1 if a
case is slower beyond the noise: every run of the new side is slower than every run of the base.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def run(command, **options):
    """Runs a command; its output goes to stderr, so that stdout holds the table alone."""
    print("+", " ".join(command), file=sys.stderr)
    subprocess.run(command, check=True, stdout=sys.stderr, **options)


def checkout(revision, folder):
    """A worktree of `revision` in `folder`, made or moved."""
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--verify", revision + "^{commit}"], check=True,
                            capture_output=True, text=True).stdout.strip()
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    if os.path.exists(os.path.join(folder, ".git")):
        run(["git", "-C", folder, "checkout", "--detach", "--force", commit])
    else:
        run(["git", "-C", ROOT, "worktree", "prune"])
        run(["git", "-C", ROOT, "worktree", "add", "--detach", "--force", folder, commit])
    return commit[:12]


def build(source, folder, jobs):
    """Path of swell_bench, built from `source` in `folder`."""
    run(["cmake", "-G", "Ninja", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
         "-DSWELL_TESTS=OFF", "-DSWELL_BENCH=ON"])
    run(["cmake", "--build", folder, "--target", "swell_bench", "--parallel", str(jobs)])
    return os.path.join(folder, "bin", "swell_bench")


def measure(program, pattern, seconds):
    """Rows per second of every case, by CPU time."""
    command = [program, "--benchmark_format=json", f"--benchmark_min_time={seconds}"]
    if pattern:
        command.append(f"--benchmark_filter={pattern}")
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    cases = json.loads(output)["benchmarks"]
    return {case["name"]: case["items_per_second"] for case in cases if "items_per_second" in case}


def spread(rates):
    """'median (least-most)' in millions."""
    millions = [rate / 1e6 for rate in rates]
    return f"{statistics.median(millions):.4g} ({min(millions):.4g}-{max(millions):.4g})"


def table(base, new, base_name):
    """Markdown rows for the cases that both sides have, and the names of those that got slower."""
    lines = [f"| case | {base_name}, M rows/s | working tree, M rows/s | ratio |", "|---|---|---|---|"]
    slower = []
    for name in new[0]:
        if any(name not in rates for rates in base + new):
            continue
        before = [rates[name] for rates in base]
        after = [rates[name] for rates in new]
        # Neighbouring runs share what else the machine does.
        ratios = [b / a for a, b in zip(before, after)]
        lines.append(f"| {name} | {spread(before)} | {spread(after)} | {statistics.median(ratios):.3f} "
                     f"({min(ratios):.3f}-{max(ratios):.3f}) |")
        if max(after) < min(before):
            slower.append(name)
    return lines, slower


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--base", required=True, help="revision to compare with")
    parser.add_argument("--filter", default="", help="regular expression of cases")
    parser.add_argument("--repetitions", type=int, default=7, help="runs of each side")
    parser.add_argument("--seconds", type=float, default=0.1, help="least time of a case in a run")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "compare"), help="where to build")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once")
    options = parser.parse_args(arguments)

    folder = os.path.abspath(options.folder)
    try:
        commit = checkout(options.base, os.path.join(folder, "source"))
        programs = [build(os.path.join(folder, "source"), os.path.join(folder, "base"), options.jobs),
                    build(ROOT, os.path.join(folder, "new"), options.jobs)]
        rates = [[], []]
        for repetition in range(options.repetitions):
            order = (0, 1) if repetition % 2 == 0 else (1, 0)
            for side in order:
                rates[side].append(measure(programs[side], options.filter, options.seconds))
    except subprocess.CalledProcessError as failed:
        reason = (failed.stderr or "").strip().split("\n")[-1]
        print(f"bench_compare: {' '.join(failed.cmd)}: {reason or f'exit code {failed.returncode}'}", file=sys.stderr)
        return 2
    except OSError as failed:
        print(f"bench_compare: {options.base}: {failed}", file=sys.stderr)
        return 2
    if not rates[1][0]:
        print(f"bench_compare: no case matches '{options.filter}'", file=sys.stderr)
        return 2
    lines, slower = table(rates[0], rates[1], commit)
    print("\n".join(lines))
    for name in slower:
        print(f"bench_compare: {name} got slower", file=sys.stderr)
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
