"""What is random, and how it repeats."""

from __future__ import annotations

import secrets

from ._core import setDefaultSeed


def rnd_seed(seed: int) -> None:
    """Seeds what is random from here on: sampled joint states, initial points of solvers.

    Args:
        seed: A whole number; the same one gives the same numbers.
    """
    setDefaultSeed(int(seed))


def rnd_seed_random() -> None:
    """Seeds it with a number that differs in every run."""
    setDefaultSeed(secrets.randbits(63))
