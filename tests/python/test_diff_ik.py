"""Differential inverse kinematics: what is kept in each step, and what is said when it cannot be."""

import numpy as np
import pytest

import kinegraph as ry

STEP = 0.005
KEPT = 1e-9


@pytest.fixture
def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("target").setPose(C.getFrame("l_gripper").getPose())
    return C


def test_a_moving_target_is_followed(panda):
    ik = ry.DiffIk(panda, velocity=2.0)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    start = np.array(panda.getFrame("target").getPosition())
    errors = []
    for i in range(400):
        angle = 2 * STEP * i
        panda.getFrame("target").setPosition(start + 0.1 * np.array([np.sin(angle), 1 - np.cos(angle), 0]))
        velocity = ik.step(STEP)
        assert np.max(np.abs(velocity)) <= 2 + KEPT
        assert ik.status == ry.DiffIkStatus.solved, ik.message
        errors.append(np.linalg.norm(panda.eval(ry.FS.positionDiff, ["l_gripper", "target"])[0]))
    assert np.mean(errors[50:]) < 1e-4


def test_a_target_below_the_table_is_not_reached_through_it(panda):
    ik = ry.DiffIk(panda, velocity=2.0, acceleration=20.0)
    ik.addTask(ry.FS.positionDiff, ["l_gripper", "target"])
    position = np.array(panda.getFrame("target").getPosition())
    position[2] = panda.getFrame("table").getPosition()[2] - 0.1
    panda.getFrame("target").setPosition(position)
    lower, upper = panda.getJointLimits()
    before = np.zeros(7)
    for _ in range(400):
        velocity = ik.step(STEP)
        q = np.array(panda.getJointState())
        assert np.max(np.abs(velocity - before)) <= 20 * STEP + KEPT
        assert np.all(q >= lower - KEPT)
        assert np.all(q <= upper + KEPT)
        before = velocity
    panda.computeCollisions()
    assert panda.coll_totalViolation() <= 1e-6
    assert any("table" in row for row in ik.active)


def test_a_step_without_apply_leaves_the_scene(panda):
    ik = ry.DiffIk(panda, velocity=1.0)
    ik.addTask(ry.FS.position, "l_gripper", target=[0.3, 0.3, 1.2])
    q = np.array(panda.getJointState())
    velocity = ik.step(STEP, apply=False)
    assert np.linalg.norm(velocity) > 0
    np.testing.assert_array_equal(panda.getJointState(), q)
    np.testing.assert_array_equal(ik.velocity, velocity)


def test_mistakes_are_named(panda):
    with pytest.raises(ry.ArgumentError, match="velocity has entries that are not positive"):
        ry.DiffIk(panda, velocity=-1)
    ik = ry.DiffIk(panda)
    with pytest.raises(ry.FrameNotFound, match="l_gripper"):
        ik.addTask(ry.FS.position, "l_griper")
    with pytest.raises(ry.ArgumentError, match="gain is 2"):
        ik.addTask(ry.FS.position, "l_gripper", gain=2)
    with pytest.raises(ry.ArgumentError, match="no task 3"):
        ik.setTarget(3, 0)
    with pytest.raises(ry.ArgumentError, match="dt is 0"):
        ik.step(0)


def test_with_limited_accelerations_it_brakes_before_the_table() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("target").setPose(C.getFrame("l_gripper").getPose())
    ik = ry.DiffIk(C, velocity=2.0, acceleration=20.0, margin=0.01)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    C.getFrame("target").setPosition(np.array(C.getFrame("target").getPosition()) - [0, 0, 1.0])
    before = np.zeros(7)
    for _ in range(400):
        velocity = np.array(ik.step(0.005))
        assert ik.status == ry.DiffIkStatus.solved, ik.message
        assert np.all(np.abs(velocity - before) <= 20.0 * 0.005 + 1e-9)
        before = velocity
        assert all(distance > 0.0095 for _, _, distance in C.getCollisions(0.02))
