"""Measures planTask on families of manipulation problems.

    python benchmarks/tasks.py [--threads 2] [--families tower,crowded] [--seeds 5] [--first 0] [--evaluations 200000]

A family generates a scene for each seed, such that a plan exists by construction, or none exists. The hand is a gantry,
a frame with three sliding joints whose limits are its reach. The table has the number of seeds with the expected end
(for infeasible problems: with the right cause), processor time, and findings of the independent checker in solved
plans. With --threads, each plan is made with one thread and with this number, in turns. The last columns are then wall
times of all seeds: seconds with one thread, and the ratio with the others.
"""

from __future__ import annotations

import argparse
import re
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import kinegraph as ry

TABLE_TOP = 0.6


@dataclass
class Problem:
    """A scene, a goal, and the expected end of planTask."""

    C: ry.Config
    goal: str
    expect: ry.TaskStatus
    least: int = 0  # actions of the shortest plan
    why: str = ""  # a pattern of the message of a failure


def _scene() -> ry.Config:
    C = ry.Config()
    C.addFrame("base").setPosition([0, 0, TABLE_TOP])
    table = C.addFrame("table", "base").setRelativePosition([0, 0, -0.05]).setShape(ry.ST.ssBox, [2.0, 2.0, 0.1, 0.02])
    table.setContact(1).setAttributes({"logical": {"is_place": True}})
    return C


def _hand(C: ry.Config, name: str, low: list[float], high: list[float]) -> None:
    hand = C.addFrame(name, "base").setShape(ry.ST.marker, [0.03]).setAttributes({"logical": {"is_gripper": True}})
    hand.setJoint(ry.JT.trans3, [*low, *high]).setJointState([0.5 * (a + b) for a, b in zip(low, high, strict=True)])


def _fingers(C: ry.Config, name: str, palm: list[float], wrist: float = 0.0) -> None:
    """Adds a hand with fingers that open 9 cm, and a palm above them; optionally with a wrist that rotates about x."""
    carriage = C.addFrame(f"{name}carriage", "base").setJoint(ry.JT.trans3, [-0.9, -0.9, 0.0, 0.9, 0.9, 1.0])
    carriage.setJointState([0.0, 0.0, 0.5])
    hand = C.addFrame(f"{name}gripper", f"{name}carriage").setShape(ry.ST.marker, [0.03])
    hand.setAttributes({"logical": {"is_gripper": True}, "opening": 0.09})
    if wrist > 0:
        hand.setJoint(ry.JT.hingeX, [-wrist, wrist]).setJointState([0.0])
    above = C.addFrame(f"{name}palm", f"{name}gripper").setRelativePosition([0, 0, 0.06 + 0.5 * palm[2]])
    above.setShape(ry.ST.ssBox, [*palm, 0.004]).setContact(1)


def _wall(C: ry.Config, name: str, at: list[float], size: list[float]) -> None:
    C.addFrame(name, "base").setRelativePosition(at).setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1)


def _box(C: ry.Config, name: str, parent: str, at: list[float], size: list[float], is_place: bool = False) -> None:
    words = {"is_object": True, **({"is_place": True} if is_place else {})}
    box = C.addFrame(name, parent).setRelativePosition(at).setJoint(ry.JT.rigid)
    box.setShape(ry.ST.ssBox, [*size, 0.004]).setColor([1.0, 0.6, 0.2]).setContact(1).setAttributes({"logical": words})


def _pad(C: ry.Config, name: str, at: list[float], size: list[float]) -> None:
    pad = (
        C.addFrame(name, "base")
        .setRelativePosition([*at, 0.005])
        .setShape(ry.ST.ssBox, [*size, 0.01, 0.004])
        .setColor([0.3, 0.6, 0.3])
    )
    pad.setContact(0).setAttributes({"logical": {"is_place": True}, "simulate": False})


def _flush(C: ry.Config, name: str, at: list[float], size: list[float]) -> None:
    """Adds a zone of the table, at its height."""
    zone = C.addFrame(name, "base").setRelativePosition([*at, -0.005]).setShape(ry.ST.ssBox, [*size, 0.01, 0.004])
    zone.setColor([0.3, 0.6, 0.3]).setContact(0).setAttributes({"logical": {"is_place": True}, "simulate": False})


def _reach(C: ry.Config) -> None:
    _hand(C, "hand", [-0.9, -0.9, 0.0], [0.9, 0.9, 1.0])


def _spots(
    rng: np.random.Generator, count: int, low: list[float], high: list[float], apart: float
) -> list[list[float]]:
    """Returns positions on the table with a least distance from each other."""
    spots: list[np.ndarray] = []
    while len(spots) < count:
        spot = rng.uniform(low, high)
        if all(np.linalg.norm(spot - other) >= apart for other in spots):
            spots.append(spot)
    return [[float(x) for x in spot] for spot in spots]


def tower(seed: int, k: int = 3) -> Problem:
    """k cubes on a table, to be stacked in order."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    for i, at in enumerate(_spots(rng, k, [-0.7, -0.5], [0.7, 0.5], 0.25)):
        _box(C, f"b{i}", "table", [*at, 0.1], [0.1, 0.1, 0.1], is_place=True)
    return Problem(C, " ".join(f"(on b{i} b{i + 1})" for i in range(k - 1)), ry.TaskStatus.solved, 2 * (k - 1))


def sort(seed: int, k: int = 4) -> Problem:
    """k boxes, onto two trays with room for half of them each."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    room = 0.16 * ((k + 1) // 2)
    _pad(C, "red", [0.4, 0.6], [room, 0.16])
    _pad(C, "blue", [-0.4, 0.6], [room, 0.16])
    for i, at in enumerate(_spots(rng, k, [-0.8, -0.7], [0.8, 0.1], 0.2)):
        _box(C, f"o{i}", "table", [*at, 0.1], [0.08, 0.08, 0.1])
    return Problem(
        C, " ".join(f"(on {'red' if i % 2 else 'blue'} o{i})" for i in range(k)), ry.TaskStatus.solved, 2 * k
    )


def handover(seed: int) -> Problem:
    """Two hands whose workspaces share little, and a wall between them."""
    C, rng = _scene(), np.random.default_rng(seed)
    _hand(C, "left", [-0.9, -0.9, 0.0], [0.1, 0.9, 1.0])
    _hand(C, "right", [-0.1, -0.9, 0.0], [0.9, 0.9, 1.0])
    C.addFrame("wall", "base").setRelativePosition([0, 0, 0.15]).setShape(
        ry.ST.ssBox, [0.06, 1.6, 0.3, 0.01]
    ).setContact(1)
    y = rng.uniform(-0.5, 0.5, 2)
    _pad(C, "goal", [0.6, float(y[0])], [0.14, 0.14])
    _box(C, "obj", "table", [-0.6, float(y[1]), 0.1], [0.08, 0.08, 0.1])
    return Problem(C, "(on goal obj)", ry.TaskStatus.solved, 3)


def crowded(seed: int) -> Problem:
    """The goal is occupied; its occupant must go first."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "goal", [0.4, 0.3], [0.12, 0.12])
    _box(C, "c0", "goal", [*rng.uniform(-0.02, 0.02, 2).tolist(), 0.055], [0.08, 0.08, 0.1])
    _box(C, "obj", "table", [*rng.uniform([-0.6, -0.5], [-0.1, 0.5]).tolist(), 0.1], [0.1, 0.1, 0.1])
    return Problem(C, "(on goal obj)", ry.TaskStatus.solved, 4)


def turn(seed: int) -> Problem:
    """A box to be put upside down; the palm is too wide for the table to rotate that far in one grasp."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.1, 0.2, 0.04], wrist=1.66)
    _box(C, "obj", "table", [*rng.uniform(-0.5, 0.5, 2).tolist(), 0.11], [0.07, 0.08, 0.12])
    return Problem(C, "(up zNeg obj)", ry.TaskStatus.solved, 4)


def slot(seed: int) -> Problem:
    """A box goes into a shelf whose roof leaves no room for the hand: it must be held from the side."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.08, 0.08, 0.04], wrist=1.66)
    x = float(rng.uniform(-0.4, 0.4))
    _pad(C, "shelf", [x, 0.6], [0.2, 0.2])
    _wall(C, "roof", [x, 0.63, 0.22], [0.3, 0.26, 0.02])
    _wall(C, "back", [x, 0.77, 0.12], [0.3, 0.02, 0.2])
    _box(C, "obj", "table", [float(rng.uniform(-0.5, 0.5)), float(rng.uniform(-0.6, 0.0)), 0.125], [0.07, 0.07, 0.15])
    return Problem(C, "(on shelf obj)", ry.TaskStatus.solved, 2)


def carry(seed: int, k: int = 3) -> Problem:
    """Cups on a tray within reach of one hand, pads within reach of another: the tray is carried to the middle."""
    C, rng = _scene(), np.random.default_rng(seed)
    _hand(C, "left", [-0.9, -0.9, 0.0], [0.15, 0.9, 1.0])
    _hand(C, "right", [-0.15, -0.9, 0.0], [0.9, 0.9, 1.0])
    _box(C, "tray", "table", [-0.65, float(rng.uniform(-0.3, 0.3)), 0.06], [0.3, 0.3, 0.02], is_place=True)
    C.getFrame("tray").setAttributes({"logical": {"is_object": True, "is_place": True, "is_carrier": True}})
    for i, at in enumerate([[-0.08, -0.08], [0.08, -0.08], [0.0, 0.08]][:k]):
        _box(C, f"cup{i}", "tray", [*at, 0.06], [0.06, 0.06, 0.1])
        _pad(C, f"pad{i}", [0.65, -0.4 + 0.4 * i], [0.12, 0.12])
    return Problem(C, " ".join(f"(on pad{i} cup{i})" for i in range(k)), ry.TaskStatus.solved, 2 + 2 * k)


def push(seed: int) -> Problem:
    """A box that is too wide for the hand is pushed to a zone."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04])
    x, y = rng.uniform(-0.4, 0.0, 2).tolist()
    _box(C, "obj", "table", [x, y, 0.1], [0.15, 0.15, 0.1])
    C.getFrame("obj").setAttributes({"logical": {"is_object": True, "is_pushable": True}})
    _flush(C, "zone", [0.5, float(rng.uniform(-0.3, 0.3))], [0.3, 0.3])
    return Problem(C, "(on zone obj)", ry.TaskStatus.solved, 2)


def _stick(C: ry.Config, name: str, at: list[float], angle: float, length: float = 0.5) -> None:
    """An L: a bar, and a hook across its end."""
    _box(C, name, "table", [*at, 0.065], [0.03, length, 0.03])
    C.getFrame(name).setRelativeQuaternion([np.cos(0.5 * angle), 0, 0, np.sin(0.5 * angle)])
    hook = C.addFrame(f"{name}_hook", name).setRelativePosition([0.085, 0.5 * length - 0.015, 0])
    hook.setShape(ry.ST.ssBox, [0.14, 0.03, 0.03, 0.004]).setContact(1).setAttributes({"logical": {"is_hook": True}})


def hook(seed: int) -> Problem:
    """A box beyond the reach of the hand, but within reach of a stick with a hook."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04])
    C.getFrame("g_carriage").setJoint(ry.JT.trans3, [-0.9, -0.9, 0.0, 0.9, 0.1, 1.0]).setJointState([0, -0.4, 0.5])
    C.getFrame("g_gripper").setJoint(ry.JT.hingeZ, [-2.0, 2.0]).setJointState([0.0])
    _stick(C, "stick", [float(rng.uniform(-0.6, -0.2)), float(rng.uniform(-0.4, -0.2))], float(rng.uniform(-0.7, 0.7)))
    _box(C, "obj", "table", [float(rng.uniform(-0.2, 0.4)), float(rng.uniform(0.25, 0.4)), 0.08], [0.06, 0.06, 0.06])
    _pad(C, "goal", [float(rng.uniform(0.3, 0.6)), float(rng.uniform(-0.5, -0.3))], [0.14, 0.14])
    return Problem(C, "(on goal obj)", ry.TaskStatus.solved, 6)


def _cabinet(C: ry.Config, at: list[float], deep: float = 0.4) -> None:
    """Adds a drawer that opens toward -y, in a cabinet with a roof; `at` is the center of its closed front, on the
    table.
    """
    base = C.addFrame("cabinet", "base").setRelativePosition([*at, 0.0])
    assert base is not None
    for name, where, size in (
        ("left", [-0.19, 0.5 * deep, 0.11], [0.02, deep, 0.22]),
        ("right", [0.19, 0.5 * deep, 0.11], [0.02, deep, 0.22]),
        ("back", [0, deep + 0.01, 0.11], [0.4, 0.02, 0.22]),
        ("roof", [0, 0.5 * deep, 0.23], [0.4, deep, 0.02]),
    ):
        C.addFrame(f"cabinet_{name}", "cabinet").setRelativePosition(where).setShape(
            ry.ST.ssBox, [*size, 0.004]
        ).setContact(1)
    drawer = C.addFrame("drawer", "cabinet").setJoint(ry.JT.transY, [-0.3, 0.0]).setJointState([0.0])
    drawer.setAttributes({"logical": {"is_drawer": True}})
    floor = C.addFrame("drawer_floor", "drawer").setRelativePosition([0, 0.5 * deep - 0.02, 0.02])
    floor.setShape(ry.ST.ssBox, [0.32, deep - 0.06, 0.02, 0.004]).setContact(1).setAttributes(
        {"logical": {"is_place": True}}
    )
    front = C.addFrame("drawer_front", "drawer").setRelativePosition([0, -0.01, 0.09])
    front.setShape(ry.ST.ssBox, [0.34, 0.02, 0.16, 0.004]).setContact(1)
    handle = C.addFrame("handle", "drawer").setRelativePosition([0, -0.06, 0.1])
    handle.setShape(ry.ST.ssBox, [0.02, 0.02, 0.1, 0.004]).setContact(1).setAttributes({"logical": {"is_handle": True}})


def drawer(seed: int) -> Problem:
    """A drawer to be opened."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    _cabinet(C, [float(rng.uniform(-0.4, 0.4)), float(rng.uniform(0.2, 0.4))])
    return Problem(C, "(opened drawer)", ry.TaskStatus.solved, 2)


def door(seed: int) -> Problem:
    """A door to be opened; its handle stands upright and rotates in the hand."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04])
    C.getFrame("g_gripper").setJoint(ry.JT.hingeZ, [-2.0, 2.0]).setJointState([0.0])
    is_left = bool(rng.integers(2))
    side = 1.0 if is_left else -1.0
    hinge = C.addFrame("hinge", "base").setRelativePosition(
        [float(rng.uniform(-0.3, 0.3)), float(rng.uniform(0.1, 0.4)), 0.02]
    )
    assert hinge is not None
    door = (
        C.addFrame("door", "hinge").setJoint(ry.JT.hingeZ, [-1.5, 0.0] if is_left else [0.0, 1.5]).setJointState([0.0])
    )
    door.setAttributes({"logical": {"is_door": True}})
    leaf = C.addFrame("leaf", "door").setRelativePosition([0.2 * side, 0.0, 0.15])
    leaf.setShape(ry.ST.ssBox, [0.36, 0.02, 0.3, 0.004]).setContact(1)
    handle = C.addFrame("handle", "door").setRelativePosition([0.34 * side, -0.06, 0.2])
    handle.setShape(ry.ST.capsule, [0.1, 0.012]).setContact(1).setAttributes({"logical": {"is_handle": True}})
    return Problem(C, "(opened door)", ry.TaskStatus.solved, 2)


def stow(seed: int) -> Problem:
    """A cup to be put into a closed drawer, which must be opened first."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    _cabinet(C, [float(rng.uniform(-0.3, 0.3)), float(rng.uniform(0.3, 0.45))])
    _box(C, "cup", "table", [float(rng.uniform(-0.6, 0.6)), float(rng.uniform(-0.7, -0.4)), 0.1], [0.06, 0.06, 0.1])
    return Problem(C, "(on drawer_floor cup)", ry.TaskStatus.solved, 4)


def fetch(seed: int) -> Problem:
    """A cup in a closed drawer, which is to be closed in the end."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    _cabinet(C, [float(rng.uniform(-0.3, 0.3)), float(rng.uniform(0.3, 0.45))])
    _box(C, "cup", "drawer_floor", [*rng.uniform([-0.08, -0.05], [0.08, 0.05]).tolist(), 0.06], [0.06, 0.06, 0.1])
    return Problem(C, "(on table cup) (closed drawer)", ry.TaskStatus.solved, 6)


def cleared(seed: int) -> Problem:
    """A box in front of a drawer that is to be opened."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    x, y = float(rng.uniform(-0.3, 0.3)), float(rng.uniform(0.2, 0.4))
    _cabinet(C, [x, y])
    _box(C, "box", "table", [x + float(rng.uniform(-0.12, 0.12)), y - 0.18, 0.1], [0.06, 0.06, 0.1])
    return Problem(C, "(opened drawer)", ry.TaskStatus.solved, 4)


def lower(seed: int) -> Problem:
    """A tall cup in an open drawer: it must be taken out before the drawer is closed."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    _cabinet(C, [float(rng.uniform(-0.3, 0.3)), float(rng.uniform(0.4, 0.5))])
    C.getFrame("drawer").setJointState([-0.29])
    _box(C, "cup", "drawer_floor", [float(rng.uniform(-0.08, 0.08)), -0.08, 0.135], [0.06, 0.06, 0.25])
    _pad(C, "tray", [0.6, -0.5], [0.2, 0.2])
    return Problem(C, "(on tray cup) (closed drawer)", ry.TaskStatus.solved, 4)


def far(seed: int) -> Problem:
    """No plan: the goal is out of reach."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "goal", [float(rng.uniform(1.5, 1.8)), 0.0], [0.14, 0.14])
    _box(C, "obj", "table", [-0.2, 0.4, 0.1], [0.08, 0.08, 0.1])
    return Problem(C, "(on goal obj)", ry.TaskStatus.infeasible, why="'goal' is at least .* beyond the reach of 'hand'")


def beyond(seed: int) -> Problem:
    """No plan: a box is beyond the reach of the hand, and of its stick."""
    problem = hook(seed)
    box = problem.C.getFrame("obj")
    box.setRelativePosition(box.getRelativePosition() + np.array([0.0, 0.6, 0.0]))
    why = "'obj' is at least .* beyond the reach of 'g_gripper', with 'stick', too"
    return Problem(problem.C, problem.goal, ry.TaskStatus.infeasible, why=why)


def remote(seed: int) -> Problem:
    """No plan: the handle of a drawer is always out of reach."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    _cabinet(C, [float(rng.uniform(-0.4, 0.4)), float(rng.uniform(1.5, 1.8))])
    return Problem(
        C, "(opened drawer)", ry.TaskStatus.infeasible, why="'handle' is at least .* beyond the reach of 'g_gripper'"
    )


def blocked(seed: int) -> Problem:
    """No plan: a post stands in front of a drawer."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.06, 0.06, 0.04], wrist=1.66)
    x, y = float(rng.uniform(-0.4, 0.4)), float(rng.uniform(0.2, 0.4))
    _cabinet(C, [x, y])
    _wall(C, "post", [x + float(rng.uniform(-0.12, 0.12)), y - float(rng.uniform(0.12, 0.2)), 0.1], [0.03, 0.03, 0.2])
    return Problem(C, "(opened drawer)", ry.TaskStatus.infeasible, why="'drawer' meets 'post' at .* % of its range")


def tall(seed: int) -> Problem:
    """No plan: a cup in a drawer that is to be closed is higher than the cabinet."""
    problem = stow(seed)
    problem.C.getFrame("cup").setShape(ry.ST.ssBox, [0.06, 0.06, 0.25, 0.004]).setRelativePosition([0.0, -0.5, 0.175])
    goal = "(on drawer_floor cup) (closed drawer)"
    return Problem(problem.C, goal, ry.TaskStatus.no_plan_found, why="cup overlap")


def small(seed: int) -> Problem:
    """No plan: two boxes do not fit on a pad."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "goal", [0.4, 0.3], [0.06, 0.06])
    for name, at in zip("ab", _spots(rng, 2, [-0.8, -0.5], [0.1, 0.5], 0.25), strict=True):
        _box(C, name, "table", [*at, 0.1], [0.1, 0.1, 0.1])
    return Problem(
        C, "(on goal a) (on goal b)", ry.TaskStatus.infeasible, why="'a' and 'b' do not fit on 'goal' together"
    )


def contradiction(seed: int) -> Problem:
    """No plan: nothing is at two positions."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "p", [0.4, 0.3], [0.14, 0.14])
    _pad(C, "q", [-0.4, 0.3], [0.14, 0.14])
    _box(C, "a", "table", [*rng.uniform(-0.3, 0.0, 2).tolist(), 0.1], [0.1, 0.1, 0.1])
    return Problem(C, "(on p a) (on q a)", ry.TaskStatus.infeasible, why="no sequence of actions reaches")


def wide(seed: int) -> Problem:
    """No plan: a box is wider than the hand opens."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.08, 0.08, 0.04])
    _pad(C, "goal", [0.4, 0.3], [0.2, 0.2])
    _box(C, "obj", "table", [*rng.uniform(-0.5, 0.1, 2).tolist(), 0.1], [0.12, 0.13, 0.1])
    return Problem(C, "(on goal obj)", ry.TaskStatus.infeasible, why="'obj' is wider than 'g_gripper' opens")


def walled(seed: int) -> Problem:
    """No plan: the object is walled in."""
    C, rng = _scene(), np.random.default_rng(seed)
    _fingers(C, "g_", [0.08, 0.08, 0.04])
    x, y = rng.uniform(-0.5, 0.1, 2).tolist()
    _box(C, "obj", "table", [x, y, 0.1], [0.07, 0.07, 0.1])
    for name, at, size in (
        ("wall0", [-0.08, 0, 0.075], [0.02, 0.18, 0.15]),
        ("wall1", [0.08, 0, 0.075], [0.02, 0.18, 0.15]),
        ("wall2", [0, -0.08, 0.075], [0.18, 0.02, 0.15]),
        ("wall3", [0, 0.08, 0.075], [0.18, 0.02, 0.15]),
        ("wall_lid", [0, 0, 0.16], [0.18, 0.18, 0.02]),
    ):
        _wall(C, name, [x + at[0], y + at[1], at[2]], size)
    _pad(C, "goal", [0.5, 0.3], [0.2, 0.2])
    return Problem(C, "(on goal obj)", ry.TaskStatus.no_plan_found, why="wall")


def nowhere(seed: int) -> Problem:
    """No plan: a box is to be put upside down, and there is no room to lay it on its side."""
    C, rng = _scene(), np.random.default_rng(seed)
    C.getFrame("table").setAttributes({"logical": {}})
    _fingers(C, "g_", [0.1, 0.2, 0.04], wrist=1.66)
    x, y = rng.uniform(-0.4, 0.4, 2).tolist()
    _pad(C, "well", [x, y], [0.1, 0.1])
    for k, (dx, dy) in enumerate(((-0.06, 0.0), (0.06, 0.0), (0.0, -0.06), (0.0, 0.06))):
        _wall(C, f"rim{k}", [x + dx, y + dy, 0.03], [0.02, 0.14, 0.04] if dx else [0.14, 0.02, 0.04])
    _box(C, "obj", "well", [0.0, 0.0, 0.075], [0.07, 0.08, 0.14])
    return Problem(C, "(up zNeg obj)", ry.TaskStatus.no_plan_found, why="lay obj")


FAMILIES: dict[str, Callable[[int], Problem]] = {
    "tower": tower,
    "sort": sort,
    "handover": handover,
    "crowded": crowded,
    "turn": turn,
    "slot": slot,
    "carry": carry,
    "push": push,
    "hook": hook,
    "drawer": drawer,
    "door": door,
    "stow": stow,
    "fetch": fetch,
    "cleared": cleared,
    "lower": lower,
    "far": far,
    "beyond": beyond,
    "remote": remote,
    "blocked": blocked,
    "tall": tall,
    "small": small,
    "contradiction": contradiction,
    "wide": wide,
    "walled": walled,
    "nowhere": nowhere,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--families", default=",".join(FAMILIES))
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--evaluations", type=int, default=200000)
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    several = options.threads > 1
    clocks = f"   1 thread s   / {options.threads} threads" if several else ""
    print(f"{'family':14} as expected   false   median s   most s   evaluations{clocks}")
    for name in options.families.split(","):
        right, wrong, seconds, evaluations, one, others = 0, 0, [], [], 0.0, 0.0
        for seed in range(options.first, options.first + options.seeds):
            problem = FAMILIES[name](seed)
            began, at = time.process_time(), time.perf_counter()
            plan = ry.planTask(problem.C, problem.goal, max_evaluations=options.evaluations, seed=seed)
            seconds.append(time.process_time() - began)
            one += time.perf_counter() - at
            if several:
                at = time.perf_counter()
                ry.planTask(
                    problem.C, problem.goal, max_evaluations=options.evaluations, seed=seed, threads=options.threads
                )
                others += time.perf_counter() - at
            evaluations.append(plan.evaluations)
            right += plan.status == problem.expect and bool(re.search(problem.why, plan.message))
            wrong += bool(plan.feasible and ry.checkTaskPlan(problem.C, plan))
        print(
            f"{name:14} {right:4} of {options.seeds:<4} {wrong:5} {statistics.median(seconds):10.2f} {max(seconds):8.2f}"
            f" {statistics.median(evaluations):13.0f}" + (f" {one:12.2f} {one / others:13.2f}" if several else ""),
            flush=True,
        )


if __name__ == "__main__":
    main()
