"""Motions of the actions of a plan: free of collisions at all times, within limits, at rest where an action ends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._core import FS, Config, MotionConstraint, MotionPlan, TimedPath, planMotion, retime, solveIk
from .task_actions import palmOf
from .task_check import STEADY, accelerationOf, isFree, slidesStraight
from .task_domain import PICKS, PLACES, carriedBy, holderOf, wordsOf
from .task_waypoints import Action

_BACK = 0.07  # m: a hand comes to what it takes, and leaves what it puts down, along its own axis
_UP = 0.04  # m: what is held is lifted first, and comes down to its place
_TURN = 0.8  # rad or m: a joint that would move farther than that on these few centimeters is led another way
_SAME = 1e-7  # rad or m: postures that differ by less are one
_PERIOD = 0.01  # s between two rows
_MARGIN = 0.01  # m, that motions keep where their ends do, and there is room
_HELD = 4.0  # m/s^2: what is held by friction is accelerated by no more
_BLEND = 0.05  # rad or m, by which corners may be missed
_SPEED_IN = 0.5  # s to full speed
_TRIES = 2
_SEARCH = 200000  # evaluations of one search for a way


@dataclass
class TimedRows:
    """A motion as rows, straight in between."""

    path: np.ndarray  # (T, n)
    times: np.ndarray  # (T,), s


class TaskMotions:
    """Finds the motions of actions, and counts what that takes."""

    def __init__(self, limits: np.ndarray, start: list[str], seed: int) -> None:
        """limits: most velocity and acceleration of each dof, shape (2, n). start: what holds at first."""
        self.limits, self.seed, self.evaluations = limits, seed, 0
        self.hands, self.objects = wordsOf(start, "is_gripper"), wordsOf(start, "is_object")

    def between(
        self, C: Config, q0: np.ndarray, q1: np.ndarray, action: Action, before: Action
    ) -> tuple[TimedRows | None, str]:
        """The motion of an action, or why there is none.

        Args:
            C: The scene, with what is held attached.
            q0: Joints where it starts.
            q1: Joints where it ends.
            action: What is done at its end.
            before: What was done at its start; [] if nothing was.
        """
        if action[0] == "push_end":
            return self._pushed(C, q0, q1, action[1])
        carried = carriedBy(C, self.hands, self.objects)
        level = [MotionConstraint(FS.vectorZ, [o], target=C.getFrame(o).getRotationMatrix()[:, 2]) for o in carried]
        if not level:
            head = self._piece(C, q0, self._leaving(C, q0, before))
            tail = self._piece(C, q1, self._leaving(C, q1, _coming(action)))
            way = self._way(C, head[-1], tail[-1]) if len(head) + len(tail) > 2 else None
            if way is not None and way.feasible:
                return self._steady(C, self._timed(C, np.vstack([head, way.path, tail[::-1]])), []), ""
        way = self._way(C, q0, q1, level)
        if not way.feasible:
            return None, f"no motion was found: {way.message}"
        return self._steady(C, self._timed(C, np.array(way.path)), carried), ""

    def _pushed(self, C: Config, q0: np.ndarray, q1: np.ndarray, obj: str) -> tuple[TimedRows | None, str]:
        """A straight motion of an object over what it stands on: the straight one of the joints, or one on that line."""
        if slidesStraight(C, np.linspace(q0, q1, 50), obj) and isFree(C, np.array([q0, q1])):
            return self._timed(C, np.array([q0, q1])), ""
        D = C.copy()
        ends = []
        for q in (q0, q1):
            D.setJointState(q)
            ends.append(D.getFrame(obj).getPosition())
        along = (ends[1] - ends[0]) / max(float(np.linalg.norm(ends[1] - ends[0])), 1e-9)
        aside = np.cross([0.0, 0.0, 1.0], along)
        R = D.getFrame(obj).getRotationMatrix()
        line = [
            MotionConstraint(FS.position, [obj], scale=np.array([aside, [0.0, 0.0, 1.0]]), target=ends[0]),
            MotionConstraint(FS.vectorX, [obj], target=R[:, 0]),
            MotionConstraint(FS.vectorZ, [obj], target=R[:, 2]),
        ]
        way = self._way(C, q0, q1, line)
        if not way.feasible:
            return None, f"no straight push was found: {way.message}"
        return self._timed(C, np.array(way.path)), ""

    def _way(
        self, C: Config, start: np.ndarray, goal: np.ndarray, level: list[MotionConstraint] | None = None
    ) -> MotionPlan:
        for margin in (_MARGIN, 0.0):
            way = planMotion(
                C,
                goal,
                start=start,
                tries=_TRIES,
                margin=margin,
                seed=self.seed,
                evaluations=_SEARCH if margin == 0.0 else _SEARCH // 10,
                constraints=level or [],
            )
            self.evaluations += sum(stage["evaluations"] for stage in way.stages)
            if way.feasible:
                break
        return way

    def _piece(self, C: Config, q: np.ndarray, away: np.ndarray | None) -> np.ndarray:
        """From q to a posture near it, if that is free; else q alone. The same is free the other way around."""
        if away is not None and abs(away - q).max() <= _TURN and isFree(C, np.array([q, away])):
            return np.array([q, away])
        return q[None]

    def _leaving(self, C: Config, q: np.ndarray, action: Action) -> np.ndarray | None:
        """Joints a few centimeters away from where an action was done: a hand that has put something down goes back, one
        that has taken something lifts it."""
        if not action or action[0] not in (*PICKS, *PLACES):
            return None
        hand = action[3] if action[0] in PICKS else action[2]
        palm = palmOf(C, hand)
        D = C.copy()
        D.setJointState(q)
        frame = D.getFrame(hand)
        pose = np.array(frame.getPose())
        if action[0] in PICKS:
            pose[2] += _UP
        elif palm:
            back = D.getFrame(palm).getPosition() - pose[:3]
            pose[:3] += _BACK * back / np.linalg.norm(back)
        else:
            return None
        result = solveIk(D, {hand: pose}, collisions=False, attempts=1)
        return np.array(result.q) if result.feasible else None

    def _steady(self, C: Config, rows: TimedRows, carried: list[str]) -> TimedRows:
        """The same motion, so slow that what is held does not slip, and what only stands on that stays there."""
        held = [obj for obj in self.objects if holderOf(C, obj, self.hands)]
        limits = {obj: STEADY / 1.01 if obj in carried else _HELD for obj in held}
        shares = [accelerationOf(C, rows.path, rows.times, obj) / most for obj, most in limits.items()]
        return TimedRows(rows.path, rows.times * np.sqrt(max([1.0, *shares])))

    def _timed(self, C: Config, postures: np.ndarray) -> TimedRows:
        kept = [0, *(k for k in range(1, len(postures)) if abs(postures[k] - postures[k - 1]).max() > _SAME)]
        kept[max(len(kept) - 1, 1) :] = [len(postures) - 1]  # it ends where the next motion begins
        for corners in ("blend", "stop"):
            timed = retime(
                C,
                postures[kept],
                self.limits[0],
                self.limits[1],
                corners=corners,
                tolerance=_BLEND,
                is_free=lambda points, _: isFree(C, points),
            )
            if not timed.feasible:
                continue
            rows = _rows(timed, postures)
            if isFree(C, rows.path):
                return rows
        return _rows(retime(C, postures[kept], self.limits[0], self.limits[1], corners="stop"), postures)


def _coming(action: Action) -> Action:
    """What leaves a place as an action comes there: who puts something down comes from above, who takes it along its axis."""
    if action[0] in PICKS:
        return ["place", action[1], action[3], action[2]]
    if action[0] in PLACES:
        return ["pick", action[1], action[3], action[2]]
    return []


def _rows(timed: TimedPath, postures: np.ndarray) -> TimedRows:
    """A motion in rows; the first and the last are those of the postures, to the bit."""
    count = int(np.ceil(timed.duration / _PERIOD)) + 1
    times = np.linspace(0.0, timed.duration, max(count, 2))
    path = np.array(timed.at(times)[0])
    path[[0, -1]] = postures[[0, -1]]
    return TimedRows(path, times)


def motionLimits(C: Config, velocity: Any, acceleration: Any) -> np.ndarray:
    """Most velocity and acceleration of each dof, shape (2, n): as given, else the model's velocities (1 where it says
    none), and accelerations that reach them in half a second."""
    model = np.asarray(C.getVelocityLimits(), float)
    model[~np.isfinite(model)] = 1.0
    v = np.broadcast_to(model if velocity is None else np.asarray(velocity, float), model.shape)
    a = np.broadcast_to(v / _SPEED_IN if acceleration is None else np.asarray(acceleration, float), model.shape)
    return np.array([v, a])
