"""An independent judge of plans: it knows the scene, the actions and the path, and nothing of how they were found."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from ._core import FS, JT, Config

if TYPE_CHECKING:
    from .tasks import TaskPlan

_PENETRATION = 1e-3  # m
_DISTANCE = 1e-3  # m
_STEP = 5e-3  # rad or m: between the configurations that are looked at
_EDGE = 5e-3  # m: how far inside of the edges the center of what stands there is
_LEVEL = np.cos(np.radians(0.5))


def checkTaskPlan(C: Config, plan: TaskPlan, states: list[list[str]] | None = None) -> list[str]:
    """Plays a plan in a copy of the scene: objects are taken along from where they are, never moved otherwise.

    Looked at: that the goal holds in logic after the last action; that joints are within their limits and do not jump;
    that nothing overlaps by more than 1 mm, every 5e-3 rad of the motion; that a hand touches what it takes, to 1 mm;
    that what is put down stands level to half a degree, at the height of its place to 1 mm, with its center 5 mm inside
    the edges.

    Args:
        C: The scene at the start; it is not changed.
        plan: With actions and path.
        states: What holds before and after each action, as of PlanSearch.states; None: logic is not looked at.
    Returns:
        What is wrong, a line each; empty if nothing is.
    """
    wrong: list[str] = []
    scene = C.copy()
    if states is not None:
        missing = [g for g in plan.goal if (g.rstrip("!") in states[-1]) == g.endswith("!")]
        wrong += [f"the goal {literal} does not hold after the last action" for literal in missing]
    q = scene.getJointState()
    limits = np.asarray(scene.getJointLimits()).reshape(2, -1)
    bounded = limits[0] < limits[1]
    for action, rows in zip(plan.actions, plan.segments, strict=True):
        text = f"({' '.join(action)})"
        for row in plan.path[rows]:
            if (row < limits[0] - 1e-3)[bounded].any() or (row > limits[1] + 1e-3)[bounded].any():
                return [*wrong, f"{text}: a joint is beyond its limits"]
            overlap = _overlap(scene, q, row)
            if overlap > _PENETRATION:
                return [*wrong, f"{text}: bodies overlap by {overlap:.4f} m on the way"]
            q = row
        scene.setJointState(q)
        wrong += _happen(scene, action, text)
    return wrong


def _overlap(scene: Config, start: np.ndarray, end: np.ndarray) -> float:
    """The most that bodies overlap between two configurations, m."""
    steps = max(1, int(np.ceil(abs(end - start).max() / _STEP)))
    worst = 0.0
    for k in range(1, steps + 1):
        scene.setJointState(start + k / steps * (end - start))
        worst = max(worst, float(scene.eval(FS.accumulatedCollisions, [])[0][0]))
    return worst


def overlapAlong(scene: Config, path: np.ndarray) -> float:
    """The most that bodies overlap along a path, looked at every 5e-3 rad, m."""
    scene = scene.copy()
    return max((_overlap(scene, a, b) for a, b in itertools.pairwise(path)), default=0.0)


def _happen(scene: Config, action: list[str], text: str) -> list[str]:
    """What an action changes in the scene, and what is wrong with it."""
    if action[0] in ("pick", "handover"):
        hand = action[3]
        wrong = _grasped(scene, action[1], hand, text)
        _hang(scene, action[1], hand)
        return wrong
    if action[0] == "place":
        _hang(scene, action[1], action[3])
        return _standing(scene, action[1], action[3], text)
    return []


def _hang(scene: Config, obj: str, parent: str) -> None:
    scene.getFrame(obj).setParent(scene.getFrame(parent), True)
    scene.getFrame(obj).setJoint(JT.rigid)


def _grasped(scene: Config, obj: str, hand: str, text: str) -> list[str]:
    """The hand's frame is in the object, or touches it."""
    apart = -float(scene.eval(FS.distance, [obj, hand])[0][0])
    return [f"{text}: the hand is {apart:.4f} m away from what it takes"] if apart > _DISTANCE else []


def _standing(scene: Config, obj: str, to: str, text: str) -> list[str]:
    thing, place = scene.getFrame(obj), scene.getFrame(to)
    wrong = []
    if abs(thing.getRotationMatrix()[:, 2] @ place.getRotationMatrix()[:, 2]) < _LEVEL:
        wrong.append(f"{text}: it does not stand level")
    relative = place.getRotationMatrix().T @ (thing.getPosition() - place.getPosition())
    gap = -float(scene.eval(FS.distance, [obj, to])[0][0])
    if abs(gap) > _DISTANCE:
        wrong.append(f"{text}: it is {gap:.4f} m above its place")
    inside = 0.5 * np.array(place.getSize()[:2]) - abs(relative[:2])
    if inside.min() < min(_EDGE, 0.25 * min(place.getSize()[:2])) - 1e-6:
        wrong.append(f"{text}: its center is {inside.min():.4f} m inside the edge")
    return wrong
