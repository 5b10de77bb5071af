"""Enums whose errors suggest similar names."""

from __future__ import annotations

import enum
from typing import Any


class _Teaching(enum.EnumMeta):
    def __getattr__(cls, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        members = cls._member_map_
        name = _earlier.get(cls, {}).get(name, name)
        if name in members:
            return members[name]
        import difflib  # not at import: it takes milliseconds, and is rarely needed

        near = difflib.get_close_matches(name, members, 3, 0.5)
        hint = f"; similar names: {', '.join(near)}" if near else f"; expected one of {', '.join(members)}"
        raise AttributeError(f"{cls.__name__} has no '{name}'{hint}")


_earlier: dict[type, dict[str, str]] = {}


def teach(*classes: type, earlier: dict[str, str] | None = None) -> None:
    """Lets enums explain unknown names.

    Args:
        classes: Enums.
        earlier: Earlier names of members.
    """
    for each in classes:
        each.__class__ = _Teaching
        _earlier[each] = earlier or {}
