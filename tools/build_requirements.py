#!/usr/bin/env python3
"""Prints the build requirements of the library and its C++ tests from pyproject.toml, one per line."""

import tomllib
from pathlib import Path

with (Path(__file__).parent.parent / "pyproject.toml").open("rb") as file:
    pyproject = tomllib.load(file)
print("\n".join(pyproject["build-system"]["requires"] + pyproject["project"]["optional-dependencies"]["cpp-test"]))
