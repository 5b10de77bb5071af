#!/usr/bin/env python3
"""Does a robot that executes a verified plan keep the plan's margin?

    python benchmarks/follow.py [--plans 200] [--seed 0] [--margin 0.01]

A planar arm of four joints and a Panda on its table move between random free configurations among random boxes, half of
the plans each. `planMotion` verifies a margin; a BotOp executes the plan in three ways: `follow(plan)` by the kinematic
driver, `follow(plan)` in simulation, and `move(plan.path, times)` by the kinematic driver, as slow as the limits
require. At each control period (10 ms) the distances of all pairs are computed at the q that the robot reports.
The table shows the least distance beyond the margin (negative: the margin is violated by as much) and the largest
distance of q from the plan.
"""

import argparse
import re
from time import perf_counter

import numpy as np

import kinegraph as ry

PERIOD = 0.01
ARM = """
base: {}
link0 (base): { joint: hingeZ, limits: [-2.8 2.8], ctrl_limits: [2 100 -1] }
shape0 (link0): { Q: [.15 0 0], shape: ssBox, size: [.2 .06 .06 .02], contact: 1, mass: 1 }
link1 (link0): { pre: "t(.3 0 0)", joint: hingeZ, limits: [-2.6 2.6], ctrl_limits: [2 100 -1] }
shape1 (link1): { Q: [.15 0 0], shape: ssBox, size: [.2 .06 .06 .02], contact: 1, mass: .8 }
link2 (link1): { pre: "t(.3 0 0)", joint: hingeZ, limits: [-2.6 2.6], ctrl_limits: [2 100 -1] }
shape2 (link2): { Q: [.15 0 0], shape: ssBox, size: [.2 .06 .06 .02], contact: 1, mass: .6 }
link3 (link2): { pre: "t(.3 0 0)", joint: hingeZ, limits: [-2.6 2.6], ctrl_limits: [2 100 -1] }
shape3 (link3): { Q: [.15 0 0], shape: ssBox, size: [.2 .06 .06 .02], contact: 1, mass: .4 }
"""


class Distances:
    """Distances of the pairs of a scene that joints move."""

    def __init__(self, C: ry.Config):
        self.C = C.copy()
        names = C.getFrameNames()
        before = self.C.getFrameState()
        self.C.setJointState(C.getJointState() + 0.1)
        self.moving = {
            n for n, a, b in zip(names, before, self.C.getFrameState(), strict=True) if np.abs(a - b).max() > 0
        }

    def least(self, q: np.ndarray, limit: float) -> float:
        """The least distance of a pair, m, if it is less than limit; else limit."""
        self.C.setJointState(q)
        pairs = self.C.getCollisions(limit)
        return min((d for a, b, d in pairs if a in self.moving or b in self.moving), default=limit)


def scene(kind: str, rng: np.random.Generator) -> ry.Config:
    C = ry.Config()
    if kind == "arm":
        C.addText(ARM)
        for i in range(4):
            angle, radius = rng.uniform(-np.pi, np.pi), rng.uniform(0.45, 1.0)
            box = C.addFrame(f"box{i}").setShape(ry.ST.ssBox, [*rng.uniform(0.08, 0.25, 2), 0.2, 0.01])
            box.setPosition([radius * np.cos(angle), radius * np.sin(angle), 0.0]).setContact(1)
    else:
        C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
        for i in range(4):
            box = C.addFrame(f"box{i}", "table").setShape(ry.ST.ssBox, [*rng.uniform(0.06, 0.2, 2), 0.6, 0.01])
            box.setRelativePosition([rng.uniform(-0.6, 0.6), rng.uniform(0.05, 0.6), 0.35]).setContact(1)
    return C


def free(C: ry.Config, distances: Distances, rng: np.random.Generator, margin: float) -> np.ndarray | None:
    lower, upper = C.getJointLimits()
    for _ in range(100):
        q = rng.uniform(lower + 0.05, upper - 0.05)
        if distances.least(q, margin + 2e-3) >= margin + 2e-3:
            return q
    return None


def planned(kind: str, seed: int, margin: float) -> tuple[ry.Config, ry.MotionPlan, Distances]:
    """A scene of this seed, in the start configuration, and a plan in it."""
    rng = np.random.default_rng([seed, kind == "arm"])
    while True:
        C = scene(kind, rng)
        distances = Distances(C)
        start, goal = free(C, distances, rng, margin), free(C, distances, rng, margin)
        if start is None or goal is None:
            continue
        C.setJointState(start)
        plan = ry.planMotion(C, goal, margin=margin, acceleration=4.0, max_evaluations=50000)
        if plan.feasible and len(plan.path) > 2:  # the straight line is blocked
            return C, plan, distances


def move(bot: ry.BotOp, plan: ry.MotionPlan) -> None:
    """Executes the path as control points, as slow as the limits require."""
    factor = 1.0
    while True:
        try:
            return bot.move(plan.path[1:], factor * plan.times[1:])
        except ry.ArgumentError as error:
            needed = re.search(r"take at least ([\d.e+]+) times", str(error))
            factor *= float(needed[1]) * 1.001 if needed else 1.5


def execute(C: ry.Config, plan: ry.MotionPlan, driver: ry.RobotDriver, follows: bool) -> np.ndarray:
    """q that the robot reports at each control period, from the start on."""
    bot, shown = ry.BotOp(C, driver=driver), C.copy()
    if follows:
        bot.follow(plan)
    else:
        move(bot, plan)
    Q = [bot.get_q()]
    while bot.getTimeToEnd() > 0:
        bot.sync(shown, PERIOD)
        Q.append(shown.getJointState())
    bot.close()
    return np.array(Q)


WAYS = {
    "follow, kinematic": lambda C, plan: execute(C, plan, ry.KinematicDriver(C), True),
    "follow, simulated": lambda C, plan: execute(C, plan, ry.SimulatedDriver(C), True),
    "move, kinematic": lambda C, plan: execute(C, plan, ry.KinematicDriver(C), False),
}


def measured(C: ry.Config, plan: ry.MotionPlan, distances: Distances, Q: np.ndarray) -> tuple[float, float]:
    """The least distance beyond the plan's margin, m, and the largest distance of q from the plan at the same time."""
    least = min(distances.least(q, plan.margin + 0.02) for q in Q) - plan.margin
    return least, max(np.abs(q - plan.eval(PERIOD * k)[0]).max() for k, q in enumerate(Q))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plans", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--margin", type=float, default=0.01)
    options = parser.parse_args()
    results: dict[str, list[tuple[float, float]]] = {way: [] for way in WAYS}
    begun, refused = perf_counter(), 0
    for i in range(options.plans):
        C, plan, distances = planned(("arm", "panda")[i % 2], options.seed + i // 2, options.margin)
        try:
            runs = {way: run(C, plan) for way, run in WAYS.items()}
        except ry.ArgumentError:  # plans do not know limits of torque
            refused += 1
            continue
        for way, Q in runs.items():
            results[way].append(measured(C, plan, distances, Q))
    print(
        f"{options.plans} plans, {refused} of them beyond limits of torque, with a margin of {1e3 * options.margin:.1f} mm, {perf_counter() - begun:.0f} s"
    )
    print(
        f"{'':20}{'beyond the margin, mm: least':>30}{'median':>9}{'violated by > .2 mm':>22}{'from the plan, mrad':>22}"
    )
    for way, rows in results.items():
        beyond, off = np.array(rows).T
        print(
            f"{way:20}{1e3 * beyond.min():30.3f}{1e3 * np.median(beyond):9.3f}{np.sum(beyond < -2e-4):22}"
            f"{1e3 * off.max():22.4f}"
        )


if __name__ == "__main__":
    main()
