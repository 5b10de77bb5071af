"""Inverse kinematics that people steer in the browser."""

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
_PATIENCE = 5.0  # s without a browser, where nobody may still come


def _approach(config: Config, frame: str, target: str, rotation: bool) -> tuple[float, float]:
    """Moves the joints to where the frame is nearest to the target; returns what is left, m and rad."""
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
    """Lets people drag a target in the browser; the joints follow, so that `frame` comes as near to it as it can.

    The target is green while it is reached and red while it is not, and the page says what is missing. It ends with q,
    Enter or Escape in the browser, with Ctrl-C, or when no browser has been connected for 5 s; at a terminal and over
    ssh it waits for the first one, and has printed where. Where nobody can drag anything (KINEGRAPH_HEADLESS is set) the joints go to the target once.

    Args:
        config: The scene; its joint state follows.
        frame: Name of the frame that follows.
        target: Name of the frame that is dragged; made, where `frame` is now, if there is none.
        rotation: The rotation of the target is to be reached as well.
    Returns:
        The joint state in the end, shape (n,).
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
        if moved and config.view() in _QUIT:  # takes over where the target is
            break
    config.view(False, "")
    return config.getJointState()
