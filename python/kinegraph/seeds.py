"""Seeds of random numbers."""

from __future__ import annotations

import os

from ._core import setDefaultSeed


def rnd_seed(s: int) -> None:
    """Seeds all later random numbers: sampled joint states, initial points of solvers.

    Args:
        s: An integer; equal seeds give equal numbers.
    """
    setDefaultSeed(int(s))


def rnd_seed_random() -> None:
    """Sets a seed that differs in every run."""
    setDefaultSeed(int.from_bytes(os.urandom(8), "little") >> 1)  # 63 bits
