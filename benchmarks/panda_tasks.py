"""Measures tasks of Panda arms: the time of planTask, and the number of plans that reach their goal in simulation.

    python benchmarks/panda_tasks.py [--families tower,sort] [--sizes 3,5] [--seeds 5] [--first 0]
        [--repairs 3] [--jitter 0.005]

A seed places the objects. --jitter moves those of the simulated world by this distance (m) from the planned ones. The
table has the number of planned seeds, processor time, and the duration of the motion. It continues with the number of
plans that reach the goal in the simulated world, open loop and with repairs, and the reasons of other ends.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import kinegraph as ry

TOP = 0.05  # m: of the table above the frame of the table


@dataclass
class Problem:
    C: ry.Config
    goal: str
    least: int


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def box(C: ry.Config, name: str, parent: str, at: list[float], size: list[float], friction: float = 1.0) -> None:
    """Adds a box of .1 kg; `at` is relative to the center of the parent's top face."""
    height = 0.5 * C.getFrame(parent).getSize()[2] + 0.5 * size[2]
    frame = C.addFrame(name, parent).setRelativePosition([at[0], at[1], height]).setJoint(ry.JT.rigid)
    frame.setShape(ry.ST.ssBox, [*size, 0.004]).setColor([1.0, 0.6, 0.2]).setContact(1).setMass(0.1)
    frame.setAttributes({"friction": friction})


def pad(C: ry.Config, name: str, at: list[float], size: list[float]) -> None:
    frame = C.addFrame(name, "table").setRelativePosition([*at, TOP + 0.005])
    frame.setShape(ry.ST.ssBox, [*size, 0.01, 0.004]).setColor([0.3, 0.6, 0.3]).setContact(1)


def spots(rng: np.random.Generator, count: int, low: float, high: float, apart: float) -> list[list[float]]:
    """Returns positions on the table in front of the arm, within a range of distances from its base, and apart from
    each other.
    """
    found: list[np.ndarray] = []
    while len(found) < count:
        angle, radius = rng.uniform(-1.4, 1.4), rng.uniform(low, high)
        spot = np.array([radius * np.sin(angle), -0.2 + radius * np.cos(angle)])
        if all(np.linalg.norm(spot - other) >= apart for other in found):
            found.append(spot)
    return [spot.tolist() for spot in found]


def tower(seed: int, k: int = 3) -> Problem:
    """k cubes of 5 cm on a table, to be stacked in order."""
    C, rng = scene(), np.random.default_rng(seed)
    for i, at in enumerate(spots(rng, k, 0.35, 0.65, 0.12)):
        box(C, f"b{i}", "table", at, [0.05, 0.05, 0.05])
    return Problem(C, " ".join(f"(on b{i + 1} b{i})" for i in range(k - 1)), 2 * (k - 1))


def sort(seed: int, k: int = 4) -> Problem:
    """k boxes, onto two trays with room for half of them each."""
    C, rng = scene(), np.random.default_rng(seed)
    room = 0.12 * ((k + 1) // 2)
    pad(C, "red", [0.5, 0.15], [0.14, room])
    pad(C, "blue", [-0.5, 0.15], [0.14, room])
    low = [[x, y] for x in np.linspace(-0.3, 0.3, 4) for y in np.linspace(0.15, 0.5, 4)]
    for i, cell in enumerate(rng.permutation(len(low))[:k]):
        at = (np.array(low[cell]) + rng.uniform(-0.02, 0.02, 2)).tolist()
        box(C, f"o{i}", "table", at, [0.04, 0.05, 0.08])
    return Problem(C, " ".join(f"(on {'red' if i % 2 else 'blue'} o{i})" for i in range(k)), 2 * k)


def cabinet(C: ry.Config, at: list[float]) -> None:
    """Adds a drawer that opens by .2 m toward the arm, in a cabinet with a roof; `at` is the center of its closed
    front.
    """
    C.addFrame("cabinet", "table").setRelativePosition([*at, TOP])
    for name, where, size in (
        ("left", [-0.14, 0.15, 0.08], [0.02, 0.3, 0.16]),
        ("right", [0.14, 0.15, 0.08], [0.02, 0.3, 0.16]),
        ("back", [0, 0.31, 0.08], [0.3, 0.02, 0.16]),
        ("roof", [0, 0.16, 0.17], [0.3, 0.32, 0.02]),
    ):
        wall = C.addFrame(f"cabinet_{name}", "cabinet").setRelativePosition(where)
        wall.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1)
    drawer = C.addFrame("drawer", "cabinet").setJoint(ry.JT.transY, [-0.2, 0.0]).setJointState([0.0])
    drawer.setAttributes({"logical": {"is_drawer": True}, "noMotor": True, "jointFriction": 2.0})
    for name, where, size in (
        ("floor", [0, 0.14, 0.02], [0.24, 0.26, 0.02]),
        ("front", [0, -0.01, 0.07], [0.25, 0.02, 0.12]),
        ("handle", [0, -0.07, 0.1], [0.02, 0.02, 0.08]),
    ):
        part = C.addFrame("handle" if name == "handle" else f"drawer_{name}", "drawer").setRelativePosition(where)
        part.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1).setMass(0.2)
    C.getFrame("handle").setAttributes({"logical": {"is_handle": True}})


def drawer(seed: int, k: int = 0) -> Problem:
    """A drawer to be opened."""
    C, rng = scene(), np.random.default_rng(seed)
    cabinet(C, [float(rng.uniform(-0.15, 0.15)), float(rng.uniform(0.4, 0.5))])
    return Problem(C, "(opened drawer)", 2)


def stow(seed: int, k: int = 0) -> Problem:
    """A box to be put into a drawer that must be opened first."""
    C, rng = scene(), np.random.default_rng(seed)
    cabinet(C, [float(rng.uniform(-0.1, 0.1)), float(rng.uniform(0.4, 0.5))])
    side = 1.0 if rng.integers(2) else -1.0
    box(C, "cup", "table", [side * float(rng.uniform(0.35, 0.5)), float(rng.uniform(0.0, 0.2))], [0.04, 0.05, 0.08])
    return Problem(C, "(on drawer_floor cup)", 4)


def door(seed: int, k: int = 0) -> Problem:
    """A door to be opened by its post, which rotates in the hand."""
    C, rng = scene(), np.random.default_rng(seed)
    side = 1.0 if rng.integers(2) else -1.0
    C.addFrame("hinge", "table").setRelativePosition(
        [-0.15 * side, float(rng.uniform(0.35, 0.45 if side > 0 else 0.37)), TOP + 0.01]
    )
    door = C.addFrame("door", "hinge").setJoint(ry.JT.hingeZ, [-1.0, 0.0] if side > 0 else [0.0, 1.0])
    door.setJointState([0.0]).setAttributes({"logical": {"is_door": True}, "noMotor": True, "jointFriction": 0.5})
    leaf = C.addFrame("leaf", "door").setRelativePosition([0.15 * side, 0.0, 0.15])
    leaf.setShape(ry.ST.ssBox, [0.28, 0.02, 0.3, 0.004]).setContact(1).setMass(0.5)
    post = C.addFrame("handle", "door").setRelativePosition([0.25 * side, -0.07, 0.2])
    post.setShape(ry.ST.ssCylinder, [0.14, 0.01, 0.003]).setContact(1).setMass(0.1)
    post.setAttributes({"logical": {"is_handle": True}})
    return Problem(C, "(opened door)", 2)


def fetch(seed: int, k: int = 0) -> Problem:
    """A box in a closed drawer, which is to be closed in the end."""
    C, rng = scene(), np.random.default_rng(seed)
    cabinet(C, [float(rng.uniform(-0.1, 0.1)), float(rng.uniform(0.4, 0.5))])
    box(C, "cup", "drawer_floor", rng.uniform([-0.05, -0.07], [0.05, -0.03]).tolist(), [0.04, 0.05, 0.08])
    pad(C, "tray", [0.45 if rng.integers(2) else -0.45, 0.1], [0.2, 0.2])
    return Problem(C, "(on tray cup) (closed drawer)", 6)


def hook(seed: int, k: int = 0) -> Problem:
    """A box out of reach, but within reach of a stick with a hook."""
    C, rng = scene(), np.random.default_rng(seed)
    box(C, "stick", "table", [0.45, float(rng.uniform(0.0, 0.2))], [0.03, 0.4, 0.03])
    bar = C.addFrame("bar", "stick").setRelativePosition([0.085, 0.185, 0])
    bar.setShape(ry.ST.ssBox, [0.14, 0.03, 0.03, 0.004]).setContact(1).setMass(0.05)
    bar.setAttributes({"logical": {"is_hook": True}})
    box(C, "cup", "table", [float(rng.uniform(-0.2, 0.2)), float(rng.uniform(0.72, 0.82))], [0.04, 0.05, 0.08])
    return Problem(C, "(on l_gripper cup)", 5)


FAMILIES: dict[str, Callable[[int, int], Problem]] = {
    "tower": tower,
    "sort": sort,
    "drawer": drawer,
    "stow": stow,
    "fetch": fetch,
    "door": door,
    "hook": hook,
}


def moved(C: ry.Config, jitter: float, rng: np.random.Generator) -> ry.Config:
    """Returns the scene with its objects slightly displaced."""
    world = C.copy()
    for frame in world.getFrames():
        if frame.getMass() > 0 and frame.getJointType() == ry.JT.rigid and frame.getParent().name == "table":
            at = frame.getRelativePosition() + np.array([*rng.uniform(-jitter, jitter, 2), 0.0])
            frame.setRelativePosition(at)
        elif frame.getMass() > 0 and frame.getJointType() == ry.JT.rigid and frame.getParent().name == "drawer_floor":
            frame.unLink()  # otherwise it belongs to the drawer in the simulated world
    return world


def carriedOut(plan: ry.TaskPlan, world: ry.Config, repairs: int) -> tuple[int, list[str]]:
    """Returns the number of repairs until the goal, -1 if it was not reached, and the reasons of stops."""
    bot, stops = ry.BotOp(world), []
    for attempt in range(repairs + 1):
        run = plan.execute(bot, repairs=0)
        if run.feasible:
            return attempt, stops
        stops.append(run.message)
        if attempt < repairs:
            plan = plan.repair(run.C)
            if not plan.feasible:
                return -1, [*stops, f"repair: {plan.message}"]
    return -1, stops


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--families", default="tower,sort")
    parser.add_argument("--sizes", default="3")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--repairs", type=int, default=3)
    parser.add_argument("--jitter", type=float, default=0.0)
    options = parser.parse_args()
    print("family      planned  false  median s  most s  motion s  open loop  with repair")
    for name in options.families.split(","):
        for size in map(int, options.sizes.split(",")):
            planned, false, seconds, motion, reached, stops = 0, 0, [], [], [], Counter[str]()
            for seed in range(options.first, options.first + options.seeds):
                problem = FAMILIES[name](seed, size)
                began = time.process_time()
                plan = ry.planTask(problem.C, problem.goal, seed=seed)
                seconds.append(time.process_time() - began)
                if not plan.feasible:
                    stops[plan.message] += 1
                    continue
                planned += 1
                motion.append(plan.duration)
                false += bool(ry.checkTaskPlan(problem.C, plan))
                if options.repairs >= 0:
                    world = moved(problem.C, options.jitter, np.random.default_rng(seed))
                    attempts, why = carriedOut(plan, world, options.repairs)
                    reached.append(attempts)
                    stops.update(why)
            first, all_ = sum(a == 0 for a in reached), sum(a >= 0 for a in reached)
            print(
                f"{name:8}{size:3} {planned:4} of {options.seeds:<3} {false:3} {statistics.median(seconds):9.2f}"
                f" {max(seconds):7.2f} {statistics.median(motion or [0]):9.1f} {first:7} of {planned:<3} {all_:5} of {planned}",
                flush=True,
            )
            for why, count in stops.most_common(6):
                print(f"    {count} x {why}")


if __name__ == "__main__":
    main()
