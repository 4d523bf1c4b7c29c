#!/usr/bin/env python3
"""Reads ctest's JUnit file and prints 'N passed, N failed', with ', N skipped' if any were.

Fails if a test failed, could not be started or was disabled, or if there was none.
"""
import sys
import xml.etree.ElementTree as ElementTree


def count(root):
    """Numbers of (passed, failed, skipped) test cases below `root`."""
    passed = failed = skipped = 0
    for case in root.iter("testcase"):
        reason = case.find("skipped")
        if case.get("status") == "run":
            passed += 1
        elif reason is not None and reason.get("message", "").startswith("SKIP_"):
            skipped += 1  # the test itself asked for it
        else:
            failed += 1
    return passed, failed, skipped


def main(path):
    try:
        passed, failed, skipped = count(ElementTree.parse(path).getroot())
    except (OSError, ElementTree.ParseError) as error:
        print(f"count_tests: no result of ctest: {error}", file=sys.stderr)
        return 1
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
