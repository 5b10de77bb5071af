"""Plans in words."""

from __future__ import annotations

from collections.abc import Sequence


def planText(plan: Sequence[Sequence[str]]) -> str:
    """Actions as they are written in logic: "(pick cup table hand) (place cup hand tray)"."""
    return " ".join(f"({' '.join(action)})" for action in plan)
