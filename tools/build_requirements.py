#!/usr/bin/env python3
"""Prints what the library and its C++ tests require to be built, one requirement a line, as pyproject.toml lists it."""

import tomllib
from pathlib import Path

with (Path(__file__).parent.parent / "pyproject.toml").open("rb") as file:
    pyproject = tomllib.load(file)
print("\n".join(pyproject["build-system"]["requires"] + pyproject["project"]["optional-dependencies"]["cpp-test"]))
