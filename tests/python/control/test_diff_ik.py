"""Differential inverse kinematics: constraints that hold in each step, and reports of relaxed ones."""

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


def least_of(H, g, A, b):
    """The x that minimizes x' H x / 2 + g' x subject to A x >= b: multipliers by scipy's nnls, then the rows that
    hold."""
    nnls = pytest.importorskip("scipy.optimize").nnls
    L = np.linalg.cholesky(H)
    turned, free = np.linalg.solve(L, A.T), -np.linalg.solve(L, g)
    short = b - turned.T @ free  # by which the free minimum misses each row; scaled, so that nnls sees numbers near one
    scale = max(np.max(np.abs(short)), 1e-12)
    u = nnls(np.vstack([turned, short / scale]), np.append(np.zeros(len(g)), 1.0))[0]
    held = np.flatnonzero(u > 1e-9 * max(u.max(), 1.0))
    K = np.block([[H, -A[held].T], [A[held], np.zeros((len(held), len(held)))]])
    return np.linalg.solve(K, np.append(-g, b[held]))[: len(g)]


@pytest.mark.parametrize("below", [False, True])
def test_a_step_is_the_answer_of_another_solver_to_the_program_of_the_manual(panda, below):
    fastest, posture, damping, margin, share, reach = 1.0, 1e-2, 1e-9, 0.01, 0.5, 0.1
    ik = ry.DiffIk(panda, velocity=fastest, posture=posture, damping=damping)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"], gain=0.5)
    start, home = np.array(panda.getFrame("target").getPosition()), np.array(panda.getJointState())
    lower, upper = panda.getJointLimits()
    held = 0
    for i in range(300):
        way = [0.4 * np.sin(0.02 * i), 0, -0.004 * i if below else 0.002 * i]
        panda.getFrame("target").setPosition(start + way)
        q = np.array(panda.getJointState())
        y, J = (np.array(part) for part in panda.eval(ry.FS.poseDiff, ["l_gripper", "target"]))
        d, D = (np.array(part) for part in panda.eval(ry.FS.pairCollisions, []))
        near = (d > -reach) & np.any(D != 0, axis=1)
        H = J.T @ J + (posture**2 + damping) * np.eye(7)
        g = 0.5 * J.T @ y + posture**2 * (q - home)
        low = -np.minimum(fastest * STEP, q - lower)
        high = np.minimum(fastest * STEP, upper - q)
        A = np.vstack([np.eye(7), -np.eye(7), -D[near]])
        b = np.concatenate([low, -high, -share * (-d[near] - margin)])
        ik.reset()  # without the damping of joints that move to and fro
        velocity = ik.step(STEP)
        assert np.max(np.abs(velocity - least_of(H, g, A, b) / STEP)) < 1e-9
        held = max(held, len(ik.active))
    assert held >= 2


def test_the_next_priority_uses_the_directions_that_tasks_leave_free(panda):
    wanted = panda.getJointState() + np.array([0.5, 0.4, -0.3, 0.2, 0.1, 0.2, 0.3])

    def along_what_is_open():
        J = np.array(panda.eval(ry.FS.poseDiff, ["l_gripper", "target"])[1])
        return abs(np.linalg.svd(J)[2][-1] @ (wanted - panda.getJointState()))

    ik = ry.DiffIk(panda, velocity=2.0)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    ik.addTask(ry.FS.qItself, [], target=wanted, gain=0.05, weight=100.0, priority=1)
    assert along_what_is_open() > 0.1
    for _ in range(400):
        ik.step(STEP)
    assert np.linalg.norm(panda.eval(ry.FS.poseDiff, ["l_gripper", "target"])[0]) < 1e-4
    assert along_what_is_open() < 1e-4


def test_an_equality_comes_before_tasks_and_says_when_it_gives_way(panda):
    ik = ry.DiffIk(panda, velocity=1.0)
    ik.addEquality(ry.FS.vectorZ, "l_gripper", target=panda.eval(ry.FS.vectorZ, ["l_gripper"])[0])
    ik.addTask(ry.FS.positionDiff, ["l_gripper", "target"], weight=100.0)
    panda.getFrame("target").setPosition(panda.getFrame("target").getPosition() + np.array([0.3, 0.1, 0]))
    upright = np.array(panda.eval(ry.FS.vectorZ, ["l_gripper"])[0])
    for _ in range(200):
        ik.step(STEP)
        assert ik.status == ry.DiffIkStatus.solved, ik.message
    assert np.max(np.abs(panda.eval(ry.FS.vectorZ, ["l_gripper"])[0] - upright)) < 1e-4
    assert np.linalg.norm(panda.eval(ry.FS.positionDiff, ["l_gripper", "target"])[0]) < 1e-3
    panda.getFrame("target").setPosition([0, 0, 9])
    strict = ry.DiffIk(panda, velocity=1.0)
    strict.addEquality(ry.FS.positionDiff, ["l_gripper", "target"])
    strict.step(STEP)
    assert strict.status == ry.DiffIkStatus.constraints_relaxed
    assert "equality positionDiff" in strict.message
