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


CRAWLING = [  # start, goal, velocity and acceleration of motions that took 453 s to 1e12 s
    (
        [2.5696, 1.4642, 1.8281, -1.5215, -1.3225, 2.3366, 0.1572],
        [1.3472, 0.0072, 0.1978, -2.7362, 1.6245, 1.5467, 1.3839],
        [0.00252, 0.02719, 0.02705, 0.01967, -0.10185, -0.02055, -0.00723],
        [0.1587, -1.9493, -0.247, 1.5319, 1.9718, 0.7962, 1.8839],
    ),
    (
        [-0.3354, 0.088, -1.601, -0.1893, -2.0157, 2.2247, -0.4314],
        [-0.2101, 0.1044, -0.5366, -1.4508, 1.7431, 1.0893, -1.0522],
        [-0.06458, -0.48613, 0.05958, -0.07016, -0.32041, -0.32077, -0.09449],
        [1.6086, -1.2482, -1.2046, 1.9859, -1.2195, 0.2654, -1.0772],
    ),
    (
        [1.9211, -1.6021, -0.2863, -2.2856, 2.8197, 1.6083, 1.0998],
        [-2.6145, 0.5585, -2.4327, -0.3163, 1.0896, 2.1883, 0.7449],
        [-6e-05, 0.00055, 0.00153, 0.00109, 0.00043, 0.00207, -0.00074],
        [1.7628, -1.8137, -1.801, -0.3072, -0.2472, -1.3261, -1.4902],
    ),
]


@pytest.mark.parametrize(("start", "goal", "velocity", "acceleration"), CRAWLING)
def test_motions_with_accelerations_at_the_start_do_not_crawl(start, goal, velocity, acceleration) -> None:
    C = panda()
    limits = {"acceleration": 5.0, "jerk": 60.0}
    rest = ry.planMotion(C, goal, start, **limits)
    plan = ry.planMotion(C, goal, start, start_velocity=velocity, start_acceleration=acceleration, **limits)
    assert rest.feasible and plan.feasible, plan
    assert plan.duration < 2 * rest.duration + 2
    assert plan.eval(0)[1] == pytest.approx(velocity, abs=1e-11)


def test_an_end_velocity_needs_a_finite_acceleration() -> None:
    C = panda()
    with pytest.raises(ry.ArgumentError, match="end_velocity needs a finite limit"):
        ry.planMotion(C, C.getJointState() + 0.1, end_velocity=[0.2] * 7, acceleration=np.inf)
