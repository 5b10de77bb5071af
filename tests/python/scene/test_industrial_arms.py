"""The UR5e, UR10e and IRB 120 have the kinematics of their data sheets."""

import numpy as np
import pytest

import kinegraph as ry

HALF = np.pi / 2
# d, a, alpha of each joint, and offsets of its angle: the manufacturers' figures.
UR = [HALF, 0, 0, HALF, -HALF, 0]
ARMS = {
    "ur5e": ([0.1625, 0, 0, 0.1333, 0.0997, 0.0996], [0, -0.425, -0.3922, 0, 0, 0], UR, [0] * 6),
    "ur10e": ([0.1807, 0, 0, 0.17415, 0.11985, 0.11655], [0, -0.6127, -0.57155, 0, 0, 0], UR, [0] * 6),
    "irb120": (
        [0.29, 0, 0, 0.302, 0, 0.072],
        [0, 0.27, 0.07, 0, 0, 0],
        [-HALF, 0, -HALF, HALF, -HALF, 0],
        [0, -HALF, 0, 0, 0, np.pi],
    ),
}


def flange(d, a, alpha, offset, q):
    """The pose of the flange by Denavit-Hartenberg parameters, (4, 4)."""
    X = np.eye(4)
    for k in range(6):
        c, s, ca, sa = np.cos(q[k] + offset[k]), np.sin(q[k] + offset[k]), np.cos(alpha[k]), np.sin(alpha[k])
        X = X @ [[c, -s * ca, s * sa, a[k] * c], [s, c * ca, -c * sa, a[k] * s], [0, sa, ca, d[k]], [0, 0, 0, 1]]
    return X


def loaded(name):
    C = ry.Config()
    C.addFile(ry.raiPath(f"{name}/{name}.g"))
    return C


@pytest.mark.parametrize("name", ARMS)
def test_poses_are_those_of_the_data_sheet(name):
    C = loaded(name)
    lower, upper = C.getJointLimits()
    for q in np.random.default_rng(0).uniform(lower, upper, (50, 6)):
        C.setJointState(q)
        X = flange(*ARMS[name], q)
        assert np.abs(C.getFrame("tool0").getPosition() - X[:3, 3]).max() < 1e-12
        R = C.getFrame("tool0").getRotationMatrix()
        assert np.abs(R[:, 2] - X[:3, 2]).max() < 1e-12
        if name != "irb120":  # whose x axis of the flange is a convention
            assert np.abs(R - X[:3, :3]).max() < 1e-12


@pytest.mark.parametrize("name", ARMS)
def test_the_first_configuration_is_free_and_all_joints_have_limits(name):
    C = loaded(name)
    assert C.getTotalPenetration() < 1e-9
    lower, upper = C.getJointLimits()
    assert np.isfinite(lower).all() and np.isfinite(upper).all()
    assert np.isfinite(C.getVelocityLimits()).all()
    free = 0
    for q in np.random.default_rng(1).uniform(lower, upper, (200, 6)):
        C.setJointState(q)
        free += C.getTotalPenetration() < 1e-9
    assert 40 < free < 200  # shapes neither overlap all the time nor never meet


@pytest.mark.parametrize("name", ARMS)
def test_all_solutions_of_a_pose_have_closed_form(name):
    C = loaded(name)
    lower, upper = C.getJointLimits()
    counts = []
    for q in np.random.default_rng(2).uniform(lower, upper, (30, 6)):
        C.setJointState(q)
        pose = C.getFrame("tool0").getPose()
        C.setJointState(np.zeros(6))
        solutions = ry.solveIk(C, {"tool0": pose}, all=True, collisions=False)
        assert solutions.feasible.all() and len(solutions) <= 8
        turns = (solutions.q - q + np.pi) % (2 * np.pi) - np.pi
        assert np.abs(turns).max(axis=1).min() < 1e-4
        counts.append(len(solutions))
    assert max(counts) == 8 if name != "irb120" else max(counts) >= 4


@pytest.mark.parametrize("name", ARMS)
def test_a_tool_moves_along_a_line(name):
    C = loaded(name)
    start = C.getFrame("tool0").getPose()
    target = start[:3] + np.array([0, 0.15, 0.05])
    plan = ry.planToolPath(C, ry.ToolPath("tool0").line(target), speed=0.1)
    assert plan, plan.message
    C.setJointState(plan.eval(plan.duration)[0])
    assert np.allclose(C.getFrame("tool0").getPosition(), target, atol=1e-6)
