#!/usr/bin/env python3
"""Checks which file of the tree may include or do what; prints each breach as file:line: rule.

Usage: check_layers.py [ROOT]. The rules are the tables below; see docs/architecture.md.
"""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from source_text import CXX_ENDINGS, code_lines, files_below, includes, read  # noqa: E402

# A folder of src/ includes itself and folders of lower rank; folders of one rank do not know each
# other.
RANKS = {
    "base": 0,
    "stats": 1, "scene": 1,
    "import": 2, "bvh": 2, "film": 2,
    "wave": 3,
    "stages": 4,
    "schedule": 5,
    "cli": 6,
}

# What a kernel may take from the standard library: nothing that allocates, prints, locks or threads.
KERNEL_STD = {
    "algorithm", "array", "bit", "cassert", "cfloat", "climits", "cmath", "concepts", "cstddef",
    "cstdint", "cstring", "initializer_list", "iterator", "limits", "numbers", "numeric", "span",
    "tuple", "type_traits", "utility", "assert.h", "float.h", "limits.h", "math.h", "stddef.h",
    "stdint.h", "string.h",
}

# A stage is a single-threaded function of one wave; these are shared by all workers instead.
MAY_LOCK = {
    "src/base/new_file.cc": "numbers the hidden files of all threads",
    "src/wave/units.h": "hands work out to all workers",
    "src/stages/wave_recorder.h": "takes rows from all workers, only for --dump-wave",
}
LOCKS = re.compile(r"<(mutex|shared_mutex|atomic)>")

# Headers that only some folders of src/ may include.
ONLY_IN = [
    (re.compile(r"<OpenImageIO/"), {"film", "import"}, "OpenImageIO"),
    (re.compile(r"<(oneapi/)?tbb/"), {"schedule", "bvh", "import"}, "TBB"),
    (LOCKS, {"schedule", "bvh", "film", "import", "cli"},
     "a lock or an atomic"),
    (re.compile(r"<CLI/"), {"cli"}, "the command line"),
    (re.compile(r"<embree"), set(), "Embree"),
]

PRINTS = re.compile(
    r"\bstd::(cout|cerr|clog)\b|(?<![\w.>])(std::)?(printf|vprintf|puts|putchar|perror)\s*\("
    r"|\b(stdout|stderr|STDOUT_FILENO|STDERR_FILENO)\b|<iostream>")
MAY_PRINT = {"src/base/check.h"}

# Asking for their number starts no thread.
THREADS = re.compile(
    r"\bstd::(jthread|async|promise|packaged_task|condition_variable\w*|barrier|latch"
    r"|thread\b(?!::hardware_concurrency))|\bpthread_create\b")
MAY_THREAD = {"schedule", "bvh", "import"}


def kernel_breaches(text):
    for number, name in includes(text):
        inner = name[1:-1]
        if name[0] == '"' and inner.startswith("kernels/"):
            continue
        if name[0] == "<" and (inner.startswith("hwy/") or inner in KERNEL_STD):
            continue
        yield number, f"kernels/ includes only kernels/, hwy/ and std headers that cannot fail, not {name}"


def src_breaches(folder, path, text):
    for number, name in includes(text):
        inner = name[1:-1]
        if inner.endswith("-inl.h"):
            yield number, f"no -inl.h leaves kernels/: {name}"
        if inner.split("/")[0] in ("tests", "bench"):
            yield number, f"src/ does not know {name}"
        if "/" not in inner and name[0] == '"':
            yield number, f"include paths start at the repository root, not {name}"
        parts = inner.split("/")
        if parts[0] == "src" and len(parts) > 2 and parts[1] != folder:
            if RANKS.get(parts[1], len(RANKS)) >= RANKS[folder]:
                yield number, f"src/{folder} lies below or beside src/{parts[1]}: {name}"
        for pattern, folders, what in ONLY_IN:
            if pattern is LOCKS and path in MAY_LOCK:
                continue
            if pattern.match(name) and folder not in folders:
                yield number, f"{what} is only for {', '.join(sorted(folders)) or 'tests and benchmarks'}: {name}"


def check(root):
    """All breaches below `root`, as 'file:line: rule'."""
    breaches = []
    for path in files_below(root, ["kernels", "src"], CXX_ENDINGS):
        text = read(root, path)
        parts = path.split("/")
        found = []
        if parts[0] == "kernels":
            found += kernel_breaches(text)
        elif len(parts) < 3 or parts[1] not in RANKS:
            found.append((1, f"a file of src/ lies in one of {', '.join(RANKS)}"))
        else:
            found += src_breaches(parts[1], path, text)
        prints = path in MAY_PRINT or parts[:2] == ["src", "cli"]
        threads = parts[0] == "src" and parts[1] in MAY_THREAD
        for number, line in enumerate(code_lines(text), 1):
            match = PRINTS.search(line)
            if match and not prints:
                found.append((number, f"only src/cli prints: {match.group(0).strip()}"))
            match = THREADS.search(line)
            if match and not threads:
                found.append((number, f"a thread is only for {', '.join(sorted(MAY_THREAD))}: {match.group(0)}"))
        breaches += [f"{path}:{number}: {rule}" for number, rule in sorted(found)]
    return breaches


def main(arguments):
    root = arguments[0] if arguments else os.path.join(os.path.dirname(__file__), "..")
    breaches = check(root)
    print("\n".join(breaches) if breaches else "layers: no breach")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
