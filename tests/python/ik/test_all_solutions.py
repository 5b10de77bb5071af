"""solveIk(all=True): every branch, checked against single solutions from many starts."""

import numpy as np
import pytest

import kinegraph as ry


def same(a, b):
    return np.abs((a - b + np.pi) % (2 * np.pi) - np.pi).max(axis=-1) < 1e-3


@pytest.fixture
def arm():
    C = ry.Config()
    C.addFile(ry.raiPath("ur10/ur10.g"))
    return C


def test_single_solutions_from_other_starts_are_among_all(arm):
    rng = np.random.default_rng(4)
    pose = arm.getFrame("ur_ee_fixed_joint").getPose()
    present = arm.getJointState()
    solutions = ry.solveIk(arm, {"ur_ee_fixed_joint": pose}, all=True, collisions=False)
    assert isinstance(solutions, ry.IkResults)
    assert np.allclose(solutions[0].q, present, atol=1e-6)
    distances = np.linalg.norm(solutions.q - present, axis=1)
    assert (np.diff(distances) >= 0).all()
    found = set()
    for _ in range(100):
        arm.setJointState(rng.uniform(-np.pi, np.pi, 6))
        one = ry.solveIk(arm, {"ur_ee_fixed_joint": pose}, collisions=False)
        if one:
            assert same(solutions.q, one.q).any()
            found.add(int(np.argmax(same(solutions.q, one.q))))
    assert len(found) == len(solutions)  # each of them exists for the general method


def test_apply_sets_the_nearest_one_and_a_batch_is_refused(arm):
    pose = arm.getFrame("ur_ee_fixed_joint").getPose()
    arm.setJointState(arm.getJointState() + 0.1)
    solutions = ry.solveIk(arm, {"ur_ee_fixed_joint": pose}, all=True, apply=True, collisions=False)
    assert np.array_equal(arm.getJointState(), solutions[0].q)
    with pytest.raises(ry.ArgumentError, match="all needs a single problem"):
        ry.solveIk(arm, {"ur_ee_fixed_joint": np.stack([pose, pose])}, all=True)


def test_without_a_solution_the_only_result_says_why(arm):
    far = {"position": [9.0, 0, 0], "quaternion": [1, 0, 0, 0]}
    solutions = ry.solveIk(arm, {"ur_ee_fixed_joint": far}, all=True, collisions=False)
    assert len(solutions) == 1 and not solutions[0]
    assert "ur_ee_fixed_joint" in solutions[0].message
