"""Takes C++ source text; gives its files, its includes, its code without comments and strings, and
the report of what a lint finds in it."""
import os
import re

CXX_ENDINGS = (".h", ".cc")

_INCLUDE = re.compile(r'^\s*#\s*include\s*(<[^>]+>|"[^"]+")')
_NO_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])*'", re.DOTALL)


def files_below(root, folders, endings):
    """Sorted paths relative to `root`, with '/', of the files below `folders` that end so."""
    found = []
    for folder in folders:
        for place, _, names in os.walk(os.path.join(root, folder)):
            for name in names:
                if name.endswith(endings):
                    found.append(os.path.relpath(os.path.join(place, name), root).replace(os.sep, "/"))
    return sorted(found)


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def includes(text):
    """(line number, what is included with its <> or "") of each include."""
    found = []
    for number, line in enumerate(text.split("\n"), 1):
        match = _INCLUDE.match(line)
        if match:
            found.append((number, match.group(1)))
    return found


def code_lines(text):
    """The lines of `text` with comments gone and literals emptied; numbers of lines are kept."""

    def blank(match):
        newlines = "\n" * match.group(0).count("\n")
        return newlines if match.group(0).startswith("/") else '""' + newlines

    return _NO_CODE.sub(blank, text).split("\n")


def report(name, check, arguments):
    """Prints the breaches that `check` finds below arguments[0], or this tree; the exit code."""
    root = arguments[0] if arguments else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    breaches = check(root)
    print("\n".join(breaches) if breaches else f"{name}: no breach")
    return 1 if breaches else 0
