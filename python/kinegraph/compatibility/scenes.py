"""Methods of scenes and frames by their earlier names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import KOMO, ST, Config, Frame
from ..errors import ArgumentError

if TYPE_CHECKING:  # numpy.typing takes half a millisecond
    from numpy.typing import ArrayLike, NDArray


def frame(self: Config, frameID: str | int, warnIfNotExist: bool = True) -> Frame:
    """Returns a frame, like getFrame.

    Args:
        frameID: Its name or id.
        warnIfNotExist: As in getFrame, for names.
    Returns:
        The frame.
    Raises:
        FrameNotFound: There is no such frame.
    """
    return self.getFrame(frameID, warnIfNotExist) if isinstance(frameID, str) else self[frameID]


def frames(self: Config) -> list[Frame]:
    """Returns all frames, in order, like getFrames."""
    return self.getFrames()


def evalFeature(
    self: Config,
    featureSymbol: Any,
    frames: Any = (),
    scale: ArrayLike | None = None,
    target: ArrayLike | None = None,
    order: int = -1,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Returns the value and the Jacobian of a feature, like eval.

    Args:
        featureSymbol, frames, scale, target, order: See eval.
    Returns:
        y, shape (d,), and J, shape (d, n).
    Raises:
        FrameNotFound: A name is not in the scene.
        ArgumentError: The number of frames or a size is wrong.
    """
    return self.eval(featureSymbol, list(frames) if isinstance(frames, tuple) else frames, scale, target, order)


def getDofIDs(self: Config) -> list[int]:
    """Returns the ids of the frames with active joints, like getJointIDs."""
    return self.getJointIDs()


def getCollisionsTotalPenetration(self: Config) -> float:
    """Returns the sum of all penetration depths (m), like coll_totalViolation."""
    return self.coll_totalViolation()


def computeCollisions(self: Config) -> None:
    """Does nothing: collisions always refer to the present q."""


def setJointStateSlice(self: Config, q: ArrayLike, t: int) -> None:
    """Always raises an error: a scene has no time slices; the message names the class that has them.

    Args:
        q, t: Not used.
    Raises:
        ArgumentError: Always.
    """
    raise ArgumentError(
        "setJointStateSlice: a Config has no time slices; those of a motion belong to its KOMO, "
        "and KOMO.initWithPath and KOMO.initWithConstant set them"
    )


def getForceArrays(self: Config) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Returns the pairs of frames with force exchanges, and their forces; a scene has none.

    Returns:
        Ids, shape (0, 2), and per pair the point of attack, force and torque, shape (0, 3, 3).
    """
    return np.zeros((0, 2), np.int32), np.zeros((0, 3, 3))


def komo_IK(self: Config, *args: Any, **kwargs: Any) -> KOMO:
    """Creates a KOMO of one slice with a cost on the distance from the present configuration.

    Args:
        args, kwargs: Not used.
    Returns:
        The KOMO.
    """
    return _pathProblem(self, 1.0, 1, 1.0, order=1)


def komo_path(
    self: Config, phases: float, stepsPerPhase: int = 20, timePerPhase: float = 5.0, *args: Any, **kwargs: Any
) -> KOMO:
    """Creates a KOMO of a path with a cost on accelerations.

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
    """Returns whether no collision pair overlaps; getCollisions lists overlapping pairs."""
    return not self.getCollisions()


def getTotalPenetration(self: Config) -> float:
    """Returns the sum of all penetration depths (m), like coll_totalViolation."""
    return self.coll_totalViolation()


def addObject(
    self: Config,
    name: str,
    parent: str = "",
    shape: ST = ST.none,
    size: ArrayLike = (),
    color: ArrayLike = (),
    radius: float | ArrayLike = -1.0,
    pos: ArrayLike = (),
    quat: ArrayLike = (),
) -> Frame:
    """Adds a frame with a shape, like addFrame, setShape and the other setters.

    Args:
        name, parent: Names of the frame and its parent; empty: no parent.
        shape, size: See setShape, m.
        color: (3,) or (4,), in [0, 1].
        radius: Radius of rounded shapes, m; if positive, it becomes the last entry of size. Three numbers are pos, as
            in scripts of 2019.
        pos, quat: Pose relative to the parent, (3,) in m and (4,) w x y z.
    Returns:
        The frame.
    Raises:
        FrameNotFound: There is no such parent.
        ArgumentError: A size, a color or a pose has a wrong shape.
    """
    if np.size(radius) == 3:
        radius, pos = -1.0, radius
    rounded = [float(np.asarray(radius))] if np.asarray(radius) > 0.0 else []
    frame = self.addFrame(name, parent)
    if shape != ST.none:
        numbers = list(np.atleast_1d(np.asarray(size, float)))
        frame.setShape(shape, [*numbers, *rounded])
    for numbers, local, world in (
        (pos, frame.setRelativePosition, frame.setPosition),
        (quat, frame.setRelativeQuaternion, frame.setQuaternion),
    ):
        if np.size(numbers):
            (local if parent else world)(numbers)
    return frame.setColor(color) if np.size(color) else frame


def info(self: Frame) -> dict[str, Any]:
    """Returns the frame's attributes as in a .g file, like asDict.

    Raises:
        FrameDeleted: The frame has been deleted.
    """
    return self.asDict()


def addAttributes(self: Frame, attributes: dict[str, Any]) -> Frame:
    """Sets attributes, like setAttributes.

    Args:
        attributes: Values by name.
    Returns:
        The frame itself.
    Raises:
        FrameDeleted: The frame has been deleted.
    """
    return self.setAttributes(attributes)


def addAttribute(self: Frame, key: str, value: Any) -> Frame:
    """Sets an attribute, like setAttribute.

    Args:
        key: Name of the attribute.
        value: A number, a string, a truth value, or a list of such values.
    Returns:
        The frame itself.
    Raises:
        FrameDeleted: The frame has been deleted.
    """
    return self.setAttribute(key, value)


def getType(self: Frame) -> ST:
    """Returns the type of the frame's shape, like getShapeType.

    Returns:
        The type; ST.none without a shape.
    Raises:
        FrameDeleted: The frame has been deleted.
    """
    return self.getShapeType()


def setDensity(self: Frame, density: float, size: ArrayLike | None = None) -> Frame:
    """Sets mass and inertia of the frame's shape, filled with a density.

    Args:
        density: kg/m^3.
        size: Of a grid of densities for pictures, as in 0.1.10 and 0.2.3, which cannot be drawn: it is refused.
    Returns:
        The frame.
    Raises:
        ArgumentError: The frame has no shape with a volume, or the density is not positive; or it is a grid.
    """
    if size is not None or np.size(density) != 1:
        raise ArgumentError(
            "Frame.setDensity: a grid of densities cannot be drawn; instead: frame.setImplicitSurface(data, size) draws "
            "the surface at which a grid changes its sign"
        )
    if not density > 0.0:
        raise ArgumentError(f"Frame.setDensity: the density is {density}; expected a number above 0")
    a, b, c = np.moveaxis(self.getMeshPoints()[self.getMeshTriangles()], 1, 0)
    volume = float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum()) / 6.0
    if not volume > 0.0:
        raise ArgumentError(f"Frame.setDensity: the shape of '{self.name}' has no volume")
    return self.setMass(density * volume)


_computeCompoundInertia = Frame.computeCompoundInertia


def computeCompoundInertia(self: Frame, clearChildInertias: bool = True) -> Frame:
    """Gathers the inertias of the frame and of all frames fixed below it in the frame; the others lose theirs.

    Args:
        clearChildInertias: False, as until 0.2.9, is refused: the masses would count twice.
    Returns:
        The frame itself.
    Raises:
        ArgumentError: clearChildInertias is False.
    """
    if not clearChildInertias:
        raise ArgumentError(
            "Frame.computeCompoundInertia: clearChildInertias is False, and masses would count twice; instead: call it "
            "on a copy of the scene, C.copy()"
        )
    return _computeCompoundInertia(self)


def simplify(
    self: Config, pruneNamed: bool = False, pruneNonContactNonMarker: bool = False, pruneTransparent: bool = False
) -> None:
    """Removes frames without which the links move alike, like processStructure(True, True, ...).

    Args:
        pruneNamed: Not used; frames with names are removed, too, if they only structure the tree.
        pruneNonContactNonMarker, pruneTransparent: Also removes leaves that never collide, or with an alpha below 1.
    """
    self.processStructure(True, True, pruneNonContactNonMarker, pruneTransparent)


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
    simplify,
]
FRAME_METHODS = [info, addAttributes, addAttribute, getType, setDensity, computeCompoundInertia]
