"""What is random, and how it repeats."""

from __future__ import annotations

import os

from ._core import setDefaultSeed


def rnd_seed(s: int) -> None:
    """Seeds what is random from here on: sampled joint states, initial points of solvers.

    Args:
        s: A whole number; the same one gives the same numbers.
    """
    setDefaultSeed(int(s))


def rnd_seed_random() -> None:
    """Seeds it with a number that differs in every run."""
    setDefaultSeed(int.from_bytes(os.urandom(8), "little") >> 1)  # 63 bits
