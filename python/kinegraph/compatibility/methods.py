"""Methods by their earlier names, each in terms of those of today."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import JT, KOMO, ST, BotOp, CameraView, Config, Frame, NLP_Solver, Skeleton
from ..errors import ArgumentError
from . import bot_op


def getCollisionFree(self: Config) -> bool:
    """True if no pair of shapes that may collide overlaps; getCollisions lists those that do."""
    return not self.getCollisions()


def getTotalPenetration(self: Config) -> float:
    """Sum of all penetration depths (m), as coll_totalViolation."""
    return self.coll_totalViolation()


def getType(self: Frame) -> ST:
    """The type of its shape, as getShapeType.

    Returns:
        The type; ST.none where it has no shape.
    Raises:
        FrameDeleted: The frame is not there any more.
    """
    return self.getShapeType()


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


def getFxyCxy(self: CameraView) -> NDArray[np.float64]:
    """fx, fy, cx, cy in pixels, shape (4,), as getFxycxy."""
    return self.getFxycxy()


def addObject(
    self: Config,
    name: str,
    parent: str = "",
    shape: ST = ST.none,
    size: ArrayLike = (),
    color: ArrayLike = (),
    radius: float = -1.0,
    pos: ArrayLike = (),
    quat: ArrayLike = (),
) -> Frame:
    """Adds a frame with a shape, as addFrame, setShape and the other setters do one by one.

    Args:
        name, parent: Of the frame; no parent if empty.
        shape, size: As of setShape, m.
        color: (3,) or (4,), in [0, 1].
        radius: Of rounded shapes, m: becomes the last entry of size if positive.
        pos, quat: Relative to the parent, (3,) in m and (4,) w x y z.
    Returns:
        The frame.
    Raises:
        FrameNotFound: There is no such parent.
        ArgumentError: Sizes, a color or a pose of another shape.
    """
    frame = self.addFrame(name, parent)
    if shape != ST.none:
        numbers = list(np.atleast_1d(np.asarray(size, float)))
        frame.setShape(shape, [*numbers, radius] if radius > 0.0 else numbers)
    for numbers, local, world in (
        (pos, frame.setRelativePosition, frame.setPosition),
        (quat, frame.setRelativeQuaternion, frame.setQuaternion),
    ):
        if np.size(numbers):
            (local if parent else world)(numbers)
    return frame.setColor(color) if np.size(color) else frame


def view_setCamera(self: Config, *where: Any) -> None:
    """Looks from a camera frame, from a pose, or from a position at a target.

    Args:
        where: A frame or its name; (7,): x y z in m, qw qx qy qz, the camera's z forward; or two of (3,): where the
            camera is and where it looks, m.
    Raises:
        ArgumentError: It is none of these.
    """
    viewer = self.viewer()
    if len(where) == 1 and isinstance(where[0], (str, Frame)):
        return viewer.setCamera(where[0])
    sizes = [np.size(one) for one in where]
    if sizes == [7]:
        return viewer.setCameraPose(where[0])
    if sizes == [3, 3]:
        return viewer.setCamera(*where)
    raise ArgumentError(
        "view_setCamera: expected a frame or its name, a pose of 7 numbers, or a position and a target of 3 numbers each; "
        f"got {', '.join(repr(one) for one in where) or 'nothing'}"
    )


METHODS: dict[type, Sequence[Callable[..., Any]]] = {
    BotOp: bot_op.METHODS,
    CameraView: [getFxyCxy],
    Config: [addObject, getCollisionFree, getTotalPenetration, view_setCamera],
    Frame: [getType],
    KOMO: [addStableFrame, reportProblem],
    NLP_Solver: [getLog_x, getLog_costs],
    Skeleton: [enableAccumulatedCollisions],
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
