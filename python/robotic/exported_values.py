"""Values of enums as names of the module, as `ry.hingeX` in versions until 0.1.10."""

from __future__ import annotations

from typing import Any

import kinegraph

# A name in several enums is the value of the first one here, as in 0.1.10.
_ENUMS = ("OT", "ControlMode", "SY", "FS", "JT", "ST", "SimulationEngine", "NLP_SolverID")


def exportedValue(name: str) -> Any:
    """Returns the value of an enum by its name alone.

    Args:
        name: Such as "hingeX".
    Returns:
        The value, as JT.hingeX; None if no enum has the name.
    """
    for enum in _ENUMS:
        members = getattr(kinegraph, enum).__members__
        if name in members:
            return members[name]
    return None
