"""Methods of scenes and frames by their earlier names."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import KOMO, ST, Config, Frame
from ..errors import ArgumentError


def frame(self: Config, frameID: str | int) -> Frame:
    """A frame, as getFrame.

    Args:
        frameID: Its name or id.
    Returns:
        The frame.
    Raises:
        FrameNotFound: There is no such frame.
    """
    return self[frameID]


def frames(self: Config) -> list[Frame]:
    """All frames, in order, as getFrames."""
    return self.getFrames()


def evalFeature(
    self: Config,
    featureSymbol: Any,
    frames: Any = (),
    scale: ArrayLike | None = None,
    target: ArrayLike | None = None,
    order: int = -1,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The value and the Jacobian of a feature, as eval.

    Args:
        featureSymbol, frames, scale, target, order: As of eval.
    Returns:
        y, shape (d,), and J, shape (d, n).
    Raises:
        FrameNotFound: A name that is not in the scene.
        ArgumentError: Another number of frames than the feature takes, or sizes that do not fit.
    """
    return self.eval(featureSymbol, list(frames) if isinstance(frames, tuple) else frames, scale, target, order)


def getDofIDs(self: Config) -> list[int]:
    """Ids of the frames with active joints, as getJointIDs."""
    return self.getJointIDs()


def getCollisionsTotalPenetration(self: Config) -> float:
    """Sum of all penetration depths (m), as coll_totalViolation."""
    return self.coll_totalViolation()


def computeCollisions(self: Config) -> None:
    """Does nothing: collisions are always those of the present q."""


def setJointStateSlice(self: Config, q: ArrayLike, t: int) -> None:
    """A scene is a single moment and has no time slices: this always raises an error that says what has them.

    Args:
        q, t: Not used.
    Raises:
        ArgumentError: Always.
    """
    raise ArgumentError(
        "setJointStateSlice: a Config is a single moment and has no time slices; those of a motion belong to its KOMO, "
        "where KOMO.initWithPath and KOMO.initWithConstant set them"
    )


def getForceArrays(self: Config) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Pairs of frames that exchange forces, and their forces; a scene has none.

    Returns:
        Ids, shape (0, 2), and for each pair point of attack, force and torque, shape (0, 3, 3).
    """
    return np.zeros((0, 2), np.int32), np.zeros((0, 3, 3))


def komo_IK(self: Config, *args: Any, **kwargs: Any) -> KOMO:
    """A KOMO of one slice with a cost on leaving the present posture.

    Args:
        args, kwargs: Not used.
    Returns:
        The KOMO.
    """
    return _pathProblem(self, 1.0, 1, 1.0, order=1)


def komo_path(
    self: Config, phases: float, stepsPerPhase: int = 20, timePerPhase: float = 5.0, *args: Any, **kwargs: Any
) -> KOMO:
    """A KOMO of a path with a cost on accelerations.

    Args:
        phases: Number of phases.
        stepsPerPhase: Slices per phase.
        timePerPhase: Duration of a phase, s.
        args, kwargs: Not used.
    Returns:
        The KOMO.
    """
    return _pathProblem(self, phases, stepsPerPhase, timePerPhase, order=2)


def _pathProblem(config: Config, phases: float, slices: int, duration: float, order: int) -> KOMO:
    komo = KOMO()
    komo.setConfig(config)
    komo.setTiming(phases, slices, duration, order)
    komo.addControlObjective([], order, 0.1)
    komo.addQuaternionNorms()
    return komo


def getCollisionFree(self: Config) -> bool:
    """True if no pair of shapes that may collide overlaps; getCollisions lists those that do."""
    return not self.getCollisions()


def getTotalPenetration(self: Config) -> float:
    """Sum of all penetration depths (m), as coll_totalViolation."""
    return self.coll_totalViolation()


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


def info(self: Frame) -> dict[str, Any]:
    """What the frame is now, as the attributes of a .g file; the same as asDict.

    Raises:
        FrameDeleted: The frame is not there any more.
    """
    return self.asDict()


def addAttributes(self: Frame, attributes: dict[str, Any]) -> Frame:
    """Sets attributes, as setAttributes.

    Args:
        attributes: By name.
    Returns:
        The frame itself.
    Raises:
        FrameDeleted: The frame is not there any more.
    """
    return self.setAttributes(attributes)


def addAttribute(self: Frame, key: str, value: Any) -> Frame:
    """Sets an attribute, as setAttribute.

    Args:
        key: Its name.
        value: A number, a text, a truth value, or a list of such.
    Returns:
        The frame itself.
    Raises:
        FrameDeleted: The frame is not there any more.
    """
    return self.setAttribute(key, value)


def getType(self: Frame) -> ST:
    """The type of its shape, as getShapeType.

    Returns:
        The type; ST.none where it has no shape.
    Raises:
        FrameDeleted: The frame is not there any more.
    """
    return self.getShapeType()


CONFIG_METHODS = [
    frame,
    frames,
    evalFeature,
    getDofIDs,
    getCollisionsTotalPenetration,
    computeCollisions,
    setJointStateSlice,
    getForceArrays,
    komo_IK,
    komo_path,
    getCollisionFree,
    getTotalPenetration,
    addObject,
]
FRAME_METHODS = [info, addAttributes, addAttribute, getType]
