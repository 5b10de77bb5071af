"""Demonstration: inverse kinematics with a hard constraint, solved repeatedly for a wandering target."""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass, field

import numpy as np

from ._core import FS, KOMO, OT, ST, Config, Frame, NLP_Solver, SolverReturn
from .model_paths import raiPath

_HOME = [0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]
_REACH = 0.3  # largest distance of the target from its start, m


@dataclass
class Summary:
    """Results of `followTarget`."""

    solves: int = 0
    infeasible: int = 0
    worst_error: float = 0.0  # largest distance of the gripper from the target, m
    times: list[float] = field(default_factory=list)  # per solve, including the creation of the problem, s

    def add(self, seconds: float, error: float, feasible: bool) -> None:
        self.solves += 1
        self.infeasible += not feasible
        self.worst_error = max(self.worst_error, error)
        self.times.append(seconds)

    def __str__(self) -> str:
        median = statistics.median(self.times) * 1e6 if self.times else 0.0
        text = (
            f"{self.solves} solves, worst position error {self.worst_error * 1e3:.2g} mm, median time {median:.0f} µs"
        )
        return text + (f", {self.infeasible} infeasible" if self.infeasible else "")


def _solve(config: Config) -> tuple[np.ndarray, SolverReturn]:
    """Solves the tutorial's inverse kinematics: near the present configuration, near home, and exactly at the
    target."""
    komo = KOMO(config, 1, 1, 0, False)
    komo.addObjective([], FS.jointState, [], OT.sos, [1e-1], config.getJointState())
    komo.addObjective([], FS.jointState, [], OT.sos, [1e-1], _HOME)
    komo.addObjective([], FS.positionDiff, ["l_gripper", "target"], OT.eq, [1e1])
    result = NLP_Solver(komo.nlp(), verbose=0).solve()
    return komo.getPath()[0], result


def _wander(target: Frame, center: np.ndarray, rng: np.random.Generator, velocity: np.ndarray, dt: float) -> np.ndarray:
    """Moves the target a little. It drifts at random, is attracted to the center, and stays within the arm's reach.
    Returns its new velocity."""
    offset = target.getPosition() - center
    velocity = velocity + dt * (-3.0 * offset - 1.5 * velocity) + np.sqrt(dt) * 0.5 * rng.standard_normal(3)
    offset = offset + dt * velocity
    distance = float(np.linalg.norm(offset))
    if distance > _REACH:
        outward = offset / distance
        offset = _REACH * outward
        velocity = velocity - max(0.0, velocity @ outward) * outward
    target.setPosition(center + offset)
    return velocity


def followTarget(seconds: float = 20.0, rate: float = 60.0, seed: int = 0, view: bool = True) -> Summary:
    """Follows a wandering target with a Franka Panda and prints a line per second.

    Args:
        seconds: Duration; inf runs until Ctrl-C.
        rate: Targets per second; 0 means as many as possible.
        seed: Seed of the target's path.
        view: Whether to show the motion in the browser.
    Returns:
        Counts, times and the worst error.
    """
    config = Config()
    config.addFile(raiPath("scenarios/pandaSingle.g"))
    target = config.addFrame("target", "table").setShape(ST.marker, [0.15]).setRelativePosition([0.0, 0.3, 0.5])
    if view:
        config.view(False, "kinegraph demo: the gripper follows the target")
    total, recent = Summary(), Summary()
    center, velocity, rng = target.getPosition(), np.zeros(3), np.random.default_rng(seed)
    start = next_line = time.perf_counter()
    next_line += 1.0
    try:
        while (now := time.perf_counter()) - start < seconds:
            velocity = _wander(target, center, rng, velocity, 1.0 / (rate or 60.0))
            before = time.perf_counter()
            q, result = _solve(config)
            took = time.perf_counter() - before
            config.setJointState(q)
            error = float(np.linalg.norm(config.eval(FS.positionDiff, ["l_gripper", "target"])[0]))
            for summary in (total, recent):
                summary.add(took, error, result.feasible)
            if view:
                config.view()
            if now >= next_line:
                print(f"{now - start:4.0f} s: {recent}", flush=True)
                recent, next_line = Summary(), next_line + 1.0
            if rate:
                time.sleep(max(0.0, now + 1.0 / rate - time.perf_counter()))
    except KeyboardInterrupt:
        print()
    print(f"total: {total}", flush=True)
    return total
