#!/usr/bin/env python3
"""Prints what the build requires, one requirement a line, as pyproject.toml lists it."""

import tomllib
from pathlib import Path

with (Path(__file__).parent.parent / "pyproject.toml").open("rb") as file:
    print("\n".join(tomllib.load(file)["build-system"]["requires"]))
