"""Inverse kinematics controlled in the browser."""

from __future__ import annotations

import os
import time

import numpy as np

from ._core import FS, KOMO, OT, ST, Config, NLP_Solver

_REACHED = [0.2, 0.7, 0.3, 0.6]
_MISSED = [0.9, 0.2, 0.2, 0.6]
_TOLERANCE = 1e-3  # m, rad
_QUIT = (13, 27, ord("q"))
_PERIOD = 1 / 60  # s
_PATIENCE = 5.0  # s without a browser, if no user can connect any more


def _approach(config: Config, frame: str, target: str, rotation: bool) -> tuple[float, float]:
    """Moves the frame as close to the target as possible; returns the remaining distance (m) and angle (rad)."""
    komo = KOMO(config, 1, 1, 0, False)
    komo.addObjective([], FS.jointState, [], OT.sos, [1e-2], config.getJointState())
    komo.addObjective([], FS.positionDiff, [frame, target], OT.sos, [1e1])
    if rotation:
        komo.addObjective([], FS.quaternionDiff, [frame, target], OT.sos, [1e1])
    NLP_Solver(komo.nlp(), verbose=0).solve()
    config.setJointState(komo.getPath()[0])
    one, other = config.getFrame(frame), config.getFrame(target)
    distance = float(np.linalg.norm(one.getPosition() - other.getPosition()))
    cosine = abs(float(np.dot(one.getQuaternion(), other.getQuaternion())))
    return distance, 2 * float(np.arccos(min(cosine, 1.0))) if rotation else 0.0


def interactiveIk(config: Config, frame: str, target: str = "ik_target", rotation: bool = False) -> np.ndarray:
    """Lets users drag a target in the browser; the joints move `frame` as close to it as possible.

    The target is green if reached and red otherwise, and the page shows the remaining error. The call ends with q,
    Enter or Escape in the browser, with Ctrl-C, or without a connected browser for 5 s. At a terminal and over ssh it
    prints the address and waits for the first browser. Without possible users (KINEGRAPH_HEADLESS is set), the joints
    move to the target once.

    Args:
        config: The scene; its joint state is updated.
        frame: Name of the moved frame.
        target: Name of the dragged frame; a missing one is created at the pose of `frame`.
        rotation: Whether to reach the target's rotation, too.
    Returns:
        The final joint state, shape (n,).
    """
    if target not in config.getFrameNames():
        ball = config.addFrame(target).setShape(ST.sphere, [0.04]).setColor(_REACHED)
        ball.setPose(config.getFrame(frame).getPose())
    viewer = config.viewer()
    moved, state = True, ""
    last_seen = time.monotonic()
    seen = False
    config.view()
    viewer.select(config.getFrame(target).ID)
    while True:
        if moved:
            distance, angle = _approach(config, frame, target, rotation)
            reached = distance < _TOLERANCE and angle < _TOLERANCE
            state = (
                f"{frame}: {1e3 * distance:.1f} mm" + (f", {angle:.3f} rad" if rotation else "") + " from the target"
            )
            config.getFrame(target).setColor(_REACHED if reached else _MISSED)
        key = config.view(False, f"{state}\ndrag the target; q: quit")
        if os.environ.get("KINEGRAPH_HEADLESS", "0") not in ("", "0"):
            break
        if viewer.clients() > 0:
            last_seen, seen = time.monotonic(), True
        alone = time.monotonic() - last_seen > _PATIENCE and (seen or not viewer.isPatient())
        if key in _QUIT or alone:
            break
        time.sleep(_PERIOD)
        moved = viewer.hasEdits()
        if moved and config.view() in _QUIT:  # takes over the dragged target
            break
    config.view(False, "")
    return config.getJointState()
