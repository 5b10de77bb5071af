"""The poses of all frames of a scene in a recording."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from .._core import JT, Config
from ..quaternion import Quaternion
from .links import ROOT


def _frameOf(scene: Config, link: str) -> Any:
    """The frame of a link, named as in the URDF of the scene; None if there is none."""
    frame = scene.getFrame(link, False)
    return scene.getFrame(link.removesuffix("_link"), False) if frame is None else frame


def _place(scene: Config, parent: str, child: str, pose: Sequence[float]) -> None:
    """Sets the pose of an object; joints move the other frames."""
    frame = _frameOf(scene, child)
    if frame is None or not (frame.getParent() is None or frame.getJointType() == JT.rigid):
        return
    above = None if parent == ROOT else _frameOf(scene, parent)
    if above is None:
        frame.setPose(pose)
        return
    rotation = Quaternion(above.getQuaternion())
    position = above.getPosition() + rotation.getMatrix() @ np.array(pose[:3])
    frame.setPose([*position, *(rotation * Quaternion(pose[3:])).asArr()])


def _isFinger(scene: Config, name: str) -> bool:
    """Whether a joint that is no part of q has a value of its own."""
    frame = scene.getFrame(name, False)
    return frame is not None and "mimic" not in frame.getAttributes()


def framesOf(
    config: Config, joints: Sequence[str], states: Iterable[tuple[np.ndarray, Sequence[Any]]]
) -> list[np.ndarray]:
    """Returns the poses of all frames, one array per state.

    Args:
        config: The scene, which does not change.
        joints: Names of the recorded joints; those that the scene does not have are left out.
        states: Values of these joints, and the transforms of tf2_msgs that changed since the last state.
    """
    scene = config.copy()
    in_q = [name for name in joints if name in config.getJointNames()]
    others = [name for name in joints if name not in in_q and _isFinger(scene, name)]
    columns = [joints.index(name) for name in in_q]
    found = []
    for q, transforms in states:
        scene.setJointState(q[columns], in_q)
        for name in others:
            scene.setJointState([q[joints.index(name)]], [name])
        for stamped in transforms:
            at, turn = stamped.transform.translation, stamped.transform.rotation
            pose = [at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z]
            _place(scene, str(stamped.header.frame_id), str(stamped.child_frame_id), pose)
        found.append(scene.getFrameState())
    return found
