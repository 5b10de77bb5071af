"""Methods of motion problems, solvers and skeletons by their earlier names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .._core import JT, KOMO, NLP, OT, Config, Frame, NLP_Factory, NLP_Solver, NLP_SolverOptions, Skeleton

if TYPE_CHECKING:  # numpy.typing takes half a millisecond
    from numpy.typing import ArrayLike, NDArray


def setModel(self: KOMO, config: Config, enableCollisions: bool = False) -> None:
    """Sets the scene, like setConfig.

    Args:
        config, enableCollisions: See setConfig.
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
    """Adds the sum of squares of a time derivative of all dofs as cost, like addControlObjective.

    Args:
        times, order, scale, target, deltaFromSlice, deltaToSlice: See addControlObjective; times None: all slices.
    Raises:
        ArgumentError: The order exceeds that of the KOMO, or a size is wrong.
    """
    self.addControlObjective([] if times is None else times, order, scale, target, deltaFromSlice, deltaToSlice)


def getPath_qOrg(self: KOMO) -> NDArray[np.float64]:
    """Returns the joint vectors of all slices, shape (T, n), rad or m, like getPath."""
    return self.getPath()


def getReport(self: KOMO, *args: Any, **kwargs: Any) -> dict[str, Any]:
    """Returns the default result of report.

    Args:
        args, kwargs: Not used.
    Returns:
        A dict from the names of objectives to their costs and violations.
    """
    return self.report()


def getFeatureTypes(self: NLP) -> list[OT]:
    """Returns the OT of each residual, like getTypes."""
    return self.getTypes()


def setFeatureTypes(self: NLP_Factory, featureTypes: Sequence[OT]) -> None:
    """Sets the types of the residuals, like setTypes.

    Args:
        featureTypes: The OT of each residual.
    Raises:
        TypeError: A type is not an OT.
    """
    self.setTypes(featureTypes)


def getTrace_costs(self: NLP_Solver) -> NDArray[np.float64]:
    """Returns the sums of f, sos, ineq, eq per evaluation, shape (evaluations, 4), like getTrace_errs; setTracing(True)
    first."""
    return self.getTrace_errs()


def addStableFrame(
    self: KOMO,
    name: str | JT,
    parent: str,
    jointType: JT | str,
    stable: bool | str = True,
    initName: str | Frame | None = None,
    initFrame: str | Frame | None = None,
) -> Frame:
    """Adds a frame with a joint to all slices, like addFrameDof.

    Args:
        name, parent, jointType: Name, parent and joint type of the frame; or joint type, parent and name.
        stable: Whether the joint has the same values in all slices.
        initName, initFrame: Initial pose: the name of a frame, or a frame.
    Returns:
        A copy of the frame.
    Raises:
        FrameNotFound: A name is not in the scene.
    """
    if isinstance(name, JT):  # the order of 0.1.5 to 0.1.9: type, parent, name, initial frame
        if isinstance(stable, str):
            stable, initName = True, stable
        name, jointType = str(jointType), name
    if isinstance(initName, Frame) or isinstance(initFrame, str):
        initName, initFrame = initFrame, initName
    return self.addFrameDof(
        str(name), parent, cast(JT, jointType), bool(stable), cast(str, initName), cast(Frame, initFrame)
    )


def reportProblem(self: KOMO) -> None:
    """Prints the problem's size and objectives."""
    print(self.nlp().report(2))
    for name in self.info_objectiveNames():
        print(f"  {name}")


def enableAccumulatedCollisions(self: Skeleton, enable: bool = True) -> None:
    """Sets whether the motion avoids all collisions, like useBroadCollisions.

    Args:
        enable: False: only the pairs of addExplicitCollisions avoid collisions.
    """
    self.useBroadCollisions(enable)


def set_maxStep(self: NLP_SolverOptions, value: float) -> NLP_SolverOptions:
    """Sets the longest step, like set_stepMax.

    Args:
        value: See stepMax.
    Returns:
        The options.
    Raises:
        ArgumentError: The value is out of range.
    """
    return self.set_stepMax(value)


def set_maxLambda(self: NLP_SolverOptions, value: float) -> NLP_SolverOptions:
    """Sets the largest multiplier, like set_lambdaMax.

    Args:
        value: See lambdaMax.
    Returns:
        The options.
    Raises:
        ArgumentError: The value is out of range.
    """
    return self.set_lambdaMax(value)


_view_play = KOMO.view_play


def view_play(
    self: KOMO,
    pause: bool = False,
    txt: str | float | None = None,
    delay: float = 0.1,
    saveVideoPath: str | None = None,
) -> int:
    """Shows the path slice by slice on the page, as C.view_path.

    Args:
        pause: Wait for a key.
        txt: Text to show below the time; a number is the delay, as in 0.1.10, and a text behind it the path.
        delay: Time per slice, s.
        saveVideoPath: Prefix of files with a picture of each slice.
    Returns:
        The key, or 0.
    Raises:
        ArgumentError: A slice has no such frame, or a file cannot be written.
    """
    if isinstance(txt, (int, float)):
        if isinstance(delay, str):
            saveVideoPath = delay
        txt, delay = None, float(txt)
    return _view_play(self, pause, txt, delay, saveVideoPath)


def getLog_x(self: NLP_Solver) -> NDArray[np.float64]:
    """Returns the variables of each evaluation, shape (evaluations, n), like getTrace_x; setTracing(True) first."""
    return self.getTrace_x()


def getLog_costs(self: NLP_Solver) -> NDArray[np.float64]:
    """Returns the sums of f, sos, ineq, eq per evaluation, shape (evaluations, 4), like getTrace_errs; setTracing(True)
    first."""
    return self.getTrace_errs()


KOMO_METHODS = [setModel, add_qControlObjective, getPath_qOrg, getReport, addStableFrame, reportProblem, view_play]
