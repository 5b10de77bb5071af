"""Families of manipulation problems, and how planTask does on them.

    python benchmarks/tasks.py [--families tower,crowded] [--seeds 5] [--evaluations 200000]

Each family is a generator of scenes with a seed; positions are drawn so that a plan exists by construction, or none does.
The hand is a gantry: a frame with three sliding joints, whose limits are its reach. Printed: how many seeds end as
expected, processor time, and what the independent checker found wrong in plans that were called solved.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import kinegraph as ry

TABLE_TOP = 0.6


@dataclass
class Problem:
    """A scene, a goal, and how planTask is to end."""

    C: ry.Config
    goal: str
    expect: str  # a status
    least: int = 0  # actions of the shortest plan


def _scene() -> ry.Config:
    C = ry.Config()
    C.addFrame("base").setPosition([0, 0, TABLE_TOP])
    table = C.addFrame("table", "base").setRelativePosition([0, 0, -0.05]).setShape(ry.ST.ssBox, [2.0, 2.0, 0.1, 0.02])
    table.setContact(1).setAttributes({"logical": {"is_place": True}})
    return C


def _hand(C: ry.Config, name: str, low: list[float], high: list[float]) -> None:
    hand = C.addFrame(name, "base").setShape(ry.ST.marker, [0.03]).setAttributes({"logical": {"is_gripper": True}})
    hand.setJoint(ry.JT.trans3, [*low, *high]).setJointState([0.5 * (a + b) for a, b in zip(low, high, strict=True)])


def _box(C: ry.Config, name: str, parent: str, at: list[float], size: list[float], is_place: bool = False) -> None:
    words = {"is_object": True, **({"is_place": True} if is_place else {})}
    box = C.addFrame(name, parent).setRelativePosition(at).setJoint(ry.JT.rigid)
    box.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1).setAttributes({"logical": words})


def _pad(C: ry.Config, name: str, at: list[float], size: list[float]) -> None:
    pad = C.addFrame(name, "base").setRelativePosition([*at, 0.005]).setShape(ry.ST.ssBox, [*size, 0.01, 0.004])
    pad.setContact(0).setAttributes({"logical": {"is_place": True}, "simulate": False})


def _reach(C: ry.Config) -> None:
    _hand(C, "hand", [-0.9, -0.9, 0.0], [0.9, 0.9, 1.0])


def _spots(
    rng: np.random.Generator, count: int, low: list[float], high: list[float], apart: float
) -> list[list[float]]:
    """Places on the table at least so far from each other."""
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
    return Problem(C, " ".join(f"(on b{i} b{i + 1})" for i in range(k - 1)), "solved", 2 * (k - 1))


def sort(seed: int, k: int = 4) -> Problem:
    """k boxes, onto two trays with room for half of them each."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    room = 0.16 * ((k + 1) // 2)
    _pad(C, "red", [0.4, 0.6], [room, 0.16])
    _pad(C, "blue", [-0.4, 0.6], [room, 0.16])
    for i, at in enumerate(_spots(rng, k, [-0.8, -0.7], [0.8, 0.1], 0.2)):
        _box(C, f"o{i}", "table", [*at, 0.1], [0.08, 0.08, 0.1])
    return Problem(C, " ".join(f"(on {'red' if i % 2 else 'blue'} o{i})" for i in range(k)), "solved", 2 * k)


def handover(seed: int) -> Problem:
    """Two hands that share little room, and a wall between."""
    C, rng = _scene(), np.random.default_rng(seed)
    _hand(C, "left", [-0.9, -0.9, 0.0], [0.1, 0.9, 1.0])
    _hand(C, "right", [-0.1, -0.9, 0.0], [0.9, 0.9, 1.0])
    C.addFrame("wall", "base").setRelativePosition([0, 0, 0.15]).setShape(
        ry.ST.ssBox, [0.06, 1.6, 0.3, 0.01]
    ).setContact(1)
    y = rng.uniform(-0.5, 0.5, 2)
    _pad(C, "goal", [0.6, float(y[0])], [0.14, 0.14])
    _box(C, "obj", "table", [-0.6, float(y[1]), 0.1], [0.08, 0.08, 0.1])
    return Problem(C, "(on goal obj)", "solved", 3)


def crowded(seed: int) -> Problem:
    """The goal is occupied; its occupant has to go first."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "goal", [0.4, 0.3], [0.12, 0.12])
    _box(C, "c0", "goal", [*rng.uniform(-0.02, 0.02, 2).tolist(), 0.055], [0.08, 0.08, 0.1])
    _box(C, "obj", "table", [*rng.uniform([-0.6, -0.5], [-0.1, 0.5]).tolist(), 0.1], [0.1, 0.1, 0.1])
    return Problem(C, "(on goal obj)", "solved", 4)


def far(seed: int) -> Problem:
    """No plan: the goal is out of reach."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "goal", [float(rng.uniform(1.5, 1.8)), 0.0], [0.14, 0.14])
    _box(C, "obj", "table", [-0.2, 0.4, 0.1], [0.08, 0.08, 0.1])
    return Problem(C, "(on goal obj)", "proved impossible")


def small(seed: int) -> Problem:
    """No plan: two boxes do not fit on a pad."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "goal", [0.4, 0.3], [0.06, 0.06])
    for name, at in zip("ab", _spots(rng, 2, [-0.8, -0.5], [0.1, 0.5], 0.25), strict=True):
        _box(C, name, "table", [*at, 0.1], [0.1, 0.1, 0.1])
    return Problem(C, "(on goal a) (on goal b)", "proved impossible")


def contradiction(seed: int) -> Problem:
    """No plan: nothing is at two places."""
    C, rng = _scene(), np.random.default_rng(seed)
    _reach(C)
    _pad(C, "p", [0.4, 0.3], [0.14, 0.14])
    _pad(C, "q", [-0.4, 0.3], [0.14, 0.14])
    _box(C, "a", "table", [*rng.uniform(-0.3, 0.0, 2).tolist(), 0.1], [0.1, 0.1, 0.1])
    return Problem(C, "(on p a) (on q a)", "proved impossible")


FAMILIES: dict[str, Callable[[int], Problem]] = {
    "tower": tower,
    "sort": sort,
    "handover": handover,
    "crowded": crowded,
    "far": far,
    "small": small,
    "contradiction": contradiction,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--families", default=",".join(FAMILIES))
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--evaluations", type=int, default=200000)
    options = parser.parse_args()
    print(f"{'family':14} as expected   false   median s   most s   evaluations")
    for name in options.families.split(","):
        right, wrong, seconds, evaluations = 0, 0, [], []
        for seed in range(options.seeds):
            problem = FAMILIES[name](seed)
            began = time.process_time()
            plan = ry.planTask(problem.C, problem.goal, evaluations=options.evaluations, seed=seed)
            seconds.append(time.process_time() - began)
            evaluations.append(plan.evaluations)
            right += plan.status == problem.expect
            wrong += bool(plan.feasible and ry.checkTaskPlan(problem.C, plan))
        print(
            f"{name:14} {right:4} of {options.seeds:<4} {wrong:5} {statistics.median(seconds):10.2f} {max(seconds):8.2f}"
            f" {statistics.median(evaluations):13.0f}"
        )


if __name__ == "__main__":
    main()
