#!/usr/bin/env python3
"""Prints what the build requires, one requirement a line, as pyproject.toml lists it (tomllib came with Python 3.11)."""

import re
from pathlib import Path

text = (Path(__file__).parent.parent / "pyproject.toml").read_text()
listed = re.search(r"^requires = \[(.*?)\]", text, re.DOTALL | re.MULTILINE)
assert listed, "pyproject.toml lists no build requirements"
print("\n".join(re.findall(r'"([^"]+)"', listed[1])))
