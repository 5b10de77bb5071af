"""What the actions of planTask ask of a motion problem, and the ways in which each can be done."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._core import FS, JT, KOMO, OT, ST, Config, Domain, solveIk
from .errors import ArgumentError
from .manipulation import KOMO_ManipulationHelper

Action = list[str]

_EDGE = 0.01  # m: how far inside of an edge the center of what stands there is
_PENETRATION = 1e-3  # m

DEFAULT_FOL = """
is_gripper is_object is_place on busy
DecisionRule pick { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule place { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) }
  { (busy Hand)! (on Hand Obj)! (on To Obj) } }
DecisionRule handover { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_gripper To) (busy To)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (busy To) } }
"""


def defaultDomain() -> Domain:
    """The domain of planTask where none is given: pick (Obj From Hand), place (Obj Hand To), handover (Obj Hand To).

    Returns:
        A domain, to which actions can be added.
    """
    return Domain.fromFolText(DEFAULT_FOL, "default domain")


def sceneWords(C: Config, facts: list[str]) -> list[str]:
    """What holds at the start: the words of the scene and, where they name no gripper, no object or no place, what shapes
    and names suggest.

    Args:
        C: The scene.
        facts: Of sceneFacts.
    Returns:
        Literals.
    """
    said = list(facts)
    have = {fact[1:].split()[0] for fact in facts}
    frames = C.getFrames()
    boxes = (ST.box, ST.ssBox)
    if "is_gripper" not in have:
        said += [f"(is_gripper {f.name})" for f in frames if f.name.endswith("gripper")]
    grippers = {fact[1:-1].split()[1] for fact in said if fact.startswith("(is_gripper ")}
    objects = {fact[1:-1].split()[1] for fact in said if fact.startswith("(is_object ")}
    if "is_place" not in have:
        flat = [f for f in frames if f.getShapeType() in boxes and f.name not in grippers and _is_place(f, objects)]
        said += [f"(is_place {f.name})" for f in flat]
    on = {fact[1:-1].split()[2] for fact in said if fact.startswith("(on ")}
    for name in objects - on:  # it hangs below a frame of which nothing was said
        parent = C.getFrame(name).getParent()
        if parent is not None and f"(is_place {parent.name})" in said:
            said.append(f"(on {parent.name} {name})")
    return said


def _is_place(frame: Any, objects: set[str]) -> bool:
    """Large enough to carry something, level, and not a part of what moves."""
    if frame.name in objects:
        return True
    level = abs(frame.getRotationMatrix()[2, 2]) > 0.999
    up: Any = frame
    while up is not None:
        if up.getJointType() not in (JT.none, JT.rigid):
            return False
        up = up.getParent()
    return level and min(frame.getSize()[:2]) >= 0.05


@dataclass
class Slots:
    """Where the dofs of added frames are in x, which has them first."""

    kinds: list[tuple[str, int, str]] = field(default_factory=list)  # what, first, frame
    size: int = 0

    def add(self, kind: str, name: str, count: int) -> None:
        self.kinds.append((kind, self.size, name))
        self.size += count


class TaskWaypoints:
    """The waypoint problem of a sequence of actions, in one variant of each: a slice per action."""

    def __init__(self, C: Config, actions: list[Action], variants: list[str], rules: dict[str, TaskRule]) -> None:
        """Makes the problem; planTask does.

        Args:
            C: The scene.
            actions: The words of each action.
            variants: In which way each is done.
            rules: What actions ask, by their first words.
        Raises:
            KeyError: An action has no rule.
        """
        self.C, self.actions, self.variants = C, actions, variants
        self.m = KOMO_ManipulationHelper()
        self.m.setup_sequence(C, len(actions), 1e-2, 1e-2)
        self.slots = Slots()
        self.held: dict[str, str] = {}
        for i, (action, variant) in enumerate(zip(actions, variants, strict=True)):
            rules[action[0]].add(self, float(i + 1), action, variant)

    @property
    def komo(self) -> KOMO:
        return self.m.komo

    def attach(self, time: float, hand: str, obj: str) -> None:
        """From a time on the hand holds the object, in a pose that is found.

        Args:
            time: In phases.
            hand: The frame that holds.
            obj: The object's frame.
        Raises:
            FrameNotFound: There is no such frame.
        """
        name = f"grasp_{hand}_{obj}_{round(time)}"
        self.m.add_stable_frame(JT.free, hand, name)
        self.slots.add("grasp", name, 7)
        self._switch(time, name, obj)

    def put(self, time: float, obj: str, to: str) -> None:
        """From a time on the object stands on a place, upright.

        Args:
            time: In phases.
            obj: The object's frame.
            to: The place's frame.
        Raises:
            FrameNotFound: There is no such frame.
        """
        name = f"place_{to}_{obj}_{round(time)}"
        self.m.add_place_frame(to, obj, name)
        self.slots.add("place", name, 3)
        self._switch(time, name, obj)
        half = 0.5 * np.array(self.C.getFrame(to).getSize()[:2])
        inside = np.maximum(half - _EDGE, 0.5 * half)
        rows = np.array([[1e1, 0, 0], [0, 1e1, 0]])
        bound = [inside[0], inside[1], 0.0]
        self.komo.addObjective([time], FS.positionRel, [obj, to], OT.ineq, rows, bound)
        self.komo.addObjective([time], FS.positionRel, [obj, to], OT.ineq, -rows, [-b for b in bound])

    def _switch(self, time: float, frame: str, obj: str) -> None:
        held = self.held.get(obj)
        self.komo.addRigidSwitch(time, [frame, obj], False)
        frames, feature = ([obj, held], FS.poseRel) if held else ([obj], FS.pose)
        self.komo.addObjective([time], feature, frames, OT.eq, [1e1], [], 1)
        self.held[obj] = frame

    def start(self, rng: np.random.Generator | None) -> np.ndarray:
        """A starting point: hands near what they do.

        Args:
            rng: Draws placements and grasps; None: placements are in the middle.
        Returns:
            The variables of the problem, shape (n,).
        """
        x = np.array(self.m.x)
        lower, upper = np.asarray(self.komo.nlp().getBounds())
        where: dict[str, np.ndarray] = {}
        for kind, first, name in self.slots.kinds:
            if kind == "place":
                span = slice(first, first + 2)
                x[span] = rng.uniform(0.9 * lower[span], 0.9 * upper[span]) if rng is not None else 0.0
                x[first + 2] = rng.uniform(-1.6, 1.6) if rng is not None else 0.0
                where[name] = x[span].copy()
            elif kind == "grasp":
                x[first : first + 7] = [0, 0, 0, 1, 0, 0, 0]
                if rng is not None:
                    x[first + 3 : first + 7] = rng.standard_normal(4)
                    x[first + 3 : first + 7] /= np.linalg.norm(x[first + 3 : first + 7])
        q, n = self.C.getJointState(), len(self.C.getJointState())
        at = {f.name: f.getPosition() for f in self.C.getFrames()}
        for i, action in enumerate(self.actions):
            hand, target = hand_and_target(action, at, where, i + 1)
            if hand is not None and target is not None:
                if action[0] == "place":
                    at[action[1]] = target
                q = _near(self.C, hand, target, q)
            x[self.slots.size + i * n : self.slots.size + (i + 1) * n] = q
        return x


def hand_and_target(
    action: Action, at: dict[str, np.ndarray], where: dict[str, np.ndarray], time: int
) -> tuple[str | None, np.ndarray | None]:
    """Which hand goes where in an action, as far as it is known."""
    if action[0] == "pick":
        return action[3], at.get(action[1])
    if action[0] == "place":
        offset = where.get(f"place_{action[3]}_{action[1]}_{time}", np.zeros(2))
        return action[2], at[action[3]] + [*offset, 0.05]
    return None, None


def _near(C: Config, hand: str, target: np.ndarray, q: np.ndarray) -> np.ndarray:
    D = C.copy()
    D.setJointState(q)
    for wanted in ({"position": target, "z": [0, 0, 1]}, {"position": target}):
        result = solveIk(D, {hand: wanted}, collisions=False, attempts=10)
        if result.feasible:
            return np.array(result.q)
    return q


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


def _palm(C: Config, hand: str) -> str:
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
    return 0.08 if _palm(C, hand) else None


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
    palm = _palm(w.C, hand)
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
    if palm := _palm(w.C, hand):
        w.komo.addObjective([time - 0.3, time], FS.distance, [palm, obj], OT.ineq, [1e1], [-0.001])


def _pick(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.attach(time, action[3], action[1])
    _grasp(w, time, action[3], action[1], variant)


def _handover(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.attach(time, action[3], action[1])
    _grasp(w, time, action[3], action[1], variant)


def _place(w: TaskWaypoints, time: float, action: Action, variant: str) -> None:
    w.put(time, action[1], action[3])


DEFAULT_RULES = {
    "pick": TaskRule(_pick, lambda C, a: graspVariants(C, a[1], a[3])),
    "place": TaskRule(_place, lambda C, a: ["upright"]),
    "handover": TaskRule(_handover, lambda C, a: graspVariants(C, a[1], a[3])),
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
