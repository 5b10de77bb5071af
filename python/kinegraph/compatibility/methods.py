"""Adds methods under their earlier names, which call the present ones."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

from .._core import (
    KOMO,
    NLP,
    BotOp,
    CameraView,
    Config,
    ConfigurationViewer,
    Frame,
    NLP_Factory,
    NLP_Solver,
    NLP_SolverOptions,
    Skeleton,
)
from . import bot_op, problems, scenes, views

METHODS: dict[type, Sequence[Callable[..., Any]]] = {
    BotOp: bot_op.METHODS,
    CameraView: views.CAMERA_METHODS,
    Config: [*scenes.CONFIG_METHODS, *views.CONFIG_METHODS],
    ConfigurationViewer: views.VIEWER_METHODS,
    Frame: scenes.FRAME_METHODS,
    KOMO: problems.KOMO_METHODS,
    NLP: [problems.getFeatureTypes],
    NLP_Factory: [problems.setFeatureTypes],
    NLP_Solver: [problems.getTrace_costs, problems.getLog_x, problems.getLog_costs],
    NLP_SolverOptions: [problems.set_maxStep, problems.set_maxLambda],
    Skeleton: [problems.enableAccumulatedCollisions],
}


def addEarlierMethods() -> None:
    """Adds the methods to the classes, with their signatures for help()."""
    for owner, methods in METHODS.items():
        for method in methods:
            name = method.__name__
            signature = str(inspect.signature(method)).replace("'", "")  # annotations are stored as text
            method.__doc__ = f"{name}{signature}\n\n{inspect.getdoc(method)}"
            method.__qualname__ = f"{owner.__name__}.{name}"
            setattr(owner, name, method)
