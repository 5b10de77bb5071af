"""Words of actions and facts, as an execution reads them."""

from __future__ import annotations

from collections.abc import Sequence

PICKS = ("pick", "lift")  # a hand takes an object from where it stands
PLACES = ("place", "lay")  # a hand puts an object down
GUIDED = ("open", "close")  # a hand moves a door by its handle, and lets go of it


def planText(plan: Sequence[Sequence[str]]) -> str:
    """Actions as they are written in logic: "(pick cup table hand) (place cup hand tray)"."""
    return " ".join(f"({' '.join(action)})" for action in plan)


def wordsOf(facts: list[str], predicate: str) -> list[str]:
    """What a predicate of one argument holds of."""
    return [fact[1:-1].split()[1] for fact in facts if fact.startswith(f"({predicate} ")]
