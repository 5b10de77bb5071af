"""Cheap tests that prove an action impossible, whatever comes before it: reach, size, room."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._core import JT, ST, Config
from .task_actions import graspVariants, opening
from .task_domain import PICKS
from .task_waypoints import Action

_TURNS = (JT.hingeX, JT.hingeY, JT.hingeZ, JT.hinge, JT.quatBall)
_SLIDES = {JT.transX: [0], JT.transY: [1], JT.transZ: [2], JT.transXY: [0, 1], JT.trans3: [0, 1, 2]}


@dataclass
class Impossible:
    """An action that is impossible where some facts hold, and why."""

    action: Action
    facts: str
    why: str


@dataclass
class Reach:
    """Where a frame can be at most: a box in the world, swept by a ball."""

    center: np.ndarray
    half: np.ndarray
    radius: float

    def distance(self, point: np.ndarray) -> float:
        """How far a point is outside, m; at most 0 where it may be inside."""
        if not np.isfinite(self.half).all():
            return -np.inf
        return float(np.linalg.norm(np.maximum(abs(point - self.center) - self.half, 0.0))) - self.radius


def reachOf(C: Config, name: str) -> Reach:
    """What a frame cannot leave, by the lengths and limits of what moves it.

    Args:
        C: The scene.
        name: Name of the frame.
    Returns:
        A box swept by a ball; infinite where something moves without limits.
    """
    reach = Reach(np.zeros(3), np.zeros(3), 0.0)
    frame = C.getFrame(name)
    while frame is not None:
        if frame.getJointType() not in (JT.none, JT.rigid):
            _through_joint(frame, reach)
        parent = frame.getParent()
        if parent is not None:
            R, p = _offset(C, frame)
            reach.center = R @ reach.center + p
            if np.isfinite(reach.half).all():
                reach.half = abs(R) @ reach.half
        frame = parent
    return reach


def _offset(C: Config, frame: Any) -> tuple[np.ndarray, np.ndarray]:
    """The pose of a frame in its parent where its joint is at zero."""
    D = C.copy()
    same = D.getFrame(frame.name)
    if same.getJointType() not in (JT.none, JT.rigid):
        q = np.zeros(len(same.getJointState()))
        if same.getJointType() == JT.quatBall:
            q[0] = 1.0
        if same.getJointType() == JT.free:
            q[3] = 1.0
        same.setJointState(q)
    R_parent = same.getParent().getRotationMatrix()
    return R_parent.T @ same.getRotationMatrix(), np.array(same.getRelativePosition())


def _through_joint(frame: Any, reach: Reach) -> None:
    kind = frame.getJointType()
    if kind in _SLIDES:
        limits = np.asarray(frame.asDict().get("limits", []), float)
        if limits.size != 2 * len(_SLIDES[kind]):
            reach.half = np.full(3, np.inf)
            return
        low, high = limits.reshape(2, -1)
        for k, axis in enumerate(_SLIDES[kind]):
            reach.center[axis] += 0.5 * (low[k] + high[k])
            reach.half[axis] += 0.5 * (high[k] - low[k])
    elif kind in _TURNS:
        reach.radius += float(np.linalg.norm(abs(reach.center) + reach.half))
        reach.center, reach.half = np.zeros(3), np.zeros(3)
    else:  # mobile bases and free joints have no bound
        reach.half = np.full(3, np.inf)


def _radius(C: Config, name: str) -> float:
    """Of a ball around a frame's origin that has its shape in it, m."""
    frame = C.getFrame(name)
    kind, size = frame.getShapeType(), frame.getSize()
    if kind in (ST.none, ST.marker):
        return 0.0
    if kind in (ST.box, ST.ssBox):
        return 0.5 * float(np.linalg.norm(size[:3]))
    if kind == ST.sphere:
        return float(size[-1])
    if kind in (ST.cylinder, ST.ssCylinder, ST.capsule):
        return float(np.hypot(0.5 * size[0], size[1]) + (size[1] if kind == ST.capsule else 0.0))
    points = frame.getMeshPoints()
    return float(np.linalg.norm(points, axis=1).max()) if len(points) else 0.0


def _beyond(C: Config, hand: str, target: str, room: float, reach: dict) -> float:
    """How far a frame is outside of what a hand can reach, m; at most 0 where it may be inside."""
    if hand not in reach:
        reach[hand] = reachOf(C, hand)
    return reach[hand].distance(C.getFrame(target).getPosition()) - room


def impossibleActions(C: Config, actions: list[Action]) -> list[Impossible]:
    """Default actions that no motion can carry out, found without any motion problem.

    Args:
        C: The scene.
        actions: All actions, as of PlanSearch.
    Returns:
        Those that are proved impossible, each with the facts under which it is.
    """
    found: list[Impossible] = []
    reach: dict = {}
    fixed = {f.name for f in C.getFrames() if f.getJointType() != JT.rigid}
    for action in actions:
        if action[0] in PICKS:
            found += _pick(C, action, reach, fixed)
        elif action[0] == "place" and action[3] in fixed:
            room = _radius(C, action[1]) + 0.5 * float(np.linalg.norm(C.getFrame(action[3]).getSize()[:3]))
            room += _radius(C, action[1]) + _radius(C, action[2])
            beyond = _beyond(C, action[2], action[3], room, reach)
            if beyond > 0:
                found.append(
                    Impossible(
                        action, "", f"'{action[3]}' is at least {beyond:.2f} m beyond the reach of '{action[2]}'"
                    )
                )
        elif action[0] == "handover" and not graspVariants(C, action[1], action[3]):
            found.append(Impossible(action, "", _too_wide(C, action[1], action[3])))
    return found + _room(C, [a for a in actions if a[0] == "place"])


def _pick(C: Config, action: Action, reach: dict, fixed: set[str]) -> list[Impossible]:
    _, obj, place, hand = action
    if not graspVariants(C, obj, hand):
        return [Impossible(action, "", _too_wide(C, obj, hand))]
    if place not in fixed:
        return []
    half = 0.5 * np.linalg.norm(C.getFrame(place).getSize()[:2])
    far = float(np.linalg.norm(C.getFrame(obj).getPosition() - C.getFrame(place).getPosition()))
    beyond = _beyond(C, hand, place, max(half, far) + 2 * _radius(C, obj) + _radius(C, hand), reach)
    return (
        [Impossible(action, "", f"'{place}' is at least {beyond:.2f} m beyond the reach of '{hand}'")]
        if beyond > 0
        else []
    )


def _too_wide(C: Config, obj: str, hand: str) -> str:
    return f"'{obj}' is wider than '{hand}' opens ({opening(C, hand):.3f} m) along all of its axes"


def _inner(C: Config, name: str) -> float | None:
    """Half of the least horizontal width of what stands upright, m; None if it is not known."""
    frame = C.getFrame(name)
    kind, size = frame.getShapeType(), frame.getSize()
    if kind in (ST.box, ST.ssBox):
        return 0.5 * float(min(size[:2]))
    if kind in (ST.cylinder, ST.ssCylinder, ST.capsule):
        return float(size[1])
    return float(size[-1]) if kind == ST.sphere else None


def _room(C: Config, places: list[Action]) -> list[Impossible]:
    """Two objects whose centers are on a place cannot be nearer than their inner radii, nor farther than its diagonal."""
    found: list[Impossible] = []
    onto: dict[str, list[str]] = {}
    for _, obj, _, to in places:
        if obj not in onto.setdefault(to, []):
            onto[to].append(obj)
    for to, objects in onto.items():
        diagonal = float(np.linalg.norm(C.getFrame(to).getSize()[:2]))
        for a, b in itertools.permutations(objects, 2):
            inner = (_inner(C, a), _inner(C, b))
            if (
                None in inner
                or sum(inner) <= diagonal
                or not all(C.getFrame(n).asDict().get("contact") for n in (a, b))
            ):
                continue
            first, second = sorted((a, b))
            why = f"'{first}' and '{second}' do not fit on '{to}' together: their centers are {sum(inner):.3f} m apart or more, and {diagonal:.3f} m at most there"
            found += [Impossible(act, f"(on {to} {b})", why) for act in places if act[1] == a and act[3] == to]
    return found
