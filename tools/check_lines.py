#!/usr/bin/env python3
"""Checks that no line of prose is longer than 120 characters.

    python tools/check_lines.py            checks every tracked C++, Python, TypeScript and Markdown file
    python tools/check_lines.py PATH ...   checks these files

Code is left to clang-format and ruff. Prose means comments, docstrings, the documentation strings of the bindings, and
Markdown outside of tables. Lines with a web address are exempt.
"""

import re
import sys
from pathlib import Path

from source_text import EXCLUDED, ROOT, SUFFIXES, passages, tracked_files

LIMIT = 120


def is_exempt(path: Path, line: str) -> bool:
    return "://" in line or (path.suffix == ".md" and line.lstrip().startswith("|"))


def is_code(line: str, passage: str) -> bool:
    """Returns whether `line` is too long by its code alone: a comment behind it changes nothing."""
    comment = re.match(r"//|#(?!#)|/\*", passage)
    return comment is not None and len(line.split(comment[0])[0].rstrip()) > LIMIT


def long_lines(path: Path) -> list[tuple[int, int]]:
    """Returns the number and the length of each line of prose in `path` that is too long."""
    lines = path.read_text(encoding="utf-8", errors="replace").split("\n")
    found = {}
    for start, passage in passages(path):
        for number in range(start, start + passage.count("\n") + 1):
            line = lines[number - 1]
            if len(line) > LIMIT and not is_exempt(path, line) and not is_code(line, passage):
                found[number] = len(line)
    return sorted(found.items())


def main() -> int:
    given = [Path(name).resolve() for name in sys.argv[1:]]
    excluded = tuple(str(ROOT / name) for name in EXCLUDED)
    paths = [p for p in given if p.suffix in SUFFIXES and not str(p).startswith(excluded)] if given else tracked_files()
    problems = []
    for path in paths:
        place = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
        problems += [f"{place}:{number}: {length} characters; at most {LIMIT}" for number, length in long_lines(path)]
    print("\n".join(problems) if problems else f"lines: {len(paths)} files, no prose beyond {LIMIT} characters")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
