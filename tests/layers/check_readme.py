#!/usr/bin/env python3
"""Checks that src/README.md speaks of what there is: each file that it names exists, and each function() or kConstant
stands in one of the files named in the same row, item or paragraph. Prints a line for each that does not; exits 1.

usage: check_readme.py REPOSITORY
"""

import pathlib
import re
import sys

FILE = re.compile(r"`([\w/]+/[\w.]+\.\w+)`")
NAME = re.compile(r"`(\w+)\(\)`|`(k[A-Z]\w+)`")
START = re.compile(r"\n\s*\n|\n(?=[|-])")  # of a paragraph, row or item


def wrong_names(top):
    for block in START.split((top / "src/README.md").read_text()):
        words = set()
        for name in FILE.findall(block):
            path = next((folder / name for folder in (top / "src", top) if (folder / name).is_file()), None)
            if path is None:
                yield f"no file {name}"
            else:
                words.update(re.findall(r"\w+", path.read_text()))
        for name in ("".join(groups) for groups in NAME.findall(block)):
            if name not in words:
                yield f"no {name} in the files named beside it"


def main():
    wrong = list(wrong_names(pathlib.Path(sys.argv[1])))
    for line in wrong:
        print(f"src/README.md: {line}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
