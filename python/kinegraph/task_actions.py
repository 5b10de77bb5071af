"""What the actions of planTask ask of a motion problem, and the ways in which each can be done."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ._core import FS, OT, ST, Config
from .errors import ArgumentError
from .task_domain import upOf
from .task_waypoints import Action, TaskWaypoints


class TaskRule:
    """An action of planTask: what it asks of the waypoints, and in which ways it can be done."""

    def __init__(
        self, add: Callable[[TaskWaypoints, float, Action, str], None], variants: Callable[[Config, Action], list[str]]
    ) -> None:
        """Makes a rule.

        Args:
            add: Called with the waypoint problem w, the time in phases, the action's words and a variant; adds what it
                asks: w.komo.addObjective, w.m (a KOMO_ManipulationHelper), w.attach(time, hand, obj),
                w.put(time, obj, place).
            variants: Called with the scene and the action's words; gives the names of its variants, best first.
        Raises:
            TypeError: By planTask: one of them does not take these arguments.
        """
        self.add, self.variants = add, variants


def palmOf(C: Config, hand: str) -> str:
    """The frame between the fingers of a hand and its arm, which nothing that is held comes into; '' for hands without one."""
    name = hand.removesuffix("gripper") + "palm"
    return name if name != hand and name in C.getFrameNames() else ""


def opening(C: Config, hand: str) -> float | None:
    """How far the fingers of a hand open, m; None for a hand without fingers.

    Args:
        C: The scene.
        hand: Name of the gripper frame; its frame may say `opening`.
    Returns:
        The width, or None.
    """
    said = C.getFrame(hand).getAttributes().get("opening")
    if said is not None:
        return float(said)
    return 0.08 if palmOf(C, hand) else None


def graspVariants(C: Config, obj: str, hand: str) -> list[str]:
    """The ways in which a hand can hold an object: axes of the object that the fingers close along, narrow ones first.

    Args:
        C: The scene.
        obj: Name of the object.
        hand: Name of the gripper frame.
    Returns:
        Of 'x', 'y', 'z' for boxes and meshes, 'around' for cylinders and capsules, 'center' for balls, and 'touch' for
        hands without fingers. Empty if it is too wide.
    """
    wide = opening(C, hand)
    if wide is None:
        return ["touch"]
    frame = C.getFrame(obj)
    kind, size = frame.getShapeType(), frame.getSize()
    if kind == ST.sphere:
        return ["center"] if 2 * size[-1] <= wide else []
    if kind in (ST.cylinder, ST.ssCylinder, ST.capsule):
        return ["around"] if 2 * size[1] <= wide else []
    widths = _widths(frame)
    axes = sorted((w, axis) for w, axis in zip(widths, "xyz", strict=True) if w <= wide)
    return [axis for _, axis in axes]


def _widths(frame: Any) -> list[float]:
    if frame.getShapeType() in (ST.box, ST.ssBox):
        return [float(s) for s in frame.getSize()[:3]]
    points = frame.getMeshPoints()
    if len(points) == 0:
        raise ArgumentError(f"planTask: object '{frame.name}' has no shape that can be grasped")
    return [float(w) for w in points.max(axis=0) - points.min(axis=0)]


def _grasp(w: TaskWaypoints, time: float, hand: str, obj: str, variant: str) -> None:
    palm = palmOf(w.C, hand)
    if palm:  # the farther inside, the less it turns in the hand
        w.komo.addObjective([time], FS.positionDiff, [hand, obj], OT.sos, [3e0])
    if variant == "touch":
        w.komo.addObjective([time], FS.distance, [obj, hand], OT.eq, [1e1])
    elif variant == "center":
        w.komo.addObjective([time], FS.positionDiff, [hand, obj], OT.eq, [1e1])
    elif variant == "around":
        size = w.C.getFrame(obj).getSize()
        w.m.grasp_cylinder(time, hand, obj, palm, min(0.02, 0.25 * size[0]))
    elif w.C.getFrame(obj).getShapeType() in (ST.box, ST.ssBox):
        w.m.grasp_box(time, hand, obj, palm, variant, min(0.02, 0.25 * min(w.C.getFrame(obj).getSize()[:3])))
    else:
        _grasp_hull(w, time, hand, obj, "xyz".index(variant))


def _grasp_hull(w: TaskWaypoints, time: float, hand: str, obj: str, axis: int) -> None:
    """Across a mesh: the fingers close along an axis of the box around its hull, inside of the other sides."""
    points = w.C.getFrame(obj).getMeshPoints()
    middle, half = 0.5 * (points.max(axis=0) + points.min(axis=0)), 0.5 * (points.max(axis=0) - points.min(axis=0))
    inside = half - np.minimum(0.02, 0.5 * half)
    rows, others = 1e1 * np.eye(3), [k for k in range(3) if k != axis]
    w.komo.addObjective([time], FS.positionRel, [hand, obj], OT.eq, rows[[axis]], middle)
    w.komo.addObjective([time], FS.positionRel, [hand, obj], OT.ineq, rows[others], middle + inside)
    w.komo.addObjective([time], FS.positionRel, [hand, obj], OT.ineq, -rows[others], middle - inside)
    products = [FS.scalarProductXX, FS.scalarProductXY, FS.scalarProductXZ]
    for other in others:
        w.komo.addObjective([time - 0.2, time], products[other], [hand, obj], OT.eq, [1e0])
    if palm := palmOf(w.C, hand):
        w.komo.addObjective([time - 0.3, time], FS.distance, [palm, obj], OT.ineq, [1e1], [-0.001])


def _take(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.attach(time, action[3], action[1])
    _grasp(w, time, action[3], action[1], variant)


def _place(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    if variant == "upright":
        w.put(time, action[1], action[3])
    else:
        w.lay(time, action[1], action[3], variant)


def _lay(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.lay(time, action[1], action[3], variant)


def _pose(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.komo.addObjective([time], FS.poseDiff, [action[1], action[3]], OT.eq, [1e1])


def _touch(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.attach(time, action[3], action[1], touching=True)


def _push(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    begun = [i for i, a in enumerate(w.actions[: round(time) - 1]) if a[0] == "push_start" and a[1] == action[1]]
    w.push(float(begun[-1] + 1), time, action[2], action[1], action[3])


def _faces(C: Config, action: Action) -> list[str]:
    return [action[4]] if C.getFrame(action[1]).getShapeType() in (ST.box, ST.ssBox) else []


def _stands(C: Config, action: Action) -> list[str]:
    """Upright, or a box with the face up that it has up already."""
    face = upOf(C, action[1])
    is_box = C.getFrame(action[1]).getShapeType() in (ST.box, ST.ssBox)
    return ["upright"] + ([face] if is_box and face not in ("", "z") else [])


UPRIGHT = TaskRule(_place, lambda C, a: ["upright"])  # where the goal says what is up
DEFAULT_RULES = {
    "pick": TaskRule(_take, lambda C, a: graspVariants(C, a[1], a[3])),
    "lift": TaskRule(_take, lambda C, a: graspVariants(C, a[1], a[3])),
    "place": TaskRule(_place, _stands),
    "lay": TaskRule(_lay, _faces),
    "push_start": TaskRule(_touch, lambda C, a: ["touch"]),
    "push_end": TaskRule(_push, lambda C, a: ["push"]),
    "pose": TaskRule(_pose, lambda C, a: ["held"]),
    "handover": TaskRule(_take, lambda C, a: graspVariants(C, a[1], a[3])),
}


def allVariants(C: Config, actions: list[Action], rules: dict[str, TaskRule]) -> Iterator[list[str]]:
    """All combinations of the variants of a sequence of actions, the first ones first.

    Args:
        C: The scene.
        actions: The sequence.
        rules: Of the actions.
    Yields:
        A variant per action.
    """
    lists = [rules[action[0]].variants(C, action) for action in actions]
    ranked = itertools.product(*(range(len(variants)) for variants in lists))
    for choice in sorted(itertools.islice(ranked, 4096), key=lambda c: (sum(c), c)):
        yield [variants[k] for variants, k in zip(lists, choice, strict=True)]
