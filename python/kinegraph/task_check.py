"""An independent judge of plans: it knows the scene, the actions and the motion, and nothing of how they were found."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from ._core import FS, JT, Config
from .task_domain import PICKS, PLACES, carriedBy, wordsOf

if TYPE_CHECKING:
    from .task_plan import TaskPlan

_PENETRATION = 1e-3  # m
_DISTANCE = 1e-3  # m
_EDGE = 5e-3  # m: how far inside of the edges the center of what stands there is
_AWAY = np.cos(np.radians(30.0))  # of the motion of what is pushed, from what pushes it
_LEVEL = np.cos(np.radians(0.5))
_UPRIGHT = np.cos(np.radians(5.0))
STEADY = 2.0  # m/s^2: what only stands on something that is carried is accelerated by no more
_SHARE = 1e-6  # of a limit of velocity or acceleration: rounding


def checkTaskPlan(C: Config, plan: TaskPlan, states: list[list[str]] | None = None) -> list[str]:
    """Plays a plan in a copy of the scene: objects are taken along from where they are, never moved otherwise.

    Looked at: that the goal holds in logic after the last action; that the motion does not jump, is at rest where an action
    begins and ends, and keeps its limits of velocity and acceleration; that joints are within their limits and nothing
    overlaps by more than 1 mm, at all times and not only in samples (`Config.checkMotion`); that a hand touches what it
    takes, to 1 mm; that what is put down stands level to half a degree, at the height of its place to 1 mm, with its center
    5 mm inside the edges; that what stands on something that is carried tilts by less than 5 degrees and is
    accelerated by at most 2 m/s^2; that what is
    pushed moves straight and level, away from what pushes it; and that nothing that is at rest then overlaps.

    Args:
        C: The scene at the start; it is not changed.
        plan: With actions, path and times.
        states: What holds before and after each action, as of PlanSearch.states; None: logic is not looked at.
    Returns:
        What is wrong, a line each; empty if nothing is.
    """
    wrong: list[str] = []
    scene = C.copy()
    if states is not None:
        missing = [g for g in plan.goal if (g.rstrip("!") in states[-1]) == g.endswith("!")]
        wrong += [f"the goal {literal} does not hold after the last action" for literal in missing]
    ignored = _overlaps(scene)  # what the scene itself has
    q = scene.getJointState()
    pushed: dict[str, str] = {}
    for action, rows in zip(plan.actions, plan.segments, strict=True):
        text = f"({' '.join(action)})"
        path, times = plan.path[rows], plan.times[rows]
        broken = (
            _timing(path, times, q, plan.limits)
            or _contact(scene, path)
            or _slid(scene, path, action, pushed)
            or _shaken(scene, path, times, plan.start)
        )
        if broken:
            return [*wrong, f"{text}: {broken}"]
        q = path[-1]
        scene.setJointState(q)
        wrong += _happen(scene, action, text)
        if action[0] == "push_start":
            pushed[action[1]] = action[3]
        elif action[0] == "push_end":
            pushed.pop(action[1], None)
        wrong += [f"{text}: {a} and {b} overlap where they are left" for a, b in sorted(_overlaps(scene) - ignored)]
    return wrong + _turned(scene, plan.goal)


def _timing(path: np.ndarray, times: np.ndarray, q: np.ndarray, limits: np.ndarray | None) -> str:
    """What is wrong with the velocities and accelerations of a motion from rest to rest; they are those of its chords, which
    no motion that keeps the limits exceeds."""
    if abs(path[0] - q).max() > 1e-9:
        return "the motion jumps where it begins"
    steps = np.diff(times)
    if (steps < 0).any():
        return "time goes back"
    moves = steps > 0
    if abs(np.diff(path, axis=0)[~moves]).max(initial=0.0) > 1e-9:
        return "the motion jumps"
    if limits is None or not moves.any():
        return ""
    steps = steps[moves, None]
    velocity = np.diff(path, axis=0)[moves] / steps
    if (abs(velocity) > limits[0] * (1 + _SHARE)).any():
        return "a joint is faster than its limit"
    ends = [velocity[0] / (0.5 * steps[0]), velocity[-1] / (0.5 * steps[-1])]  # from rest, to rest
    changes = np.diff(velocity, axis=0) / (0.5 * (steps[1:] + steps[:-1]))
    if (abs(np.vstack([changes, ends])) > limits[1] * (1 + _SHARE)).any():
        return "a joint accelerates more than its limit"
    return ""


def _contact(scene: Config, path: np.ndarray) -> str:
    """What the straight motions between rows first run into."""
    corners = cornersOf(path)
    for a, b in itertools.pairwise(corners):
        contact = scene.checkMotion(a, b, margin=-_PENETRATION)
        if contact is not None and contact.limit is not None:
            return f"joint {contact.limit} is beyond its limits"
        if contact is not None:
            return f"{' and '.join(contact.frames)} overlap by {-contact.distance:.4f} m on the way"
    return ""


def _slid(scene: Config, path: np.ndarray, action: list[str], pushed: dict[str, str]) -> str:
    """What is wrong with how things that are touched move: only in a push, straight, away from what pushes, without turning
    or being lifted."""
    for obj, pusher in pushed.items():
        scene.setJointState(path[0])
        here, behind = scene.getFrame(obj).getPosition(), scene.getFrame(pusher).getPosition()
        scene.setJointState(path[-1])
        moved = scene.getFrame(obj).getPosition() - here
        if action[0] != "push_end" or action[1] != obj:
            rests = all(np.linalg.norm(p - here) <= _DISTANCE for p in _positions(scene, path, obj))
            if not rests:
                return f"'{obj}' moves, and is not pushed"
            continue
        if not slidesStraight(scene, path, obj):
            return f"'{obj}' does not slide straight"
        away, length = (here - behind) * [1, 1, 0], np.linalg.norm(moved)
        if length > _DISTANCE and away @ moved < _AWAY * np.linalg.norm(away) * length:
            return f"'{obj}' is not pushed from behind"
    return ""


def _positions(scene: Config, path: np.ndarray, frame: str) -> list[np.ndarray]:
    C, at = scene.copy(), []
    for q in path:
        C.setJointState(q)
        at.append(C.getFrame(frame).getPosition())
    return at


def slidesStraight(scene: Config, path: np.ndarray, obj: str) -> bool:
    """Whether an object moves on a level line to 1 mm, without going back or turning, as rows tell."""
    at = np.array(_positions(scene, path, obj))
    chord = at[-1] - at[0]
    length = max(float(np.linalg.norm(chord)), 1e-9)
    share = (at - at[0]) @ chord / length
    aside = np.linalg.norm(at - at[0] - share[:, None] * chord / length, axis=1).max()
    C, turns = scene.copy(), []
    C.setJointState(path[0])
    first = C.getFrame(obj).getRotationMatrix()
    for q in path:
        C.setJointState(q)
        turns.append(0.5 * (float(np.trace(first.T @ C.getFrame(obj).getRotationMatrix())) - 1.0))
    is_level = abs(at[:, 2] - at[0, 2]).max() <= _DISTANCE
    return bool(aside <= _DISTANCE and is_level and np.diff(share).min() > -_DISTANCE and min(turns) >= _LEVEL)


def _shaken(scene: Config, path: np.ndarray, times: np.ndarray, start: list[str]) -> str:
    """What only stands on something that a hand holds, and tilts or is accelerated too much; looked at in each row."""
    carried = carriedBy(scene, wordsOf(start, "is_gripper"), wordsOf(start, "is_object"))
    upright = {obj: scene.getFrame(obj).getRotationMatrix()[:, 2] for obj in carried}
    for q in path if carried else []:
        scene.setJointState(q)
        for obj, axis in upright.items():
            if scene.getFrame(obj).getRotationMatrix()[:, 2] @ axis < _UPRIGHT:
                return f"'{obj}' tilts on what carries it"
    for obj in carried:
        if accelerationOf(scene, path, times, obj) > STEADY:
            return f"'{obj}' is accelerated too much for what carries it"
    return ""


def accelerationOf(scene: Config, path: np.ndarray, times: np.ndarray, frame: str) -> float:
    """The largest acceleration of a frame in a motion that starts and ends at rest, m/s^2, as rows tell."""
    at = _positions(scene, path, frame)
    moves = np.diff(times) > 0
    steps = np.diff(times)[moves]
    velocity = np.diff(at, axis=0)[moves] / steps[:, None]
    if len(velocity) < 2:
        return 0.0
    changes = np.diff(velocity, axis=0) / (0.5 * (steps[1:] + steps[:-1]))[:, None]
    return float(np.linalg.norm(np.vstack([changes, 2 * velocity[[0, -1]] / steps[[0, -1], None]]), axis=1).max())


def isFree(scene: Config, path: np.ndarray) -> bool:
    """Whether the straight motions between rows overlap nowhere by more than 1 mm, at all times, and keep joint limits."""
    return not _contact(scene, path)


def cornersOf(path: np.ndarray) -> np.ndarray:
    """The rows of a path at which it turns, with its ends: those inside of a straight piece are left out."""
    if len(path) < 2:
        return path
    kept = [0]
    for row in range(1, len(path) - 1):
        chord, offset = path[row + 1] - path[kept[-1]], path[row] - path[kept[-1]]
        share = float(offset @ chord) / max(float(chord @ chord), 1e-300)
        if not 0.0 <= share <= 1.0 or abs(offset - share * chord).max() > 1e-10:
            kept.append(row)
    return path[[*kept, len(path) - 1]]


def _overlaps(scene: Config) -> set[tuple[str, str]]:
    return {(str(a), str(b)) for a, b, _ in scene.getCollisions(-_PENETRATION)}


def _happen(scene: Config, action: list[str], text: str) -> list[str]:
    """What an action changes in the scene, and what is wrong with it."""
    if action[0] in (*PICKS, "handover"):
        hand = action[3]
        wrong = _grasped(scene, action[1], hand, text)
        _hang(scene, action[1], hand)
        return wrong
    if action[0] == "push_start":
        wrong = _grasped(scene, action[1], action[3], text)
        _hang(scene, action[1], action[3])
        return wrong
    if action[0] in (*PLACES, "push_end"):
        _hang(scene, action[1], action[3])
        return _standing(scene, action[1], action[3], action[4] if action[0] == "lay" else "", text)
    if action[0] == "pose":
        return _posed(scene, action[1], action[3], text)
    return []


def _hang(scene: Config, obj: str, parent: str) -> None:
    scene.getFrame(obj).setParent(scene.getFrame(parent), True)
    scene.getFrame(obj).setJoint(JT.rigid)


def _grasped(scene: Config, obj: str, hand: str, text: str) -> list[str]:
    """The hand's frame is in the object, or touches it."""
    apart = -float(scene.eval(FS.distance, [obj, hand])[0][0])
    return [f"{text}: the hand is {apart:.4f} m away from what it takes"] if apart > _DISTANCE else []


def _share(axes: np.ndarray, face: str) -> float:
    """How far an axis (x, y, z, xNeg, ...) points up, of 1."""
    return float(axes["xyz".index(face[0])] * (-1.0 if face.endswith("Neg") else 1.0))


def _turned(scene: Config, goal: list[str]) -> list[str]:
    """What the goal says of faces, and is not so."""
    wrong = []
    for literal in goal:
        predicate, *words = literal.rstrip("!")[1:-1].split()
        if predicate == "up":
            is_up = _share(scene.getFrame(words[1]).getRotationMatrix()[2], words[0]) >= _LEVEL
            wrong += [] if is_up != literal.endswith("!") else [f"at the end {literal} does not hold"]
    return wrong


def _posed(scene: Config, obj: str, goal: str, text: str) -> list[str]:
    thing, wanted = scene.getFrame(obj), scene.getFrame(goal)
    apart = float(np.linalg.norm(thing.getPosition() - wanted.getPosition()))
    cosine = 0.5 * (float(np.trace(thing.getRotationMatrix().T @ wanted.getRotationMatrix())) - 1.0)
    if apart <= _DISTANCE and cosine >= _LEVEL:
        return []
    return [
        f"{text}: it is {apart:.4f} m and {np.degrees(np.arccos(np.clip(cosine, -1, 1))):.2f} degrees from the pose"
    ]


def _standing(scene: Config, obj: str, to: str, face: str, text: str) -> list[str]:
    thing, place = scene.getFrame(obj), scene.getFrame(to)
    wrong = []
    above = place.getRotationMatrix()[:, 2]
    axes = thing.getRotationMatrix().T @ above * np.sign(above[2])
    if abs(axes).max() < _LEVEL or (face and _share(axes, face) < _LEVEL):
        wrong.append(f"{text}: it does not stand level{f', with {face} up' if face else ''}")
    relative = place.getRotationMatrix().T @ (thing.getPosition() - place.getPosition())
    gap = -float(scene.eval(FS.distance, [obj, to])[0][0])
    if abs(gap) > _DISTANCE:
        wrong.append(f"{text}: it is {gap:.4f} m above its place")
    inside = 0.5 * np.array(place.getSize()[:2]) - abs(relative[:2])
    if inside.min() < min(_EDGE, 0.25 * min(place.getSize()[:2])) - 1e-6:
        wrong.append(f"{text}: its center is {inside.min():.4f} m inside the edge")
    return wrong
