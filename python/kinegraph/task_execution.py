"""Plans carried out by a robot, action by action, with a look at the world after each motion and each grip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import FS, JT, Config, doorStates, holderOf
from .errors import ArgumentError
from .task_domain import GUIDED, PICKS, PLACES, wordsOf

if TYPE_CHECKING:
    from .task_plan import Action, TaskPlan

_SLIP = 0.02  # m: by which what is held may move in the hand
_OFF = 0.03  # m: by which what stands somewhere may be off its place
_LEVEL = np.cos(np.radians(10.0))
_EMPTY = 2e-3  # m: a gripper that closes farther than that holds nothing
_TOUCH = 5e-3  # m: what is nearer than that to a place stands on it
_OVERLAP = 1e-3  # m: more than that is in the way of a motion
_TIMEOUT = 3.0  # s for a gripper
_REST = 0.3  # s for things to come to rest
_FORCE = 40.0  # N
_SLOWLY = 3.0  # times longer than it came, a robot goes back
_FAR = 0.05  # rad or m: by which a robot may be off where a motion begins or ends


@dataclass
class TaskExecution:
    """How far a robot came with a plan.

    feasible: all actions were carried out, and what the goal says stands where it says. message: why it stopped. done: the
    number of actions that were carried out. C: the scene as it is then: what is held hangs below the hand, what stands on
    something below that.
    """

    feasible: bool
    message: str
    done: int
    C: Config

    def __str__(self) -> str:
        return f"{'reached the goal' if self.feasible else 'stopped'} after {self.done} actions: {self.message}"


TaskExecution.__init__.__doc__ = "Initialize self: TaskPlan.execute does."


def execute(plan: TaskPlan, bot: Any) -> TaskExecution:
    """Carries out a plan; see TaskPlan.execute."""
    run = _Run(plan, bot)
    for number, action in enumerate(plan.actions):
        why = (
            run.look(number, 0) or run.move(number) or run.look(number, -1) or run.grip(action) or run.look(number, -1)
        )
        if why:
            run.back(number)
            return TaskExecution(False, f"({' '.join(action)}): {why}", number, run.scene())
    scene = run.scene()
    missed = [g for g in plan.goal if g.startswith("(on ") and not _stands(scene, g)]
    missed += run.missedDoors()
    if missed:
        return TaskExecution(False, f"{', '.join(missed)} does not hold", len(plan.actions), scene)
    return TaskExecution(True, f"all of {len(plan.actions)}", len(plan.actions), scene)


class _Run:
    """One execution: the world as it is seen, and which hand holds what."""

    def __init__(self, plan: TaskPlan, bot: Any) -> None:
        self.plan, self.bot = plan, bot
        self.seen: Config = bot.getWorld()
        self.hands, self.objects = wordsOf(plan.start, "is_gripper"), wordsOf(plan.start, "is_object")
        self.places = wordsOf(plan.start, "is_place")
        self.grippers = {info.name: (number, info) for number, info in enumerate(bot.getInfo().grippers)}
        holders = {obj: holderOf(plan.scenes[0], obj, self.hands) for obj in self.objects} if plan.scenes else {}
        self.held = {obj: hand for obj, hand in holders.items() if hand}
        self.handles: dict[str, str] = {}  # that are held, and by which hand
        names = self.seen.getJointNames()
        self.doors = {door: names.index(door) for door in wordsOf(plan.start, "is_guided")}
        self.driven = np.array([k for k in range(len(names)) if k not in self.doors.values()], dtype=int)
        self._begin()

    def _begin(self) -> None:
        for action in self.plan.actions:
            if action[1] in self.objects and self.seen.getFrame(action[1]).getMass() <= 0.0:
                raise ArgumentError(
                    f"execute: '{action[1]}' has no mass, so that it stays where it is in the simulated world; call "
                    f"C.getFrame('{action[1]}').setMass(...) before BotOp(C)"
                )
            for door in self.doors:
                below = {frame.name for frame in self.seen.getFrame(door).getSubtree()}
                if action[1] in self.objects and action[1] in below:
                    raise ArgumentError(
                        f"execute: '{action[1]}' hangs below '{door}', so that it is a part of it in the simulated world; "
                        f"call C.getFrame('{action[1]}').unLink() before BotOp(C)"
                    )
            if action[0] in GUIDED and not self.seen.getFrame(action[1]).getAttributes().get("noMotor", False):
                raise ArgumentError(
                    f"execute: a motor moves '{action[1]}' in the simulated world; give its frame the attribute noMotor "
                    "before BotOp(C), so that a hand can"
                )
        if self.plan.actions and self._late(self.plan.path[0]).max() > _FAR:
            raise ArgumentError("execute: the robot is not where the plan begins; go there first, or plan from there")
        self.bot.hold()
        for hand, (number, info) in self.grippers.items():
            if hand not in self.held.values() and self.bot.getGripperPos(number) < 0.9 * info.max_width:
                self._open(hand)

    def _late(self, q: np.ndarray) -> np.ndarray:
        """By how much each joint of the robot is not at q; doors are no part of it."""
        late: np.ndarray = abs(self.bot.get_q() - q)[self.driven]
        return late

    def missedDoors(self) -> list[str]:
        """What the goal says of doors, and is not so."""
        states = doorStates(self.seen)
        now = {f"({state} {door})" for door, state in states.items()}
        asked = [g for g in self.plan.goal if g.startswith(("(opened ", "(closed "))]
        return [g for g in asked if (g.rstrip("!") in now) == g.endswith("!")]

    def move(self, number: int) -> str:
        """The motion of an action; '' when it is over."""
        rows = self.plan.segments[number]
        path, times = self.plan.path[rows], self.plan.times[rows] - self.plan.times[rows][0]
        if times[-1] > 0.0:
            self.bot.move(path[1:], times[1:])
            self.bot.wait(self.seen, forKeyPressed=False)
        self.bot.sync(self.seen, _REST)
        return ""

    def back(self, number: int) -> None:
        """After a failure: opens hands that have lost what they held, and goes out of what is in the way, along the motion by
        which the robot came."""
        for obj, hand in list(self.held.items()):
            if not self._touches(hand, obj):
                del self.held[obj]
                self._open(hand, obj)
        for handle, hand in list(self.handles.items()):
            self._release(handle, hand)
        rows = self.plan.segments[number]
        path, times = self.plan.path[rows].copy(), self.plan.times[rows]
        for dof in self.doors.values():
            path[:, dof] = self.bot.get_q()[dof]
        if self.plan.actions[number][0] in GUIDED or self._late(path[-1]).max() > _FAR:
            return
        C = self.scene()
        free = next((k for k in range(len(path) - 1, -1, -1) if _is_clear(C, path[k])), len(path) - 1)
        if free < len(path) - 1:
            self.bot.move(path[free:-1][::-1], _SLOWLY * (times[-1] - times[free:-1])[::-1])
            self.bot.wait(self.seen, forKeyPressed=False)

    def grip(self, action: Action) -> str:
        """Takes or releases what the action is about; says what went wrong."""
        obj, why = action[1], ""
        if action[0] in (*PICKS, "handover"):
            why = self._close(action[3], obj)
        if action[0] == "handover" and not why:
            self._open(action[2], obj)
        if action[0] in (*PICKS, "handover"):
            self.held[obj] = action[3]
        if action[0] == "hold":
            self.handles[action[2]] = action[3]
            why = self._close(action[3], action[2])
        if action[0] in GUIDED:
            self._release(action[2], action[3])
        if action[0] in PLACES:
            self._open(action[2], obj)
            self.held.pop(obj, None)
        self.bot.sync(self.seen, _REST)
        return why

    def _release(self, handle: str, hand: str) -> None:
        self._open(hand, handle)
        self.handles.pop(handle, None)

    def _close(self, hand: str, obj: str) -> str:
        if hand not in self.grippers:
            self.bot.attach(hand, obj)
            return ""
        number, info = self.grippers[hand]
        self.bot.gripperCloseGrasp(number, obj, force=min(_FORCE, info.max_force))
        self._wait(number)
        width = self.bot.getGripperPos(number)
        return f"'{hand}' closed on nothing" if width < info.min_width + _EMPTY else ""

    def _open(self, hand: str, obj: str = "") -> None:
        if hand in self.grippers:
            number, info = self.grippers[hand]
            self.bot.gripperMove(number, info.max_width)
            self._wait(number)
        elif obj:
            self.bot.detach(hand, obj)

    def _wait(self, number: int) -> None:
        for _ in range(round(_TIMEOUT / 0.05)):
            self.bot.sync(self.seen, 0.05)
            if self.bot.gripperDone(number):
                return

    def look(self, number: int, row: int) -> str:
        """What is not where the plan has it at a row of an action's motion, the first or the last one."""
        planned = self.plan.scenes[number].copy()
        planned.setJointState(self.plan.path[self.plan.segments[number]][row])
        late = self._late(planned.getJointState())
        if late.max() > _FAR:
            joint = planned.getJointNames()[self.driven[int(late.argmax())]]
            return f"the robot is held up: joint '{joint}' is {late.max():.3f} off"
        for door, dof in self.doors.items():
            off = abs(self.seen.getJointState()[dof] - planned.getJointState()[dof])
            if off > _FAR:
                return f"'{door}' is {off:.3f} (m or rad) away from where it should be"
        for obj in self.objects:
            is_, shall = self.seen.getFrame(obj), planned.getFrame(obj)
            hand = self.held.get(obj)
            if hand is not None:
                off = _within(self.seen, hand, obj) - _within(planned, hand, obj)
                if np.linalg.norm(off) > _SLIP:
                    return f"'{obj}' is not in '{hand}': it is {np.linalg.norm(off):.3f} m off"
                continue
            off = np.linalg.norm(is_.getPosition() - shall.getPosition())
            if off > _OFF:
                return f"'{obj}' is {off:.3f} m away from where it should be"
            if is_.getRotationMatrix()[:, 2] @ shall.getRotationMatrix()[:, 2] < _LEVEL:
                return f"'{obj}' has tilted"
        return ""

    def _touches(self, hand: str, obj: str) -> bool:
        return -float(self.seen.eval(FS.distance, [obj, hand])[0][0]) <= _TOUCH

    def scene(self) -> Config:
        """The world as it is seen, with what is held below the hand, and what stands on something below that."""
        C = self.seen.copy()
        for obj, hand in self.held.items():
            if self._touches(hand, obj):
                _hang(C, obj, hand)
        for obj in sorted(set(self.objects), key=lambda o: C.getFrame(o).getPosition()[2]):
            under = "" if holderOf(C, obj, self.hands) else _below(C, obj, [p for p in self.places if p != obj])
            if under:
                _hang(C, obj, under)
        return C


def _is_clear(C: Config, q: np.ndarray) -> bool:
    C.setJointState(q)
    return not C.getCollisions(-_OVERLAP)


def _within(C: Config, hand: str, obj: str) -> np.ndarray:
    frame = C.getFrame(hand)
    return np.asarray(frame.getRotationMatrix().T @ (C.getFrame(obj).getPosition() - frame.getPosition()))


def _hang(C: Config, obj: str, parent: str) -> None:
    C.getFrame(obj).setParent(C.getFrame(parent), True)
    C.getFrame(obj).setJoint(JT.rigid)


def _below(C: Config, obj: str, places: list[str]) -> str:
    """The place that an object stands on: the nearest one of those that it touches and whose middle is lower."""
    height = C.getFrame(obj).getPosition()[2]
    gaps = [
        (abs(float(C.eval(FS.distance, [obj, place])[0][0])), place)
        for place in places
        if C.getFrame(place).getPosition()[2] < height
    ]
    gap, place = min(gaps, default=(np.inf, ""))
    return place if gap <= _TOUCH else ""


def _stands(C: Config, literal: str) -> bool:
    """Whether an object hangs below what a literal `(on place object)`, or its negation, says."""
    _, place, obj = literal.rstrip("!")[1:-1].split()
    parent = C.getFrame(obj).getParent()
    return (parent is not None and parent.name == place) != literal.endswith("!")
