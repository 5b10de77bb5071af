"""The waypoint problem of a sequence of actions: one KOMO, with grasps and placements that all slices share."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ._core import FS, JT, KOMO, OT, ST, Config, solveIk
from .manipulation import KOMO_ManipulationHelper
from .quaternion import Quaternion
from .task_domain import FACES, PICKS, PLACES, holderOf

if TYPE_CHECKING:
    from .task_actions import TaskRule

Action = list[str]

_GAP = 0.02  # m: how far things should stand apart that are put on the same place
_BEHIND = 0.01  # m: how far behind the middle of an object what pushes it is at least
_ROOM = "room on "
_EDGE = 0.01  # m: how far inside of an edge the center of what stands there is


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
        self.C, self.actions, self.variants = _withRoom(C, actions, variants), actions, variants
        self.m = KOMO_ManipulationHelper()
        self.m.setup_sequence(self.C, len(actions), 1e-2, 1e-2)
        self.slots = Slots()
        hands = [a[3] for a in actions if len(a) > 3] + [a[2] for a in actions if len(a) > 2]
        holders = {a[1]: holderOf(C, a[1], hands) for a in actions if a[1] in C.getFrameNames()}
        self.held: dict[str, str] = {obj: hand for obj, hand in holders.items() if hand}
        self.beside: dict[str, list[str]] = {}  # what was put on a place so far
        for i, (action, variant) in enumerate(zip(actions, variants, strict=True)):
            rules[action[0]].add(self, float(i + 1), action, variant)

    @property
    def komo(self) -> KOMO:
        return self.m.komo

    def attach(self, time: float, hand: str, obj: str, touching: bool = False) -> None:
        """From a time on the hand holds the object, in a pose that is found.

        Args:
            time: In phases.
            hand: The frame that holds, or pushes.
            obj: The object's frame.
            touching: Their surfaces touch, as where a stick takes something along.
        Raises:
            FrameNotFound: There is no such frame.
        """
        name = f"grasp_{hand}_{obj}_{round(time)}"
        self.m.add_stable_frame(JT.free, hand, name)
        self.slots.add("grasp", name, 7)
        self._switch(time, name, obj)
        if touching:
            self.komo.addObjective([time], FS.distance, [obj, hand], OT.eq, [1e1])

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
        for other in self.beside.setdefault(to, []):  # room for fingers, where there is room
            self.komo.addObjective([time], FS.distance, [obj, other], OT.ineqP, [3e0], [-_GAP])
        self.beside[to].append(obj)
        if self.C.getFrame(to).getJointType() == JT.rigid:  # on something small and loose the middle is safest
            self.komo.addObjective([time], FS.positionRel, [obj, to], OT.sos, 0.3 * rows)

    def lay(self, time: float, obj: str, to: str, face: str) -> None:
        """From a time on the object, a box, lies on a place with one of its faces up.

        Args:
            time: In phases.
            obj: The object's frame.
            to: The place's frame.
            face: Which axis of the object points up: x, y, z, xNeg, yNeg, zNeg.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: There is no such face, or a shape is no box.
        """
        name = f"place_{to}_{obj}_{round(time)}"
        self.m.add_stable_frame(JT.free, _ROOM + to, name)
        self.slots.add("lay " + face, name, 7)
        self._switch(time, name, obj)
        self.m.place_box(time, obj, to, "", face, min(_EDGE, 0.25 * min(self.C.getFrame(to).getSize()[:2])))

    def push(self, start: float, end: float, pusher: str, obj: str, to: str) -> None:
        """Between two times the object is pushed straight to a place, from behind, without turning.

        Args:
            start: In phases: when the pusher touched it.
            end: In phases: when the object is there.
            pusher: The frame that pushes.
            obj: The object's frame.
            to: The place's frame.
        Raises:
            FrameNotFound: There is no such frame.
        """
        helper = f"push_{pusher}_{obj}_{round(end)}"
        self.m.add_stable_frame(JT.hingeZ, obj, helper)
        self.slots.add("push", helper, 1)
        self.put(end, obj, to)
        self.komo.addObjective([end], FS.AlignYWithDiff, [helper, obj], OT.eq, [1e0], [], 1)
        self.komo.addObjective([end], FS.quaternion, [obj], OT.eq, [1e1], [], 1)
        self.komo.addObjective([start], FS.positionRel, [pusher, helper], OT.eq, [[1e1, 0, 0]])
        self.komo.addObjective([start], FS.positionRel, [pusher, helper], OT.ineq, [[0, 1e1, 0]], [0, -_BEHIND, 0])

    def _switch(self, time: float, frame: str, obj: str) -> None:
        held = self.held.get(obj)
        self.komo.addRigidSwitch(time, [frame, obj], False)
        frames, feature = ([obj, held], FS.poseRel) if held else ([obj], FS.pose)
        self.komo.addObjective([time], feature, frames, OT.eq, [1e1], [], 1)
        self.held[obj] = frame

    def start(self, rng: np.random.Generator | None, grasps: bool = True) -> np.ndarray:
        """A starting point: hands near what they do.

        Args:
            rng: Draws placements and grasps; None: placements are in the middle.
            grasps: Draws grasps, too.
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
            elif kind.startswith("lay "):
                x[first : first + 3] = [0.0, 0.0, 0.1] if rng is None else [*rng.uniform(-0.1, 0.1, 2), 0.1]
                x[first + 3 : first + 7] = _turned(kind.split()[1], 0.0 if rng is None else rng.uniform(-1.6, 1.6))
                where[name] = x[first : first + 2].copy()
            elif kind == "grasp":
                x[first : first + 7] = [0, 0, 0, 1, 0, 0, 0]
                if rng is not None and grasps:
                    x[first + 3 : first + 7] = rng.standard_normal(4)
                    x[first + 3 : first + 7] /= np.linalg.norm(x[first + 3 : first + 7])
        q, n = self.C.getJointState(), len(self.C.getJointState())
        at = {f.name: f.getPosition() for f in self.C.getFrames()}
        for i, action in enumerate(self.actions):
            hand, target = hand_and_target(action, at, where, i + 1)
            if hand is not None and target is not None:
                if action[0] in PLACES:
                    at[action[1]] = target
                q = _near(self.C, hand, target, q)
            x[self.slots.size + i * n : self.slots.size + (i + 1) * n] = q
        return x


def _withRoom(C: Config, actions: list[Action], variants: list[str]) -> Config:
    """The scene; where something is laid on a place, with a large frame there: a free frame below it has wide limits."""
    places = {a[3] for a, v in zip(actions, variants, strict=True) if v in FACES}
    if places:
        C = C.copy()
    for place in sorted(places):
        size = max(C.getFrame(place).getSize()[:2]) + 1.0
        C.addFrame(_ROOM + place, place).setShape(ST.box, [size, size, size]).setColor([1, 1, 1, 0]).setContact(0)
    return C


def hand_and_target(
    action: Action, at: dict[str, np.ndarray], where: dict[str, np.ndarray], time: int
) -> tuple[str | None, np.ndarray | None]:
    """Which hand goes where in an action, as far as it is known."""
    if action[0] in PICKS:
        return action[3], at.get(action[1])
    if action[0] in PLACES:
        offset = where.get(f"place_{action[3]}_{action[1]}_{time}", np.zeros(2))
        return action[2], at[action[3]] + [*offset, 0.05]
    return None, None


def _turned(face: str, about: float) -> np.ndarray:
    """The quaternion that turns an axis of an object up, then about that by an angle."""
    axis = (-1.0 if face.endswith("Neg") else 1.0) * np.eye(3)["xyz".index(face[0])]
    upright = Quaternion().setDiff(axis, [0, 0, 1]).asArr()
    turn = Quaternion().setRad(about, [0, 0, 1])
    return np.asarray((turn * Quaternion(upright)).asArr())


def _near(C: Config, hand: str, target: np.ndarray, q: np.ndarray) -> np.ndarray:
    D = C.copy()
    D.setJointState(q)
    for wanted in ({"position": target, "z": [0, 0, 1]}, {"position": target}):
        result = solveIk(D, {hand: wanted}, collisions=False, attempts=10)
        if result.feasible:
            return np.array(result.q)
    return q
