"""Relative targets, gazes, the center of mass and features as targets of inverse kinematics."""

import pickle

import numpy as np
import pytest

import kinegraph as ry

MEET = {"l_gripper": [-0.1, 0.2, 1.1], "r_gripper": [0.1, 0.2, 1.1]}


@pytest.fixture
def pandas() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    return C


def test_a_hand_meets_a_place_that_the_other_one_carries(pandas):
    p, before = [0.05, -0.02, -0.15], pandas.getJointState()
    result = ry.solveIk(pandas, {"l_gripper": {"relativeTo": "r_gripper", "position": p, "z": [0, 0, -1]}}, apply=True)
    assert result, result.message
    moved = np.abs(result.q - before)
    assert moved[:7].max() > 1e-3 and moved[7:].max() > 1e-3
    assert pandas.eval(ry.FS.positionRel, ["l_gripper", "r_gripper"])[0] == pytest.approx(p, abs=2e-6)
    assert pandas.eval(ry.FS.vectorZRel, ["l_gripper", "r_gripper"])[0] == pytest.approx([0, 0, -1], abs=2e-6)


def test_relative_to_a_frame_alone_is_its_pose_wherever_it_goes(pandas):
    handle = pandas.addFrame("handle", "r_gripper").setRelativePose([0, 0, -0.2, 0, 1, 0, 0])
    result = ry.solveIk(pandas, {"l_gripper": {"relativeTo": handle}}, apply=True)
    assert result, result.message
    assert pandas.getFrame("l_gripper").getPosition() == pytest.approx(handle.getPosition(), abs=2e-6)
    assert pandas.eval(ry.FS.quaternionDiff, ["l_gripper", "handle"])[0] == pytest.approx([0, 0, 0, 0], abs=2e-6)


def test_the_answer_is_one_that_a_motion_problem_agrees_with(pandas):
    """KOMO's constraints hold at the answer, and KOMO reaches the same relative position by itself."""
    p = [0.05, -0.02, -0.15]
    result = ry.solveIk(pandas, {"l_gripper": {"relativeTo": "r_gripper", "position": p}}, best=True, attempts=20)
    komo = ry.KOMO(pandas, 1, 1, 0, True)
    komo.addControlObjective([], 0, 1.0)
    komo.addObjective([], ry.FS.positionRel, ["l_gripper", "r_gripper"], ry.OT.eq, [10.0], p)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0])
    solved = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert result.feasible and solved.feasible
    start = pandas.getJointState()
    away, komo_away = (np.linalg.norm(q - start) for q in (result.q, komo.getPath()[0]))
    assert away < 1.05 * komo_away  # both are nearest to the start, KOMO's only locally
    pandas.setJointState(komo.getPath()[0])
    assert pandas.eval(ry.FS.positionRel, ["l_gripper", "r_gripper"])[0] == pytest.approx(p, abs=1e-3)


def test_a_gaze_looks_at_a_point_or_a_frame(pandas):
    ball = pandas.addFrame("ball").setPosition([0.2, 0.5, 0.9])
    for at in ("ball", ball, ball.getPosition()):
        result = ry.solveIk(pandas, {"l_gripper": {"gaze": at, "axis": [0, 0, -1]}})
        assert result, result.message
        pandas.setJointState(result.q)
        x, y, z = pandas.eval(ry.FS.positionRel, ["ball", "l_gripper"])[0]
        assert z < 0 and abs(x) < 2e-6 and abs(y) < 2e-6


def test_a_gaze_follows_what_the_other_hand_carries(pandas):
    targets = {**MEET, "l_gripper": {"position": [-0.4, 0.1, 1.0], "gaze": "r_gripper"}}
    result = ry.solveIk(pandas, targets, apply=True)
    assert result, result.message
    assert pandas.eval(ry.FS.gazeAt, ["r_gripper", "l_gripper"])[0] == pytest.approx([0, 0], abs=2e-6)


def test_the_center_of_mass_goes_where_it_is_asked_to(pandas):
    before = pandas.getCenterOfMass()[1]
    wanted = before + np.array([0.03, 0.05, -0.02])
    result = ry.solveIk(pandas, {"centerOfMass": wanted}, apply=True)
    assert result, result.message
    assert pandas.getCenterOfMass()[1] == pytest.approx(wanted, abs=2e-6)
    flat = ry.solveIk(pandas, {"centerOfMass": {"target": before, "scale": [1, 1, 0], "tolerance": 1e-4}}, apply=True)
    assert flat and pandas.getCenterOfMass()[1][:2] == pytest.approx(before[:2], abs=1.1e-4)


def test_any_feature_has_its_target_to_its_tolerance(pandas):
    targets = {
        "l_gripper": [0, 0.3, 1.1],
        (ry.FS.scalarProductZZ, "l_gripper", "world"): {"target": 0.5, "tolerance": 1e-3},
    }
    result = ry.solveIk(pandas, targets)
    assert result.feasible and 0 < result.feature_error <= 1e-3 and "features within" in repr(result)
    pandas.setJointState(result.q)
    assert pandas.eval(ry.FS.scalarProductZZ, ["l_gripper", "world"])[0] == pytest.approx([0.5], abs=1e-3)
    again = pickle.loads(pickle.dumps(result))
    assert again.feature_error == result.feature_error and again.evals == result.evals


def test_a_bound_is_satisfied_and_violations_are_reported(pandas):
    apart = (ry.FS.distance, "l_palm", pandas.getFrame("r_palm"))
    result = ry.solveIk(pandas, {**MEET, apart: {"atMost": -0.25}}, apply=True)
    assert result, result.message
    assert pandas.eval(ry.FS.distance, ["l_palm", "r_palm"])[0][0] <= -0.25 + 1e-5
    result = ry.solveIk(pandas, {**MEET, apart: {"atMost": -5}}, attempts=5)
    assert not result and "feature distance of 'l_palm', 'r_palm' misses its bound by" in result.message


def test_rows_of_relative_targets_and_features_are_a_batch(pandas):
    points = np.array([0.0, 0.0, -0.2]) + np.random.default_rng(0).uniform(-0.1, 0.1, (12, 3))
    height = np.linspace(0.3, 0.4, 12)[:, None]
    targets = {
        "l_gripper": {"relativeTo": "r_gripper", "position": points},
        (ry.FS.scalarProductXX, "r_gripper", "world"): height,
    }
    one, two = ry.solveIk(pandas, targets), ry.solveIk(pandas, targets, threads=2)
    assert np.array_equal(one.q, two.q) and one.feature_error.shape == (12,) and one.feasible.sum() >= 11
    for i in np.flatnonzero(one.feasible):
        pandas.setJointState(one.q[i])
        assert pandas.eval(ry.FS.positionRel, ["l_gripper", "r_gripper"])[0] == pytest.approx(points[i], abs=2e-6)
        assert pandas.eval(ry.FS.scalarProductXX, ["r_gripper", "world"])[0] == pytest.approx(height[i], abs=2e-6)


@pytest.mark.parametrize("value", ["l_palm", {"pose": "l_palm"}, {"position": "l_palm"}, {"x": "l_palm"}])
def test_a_target_that_moves_with_the_robot_is_an_error_and_its_advice_helps(pandas, value):
    with pytest.raises(
        ry.ArgumentError,
        match="is the pose of frame 'l_palm', which moves with joint 'l_panda_joint7'.*relativeTo 'l_palm'",
    ):
        ry.solveIk(pandas, {"l_gripper": value, "r_gripper": [0.1, 0.2, 1.1]})
    numbers = pandas.getFrame("l_palm").getPose()
    assert ry.solveIk(pandas, {"l_gripper": numbers}, collisions=False)
    assert ry.solveIk(pandas, {"l_gripper": {"relativeTo": "r_palm", "position": [0, 0, -0.2]}})


def test_a_hand_that_stays_is_a_place_like_others(pandas):
    assert ry.solveIk(pandas, {"r_gripper": MEET["r_gripper"]}, apply=True)
    result = ry.solveIk(pandas, {"l_gripper": {"position": "r_gripper"}}, collisions=False, apply=True)
    assert result, result.message
    assert pandas.eval(ry.FS.positionDiff, ["l_gripper", "r_gripper"])[0] == pytest.approx([0, 0, 0], abs=2e-6)


@pytest.mark.parametrize(
    "targets, words",
    [
        (
            {"l_gripper": {"relativeTo": "l_palm", "position": [0, 0, 0]}},
            "no active joint moves frame 'l_gripper' relative to 'l_palm'",
        ),
        ({(ry.FS.position, "table"): [0, 0, 0]}, "no active joint changes feature position of 'table'"),
        ({(ry.FS.position, "l_gripper"): [0, 0]}, r"has shape \(2,\); expected \(3,\) or a number, or \(N, 3\)"),
        ({(ry.FS.position, "l_gripper"): {"tolerance": -1}}, "the tolerance of position is -1"),
        ({(ry.FS.position, "l_gripper"): {"tolerence": 1}}, "has the key 'tolerence'.*similar names: tolerance"),
        ({(ry.FS.position, "l_gripper"): {"target": 0, "atMost": 0}}, "expected one of them"),
        ({(ry.FS.angularVel, "l_gripper"): 0.0}, "expected a feature of one"),
        ({(ry.FS.positionDiff, "l_gripper"): 0.0}, "2 frames"),
        ({(ry.FS.position, 7): 0.0}, "is of type int"),
        ({"l_gripper": {"axis": [0, 0, 1]}}, "'axis' without 'gaze'"),
        ({"l_gripper": {"gaze": [0, 0, 1], "axis": [0, 0, 0]}}, "axis is zero"),
        ({"l_gripper": {}}, "is an empty dict"),
        ({"l_gripper": {"relativTo": "table"}}, "similar names: relativeTo"),
    ],
)
def test_targets_say_what_is_wrong(pandas, targets, words):
    with pytest.raises(ry.ArgumentError, match=words):
        ry.solveIk(pandas, targets)


def test_unknown_frames_of_any_target_are_named(pandas):
    for targets in (
        {"l_gripper": {"relativeTo": "r_griper"}},
        {"l_gripper": {"gaze": "r_griper"}},
        {(ry.FS.position, "r_griper"): 0.0},
    ):
        with pytest.raises(ry.FrameNotFound, match="'r_griper'.*r_gripper"):
            ry.solveIk(pandas, targets)
