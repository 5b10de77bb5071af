"""Arguments by their names in earlier versions, as `bot.gripperMove(leftRight=ry._left)`."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from .operation import BotOp
from .path_finder import RRT_PathFinder
from .scenes import Config
from .simulation import Simulation

_GRIPPER = {"leftRight": "id"}  # until 0.2.9

WORDS: dict[tuple[type, str], dict[str, str]] = {
    (BotOp, "getGripperPos"): _GRIPPER,
    (BotOp, "gripperClose"): _GRIPPER,
    (BotOp, "gripperCloseGrasp"): _GRIPPER,
    (BotOp, "gripperDone"): _GRIPPER,
    (BotOp, "gripperMove"): _GRIPPER,
    (Config, "delFrame"): {"frameName": "frame"},
    (Config, "frame"): {"frameName": "frameID"},
    (RRT_PathFinder, "setProblem"): {"starts": "q0", "goals": "qT"},
    (Simulation, "attach"): {"gripper": "frm", "obj": "to"},
    (Simulation, "detach"): {"obj": "frm"},
    (Simulation, "setState"): {"frameState": "state"},
}


def _accepting(call: Callable[..., Any], words: dict[str, str]) -> Callable[..., Any]:
    @functools.wraps(call)
    def renamed(*args: Any, **kwargs: Any) -> Any:
        return call(*args, **{words.get(name, name): value for name, value in kwargs.items()})

    if hasattr(call, "__nb_signature__"):
        renamed.__nb_signature__ = call.__nb_signature__  # type: ignore[attr-defined]
    return renamed


def acceptEarlierWords() -> None:
    """Lets the calls of WORDS take arguments by both names."""
    for (owner, name), words in WORDS.items():
        setattr(owner, name, _accepting(getattr(owner, name), words))
