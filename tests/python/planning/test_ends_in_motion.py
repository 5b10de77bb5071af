"""Motions that begin or end with small velocities, or with accelerations that few motions have."""

import numpy as np
import pytest

import kinegraph as ry


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


@pytest.mark.parametrize("speed", [1e-9, 1e-6, 1e-4])
@pytest.mark.parametrize("jerk", [None, 30.0])
def test_tiny_velocities_cost_no_time(speed: float, jerk: float | None) -> None:
    C = panda()
    goal = C.getJointState() + np.array([0.3, 0.2, -0.2, 0.1, 0.2, -0.1, 0.2])
    velocity = [speed, 0, 0, -speed, 0, 0, 0]
    limits = {"jerk": jerk} if jerk else {}
    rest = ry.planMotion(C, goal, **limits)
    ends = ry.planMotion(C, goal, end_velocity=velocity, **limits)
    begins = ry.planMotion(C, goal, start_velocity=velocity, **limits)
    for plan in (ends, begins):
        assert plan.feasible and plan.duration < 2 * rest.duration + 0.5
    assert ends.eval(ends.duration)[1] == pytest.approx(velocity, abs=1e-11)
    assert begins.eval(0)[1] == pytest.approx(velocity, abs=1e-11)


def test_motions_with_accelerations_at_an_end_do_not_crawl() -> None:
    C = panda()
    rng, limits = np.random.default_rng(9), C.getJointLimits()
    fastest = 0.9 * C.getVelocityLimits()
    tried = 0
    while tried < 40:
        start, goal = rng.uniform(*limits), rng.uniform(*limits)
        if not C.isValid(start) or not C.isValid(goal):
            continue
        velocity = np.clip(rng.normal(size=7) * 10 ** rng.uniform(-3, -0.2), -fastest, fastest)
        acceleration = rng.uniform(-2, 2, 7)
        plan = ry.planMotion(
            C, goal, start, acceleration=5.0, jerk=60.0, start_velocity=velocity, start_acceleration=acceleration
        )
        assert not plan.feasible or plan.duration < 30, plan.duration
        tried += 1


def test_an_end_velocity_needs_a_finite_acceleration() -> None:
    C = panda()
    with pytest.raises(ry.ArgumentError, match="end_velocity needs a finite limit"):
        ry.planMotion(C, C.getJointState() + 0.1, end_velocity=[0.2] * 7, acceleration=np.inf)
