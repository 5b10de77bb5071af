"""Methods by their earlier names, each in terms of those of today."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

from .._core import KOMO, NLP, BotOp, CameraView, Config, Frame, NLP_Factory, NLP_Solver, Skeleton
from . import bot_op, problems, scenes, views

METHODS: dict[type, Sequence[Callable[..., Any]]] = {
    BotOp: bot_op.METHODS,
    CameraView: views.CAMERA_METHODS,
    Config: [*scenes.CONFIG_METHODS, *views.CONFIG_METHODS],
    Frame: scenes.FRAME_METHODS,
    KOMO: problems.KOMO_METHODS,
    NLP: [problems.getFeatureTypes],
    NLP_Factory: [problems.setFeatureTypes],
    NLP_Solver: [problems.getTrace_costs, problems.getLog_x, problems.getLog_costs],
    Skeleton: [problems.enableAccumulatedCollisions],
}


def addEarlierMethods() -> None:
    """Gives the classes their methods of earlier years. Help shows the signature, as of the others."""
    for owner, methods in METHODS.items():
        for method in methods:
            name = method.__name__
            signature = str(inspect.signature(method)).replace("'", "")  # annotations are kept as text
            method.__doc__ = f"{name}{signature}\n\n{inspect.getdoc(method)}"
            method.__qualname__ = f"{owner.__name__}.{name}"
            setattr(owner, name, method)
