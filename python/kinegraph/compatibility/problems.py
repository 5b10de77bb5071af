"""Methods of motion problems, solvers and skeletons by their earlier names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import JT, KOMO, NLP, OT, Config, Frame, NLP_Factory, NLP_Solver, Skeleton


def setModel(self: KOMO, config: Config, enableCollisions: bool = False) -> None:
    """Takes the scene, as setConfig.

    Args:
        config, enableCollisions: As of setConfig.
    """
    self.setConfig(config, enableCollisions)


def add_qControlObjective(
    self: KOMO,
    times: ArrayLike | None = None,
    order: int = 2,
    scale: float = 1.0,
    target: ArrayLike | None = None,
    deltaFromSlice: int = 0,
    deltaToSlice: int = 0,
) -> None:
    """Adds the sum of squares of a time derivative of all dofs as cost, as addControlObjective.

    Args:
        times, order, scale, target, deltaFromSlice, deltaToSlice: As of addControlObjective; times None: all slices.
    Raises:
        ArgumentError: The order is higher than that of the KOMO, or a size does not fit.
    """
    self.addControlObjective([] if times is None else times, order, scale, target, deltaFromSlice, deltaToSlice)


def getPath_qOrg(self: KOMO) -> NDArray[np.float64]:
    """The joint vectors of all slices, shape (T, n), rad or m, as getPath."""
    return self.getPath()


def getReport(self: KOMO, *args: Any, **kwargs: Any) -> dict[str, Any]:
    """What report returns by default.

    Args:
        args, kwargs: Not used.
    Returns:
        A dict from the names of objectives to what they add to costs and violations.
    """
    return self.report()


def getFeatureTypes(self: NLP) -> list[OT]:
    """The OT of each residual, as getTypes."""
    return self.getTypes()


def setFeatureTypes(self: NLP_Factory, featureTypes: Sequence[OT]) -> None:
    """Says what the residuals mean, as setTypes.

    Args:
        featureTypes: The OT of each residual.
    Raises:
        TypeError: Something else than OT.
    """
    self.setTypes(featureTypes)


def getTrace_costs(self: NLP_Solver) -> NDArray[np.float64]:
    """Sums of f, sos, ineq, eq of each evaluation, shape (evaluations, 4), as getTrace_errs; setTracing(True) first."""
    return self.getTrace_errs()


def addStableFrame(
    self: KOMO,
    name: str,
    parent: str,
    jointType: JT,
    stable: bool = True,
    initName: str | Frame | None = None,
    initFrame: Frame | None = None,
) -> Frame:
    """Adds a frame with a joint to all slices, as addFrameDof.

    Args:
        name, parent, jointType: Of the frame.
        stable: The joint does not move: its values are the same in all slices.
        initName, initFrame: Where it is at first: the name of a frame, or a frame.
    Returns:
        A copy of the frame.
    Raises:
        FrameNotFound: A name that is not in the scene.
    """
    if isinstance(initName, Frame):
        initName, initFrame = None, initName
    return self.addFrameDof(name, parent, jointType, stable, initName, initFrame)


def reportProblem(self: KOMO) -> None:
    """Prints what the problem consists of: its size and its objectives."""
    print(self.nlp().report(2))
    for name in self.info_objectiveNames():
        print(f"  {name}")


def enableAccumulatedCollisions(self: Skeleton, enable: bool = True) -> None:
    """Sets whether the motion is kept free of all collisions, as useBroadCollisions.

    Args:
        enable: False: only the pairs of addExplicitCollisions are kept apart.
    """
    self.useBroadCollisions(enable)


def getLog_x(self: NLP_Solver) -> NDArray[np.float64]:
    """The variables of each evaluation, shape (evaluations, n), as getTrace_x; setTracing(True) first."""
    return self.getTrace_x()


def getLog_costs(self: NLP_Solver) -> NDArray[np.float64]:
    """Sums of f, sos, ineq, eq of each evaluation, shape (evaluations, 4), as getTrace_errs; setTracing(True) first."""
    return self.getTrace_errs()


KOMO_METHODS = [setModel, add_qControlObjective, getPath_qOrg, getReport, addStableFrame, reportProblem]
