"""The poses of all frames of a scene in a recording."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from .._core import Config
from ..errors import KinegraphWarning
from ..quaternion import Quaternion
from .links import ROOT, frameNamed, isFree


def _place(scene: Config, names: set[str], parent: str, child: str, pose: Sequence[float]) -> bool:
    """Sets the pose of an object; joints move the other frames. Returns False if the scene does not have its parent."""
    name, above = frameNamed(names, child), frameNamed(names, parent)
    if not name or not isFree(scene, name):
        return True
    if parent == ROOT:
        scene.getFrame(name).setPose(pose)
        return True
    if not above:
        return False
    frame = scene.getFrame(above)
    rotation = Quaternion(frame.getQuaternion())
    position = frame.getPosition() + rotation.getMatrix() @ np.array(pose[:3])
    scene.getFrame(name).setPose([*position, *(rotation * Quaternion(pose[3:])).asArr()])
    return True


def _isFinger(scene: Config, name: str) -> bool:
    """Whether a joint that is no part of q has a value of its own."""
    frame = scene.getFrame(name, False)
    return frame is not None and "mimic" not in frame.getAttributes()


def movingJoints(config: Config, joints: Sequence[str]) -> tuple[list[str], list[str]]:
    """Returns those of some joints that are part of q, and those of fingers with a value of their own.

    Args:
        config: The scene.
        joints: Names of recorded joints, which the scene may lack.
    """
    in_q = [name for name in joints if name in config.getJointNames()]
    return in_q, [name for name in joints if name not in in_q and _isFinger(config, name)]


def framesOf(
    config: Config, joints: Sequence[str], states: Iterable[tuple[np.ndarray, Sequence[Any]]]
) -> list[np.ndarray]:
    """Returns the poses of all frames, one array per state. Warns of parents of objects that the scene does not have.

    Args:
        config: The scene, which does not change.
        joints: Names of the recorded joints; those that the scene does not have are left out.
        states: Values of these joints, and the transforms of tf2_msgs that changed since the last state.
    """
    scene = config.copy()
    names = set(scene.getFrameNames())
    in_q, fingers = movingJoints(scene, joints)
    columns = [joints.index(name) for name in in_q]
    found = []
    lost: dict[str, str] = {}
    for q, transforms in states:
        scene.setJointState(q[columns], in_q)
        for name in fingers:
            scene.setJointState([q[joints.index(name)]], [name])
        for stamped in transforms:
            at, turn = stamped.transform.translation, stamped.transform.rotation
            pose = [at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z]
            parent, child = str(stamped.header.frame_id), str(stamped.child_frame_id)
            if not _place(scene, names, parent, child, pose):
                lost.setdefault(parent, child)
        found.append(scene.getFrameState())
    for parent, child in lost.items():
        warnings.warn(
            f"Recording.frames: the pose of '{child}' was recorded in '{parent}', a frame that the scene does not have; "
            f"'{child}' was not moved. Add a frame '{parent}' to the scene",
            KinegraphWarning,
            3,
        )
    return found
