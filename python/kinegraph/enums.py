"""Enums whose errors suggest similar names."""

from __future__ import annotations

import enum
from typing import Any

# Names of other formats and libraries, by enum.
FOREIGN: dict[str, dict[str, str]] = {
    "JT": {
        "revolute": "hingeX, hingeY or hingeZ",
        "continuous": "hingeX, hingeY or hingeZ without limits",
        "prismatic": "transX, transY or transZ",
        "slide": "transX, transY or transZ",
        "fixed": "no joint; rigid is that of objects",
        "floating": "free",
        "ball": "quatBall",
        "spherical": "quatBall",
        "planar": "transXYPhi",
    },
    "ST": {
        "cube": "box",
        "cuboid": "box",
        "block": "box",
        "ball": "sphere",
        "halfspace": "plane",
        "points": "pointCloud",
    },
}


def foreignHint(kind: str, name: str) -> str:
    """Names the member that has the meaning of a name of other formats; empty without one."""
    meant = FOREIGN.get(kind, {}).get(name.lower())
    return f"; here it is {meant}" if meant else ""


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
        hint = foreignHint(cls.__name__, name) or (f"; similar names: {', '.join(near)}" if near else "")
        hint = hint or f"; expected one of {', '.join(members)}"
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
