#!/usr/bin/env python3
"""Checks opening sentences, sizes, forbidden words and that the data model's page is complete; prints
each breach as file:line: rule.

Usage: check_style.py [ROOT].
"""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from source_text import CXX_ENDINGS, code_lines, files_below, read, report  # noqa: E402

MAX_KERNEL_HEADER = 40  # lines of a header that declares kernels
MAX_SOURCE = 300        # lines of a .cc or -inl.h of kernels/ and src/

# path: why it may be longer. Headers without SWELL_KERNEL are data models and need no entry.
LONGER = {}

# Law 1: one arithmetic on every machine. No estimates, no flags that change rounding or targets.
FORBIDDEN_IN_KERNELS = re.compile(
    r"ApproximateReciprocal\w*|\b_mm\w*|\w*(rcpps|rcpss|rcp14|rcp28|rsqrtps|rsqrtss|rsqrt14|rsqrt28)\w*"
    r"|FP_CONTRACT|fast-math|-m(avx|sse|fma)\w*|\bstd::(rand|random_device|mt19937)\w*")
# Intrinsics that are exact, where Highway 1.0.3 has no operation: path -> name.
EXACT_INTRINSICS = {"kernels/lanes-inl.h": "_mm512_mask_i32scatter_epi32"}
FORBIDDEN_IN_CMAKE = re.compile(r"-m(avx|sse|fma)[\w.]*|-f(fast-math|unsafe-math\S*|associative-math)|-Ofast")

COMMENT = {".h": "//", ".cc": "//", ".cmake": "#", ".py": "#", "": "#"}


def opening(path, text):
    """The first comment block (or docstring) of a file, on one line."""
    lines = text.split("\n")
    if lines and lines[0].startswith("#!"):
        lines = lines[1:]
    while lines and not lines[0].strip():
        lines = lines[1:]
    body = "\n".join(lines)
    docstring = re.match(r'"""(.*?)"""', body, re.DOTALL)
    if docstring:
        return " ".join(docstring.group(1).split())
    mark = COMMENT[os.path.splitext(path)[1]]
    block = []
    for line in lines:
        if not line.startswith(mark):
            break
        block.append(line[len(mark):].strip())
    return " ".join(block)


def begins_with_a_sentence(text):
    return re.match(r"\S+ .*?[.:](\s|$)", text) is not None


def fields_of_records(text):
    """(record, field) of each struct template of records.h but the bundles of three."""
    for record in re.finditer(r"struct (\w+Fields) \{\n(.*?)\n\};", text, re.DOTALL):
        for fields in re.finditer(r"^\s*(?:C|\w+Fields)<\w+>\s+([\w, ]+);", record.group(2), re.MULTILINE):
            for field in fields.group(1).split(","):
                yield record.group(1), field.strip()


def data_model_breaches(root):
    """Fields that docs/data-model.md does not name in the section of their record."""
    records, page = "kernels/records.h", "docs/data-model.md"
    if not os.path.exists(os.path.join(root, records)):
        return
    text = read(root, page) if os.path.exists(os.path.join(root, page)) else ""
    sections = {part.split("\n")[0].strip(): part for part in text.split("\n## ")}
    for record, field in fields_of_records("\n".join(code_lines(read(root, records)))):
        if f"`{field}`" not in sections.get(record, ""):
            yield f"{page}:1: section {record} does not name the column `{field}`"


def check(root):
    """All breaches below `root`, as 'file:line: rule'."""
    breaches = []
    sources = files_below(root, ["kernels", "src", "tests", "bench"], CXX_ENDINGS)
    scripts = files_below(root, ["cmake", "scripts", "tests", "bench"], (".cmake", ".py"))
    scripts += [path for path in files_below(root, ["scripts"], "") if "." not in path]
    for path in sources + scripts:
        first = opening(path, read(root, path))
        if not begins_with_a_sentence(first) or first.startswith("TELL"):
            breaches.append(f"{path}:1: a file opens with one sentence that says what it holds")

    for path in files_below(root, ["kernels", "src"], CXX_ENDINGS):
        text = read(root, path)
        size = text.count("\n")
        code = code_lines(text)
        kernel_header = path.endswith(".h") and not path.endswith("-inl.h") and any(
            re.match(r"\s*SWELL_KERNEL\(", line) for line in code)
        is_source = path.endswith((".cc", "-inl.h"))
        limit = MAX_KERNEL_HEADER if kernel_header else MAX_SOURCE if is_source else None
        if limit and size > limit and path not in LONGER:
            breaches.append(f"{path}:{limit + 1}: {size} lines, {limit} are allowed")
        if path.startswith("kernels/"):
            for number, line in enumerate(code, 1):
                match = FORBIDDEN_IN_KERNELS.search(line)
                if match and match.group(0) != EXACT_INTRINSICS.get(path):
                    breaches.append(f"{path}:{number}: {match.group(0)} is not the same on every machine")

    cmake = files_below(root, ["cmake", "kernels", "src", "tests", "bench"], (".cmake", "CMakeLists.txt"))
    cmake += [path for path in ("CMakeLists.txt", "CMakePresets.json")
              if os.path.exists(os.path.join(root, path))]
    for path in cmake:
        for number, line in enumerate(read(root, path).split("\n"), 1):
            match = FORBIDDEN_IN_CMAKE.search(line)
            if match:
                breaches.append(f"{path}:{number}: {match.group(0)}: targets come from Highway, rounding from law 1")

    breaches += data_model_breaches(root)
    for path in sorted(LONGER):
        if not os.path.exists(os.path.join(root, path)):
            breaches.append(f"{path}:1: is an exception but does not exist")
    return breaches


if __name__ == "__main__":
    sys.exit(report("style", check, sys.argv[1:]))
