"""Inverse kinematics in one call."""

import pickle
import threading
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kinegraph as ry
from interrupts import interrupt_after

DOWN = [0.0, 0.0, -1.0]
REACHABLE = [0.3, 0.3, 1.1]


def pandaScene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def randomJoints(C, count: int, seed: int) -> np.ndarray:
    low, high = C.getJointLimits()
    return low + np.random.default_rng(seed).random((count, len(low))) * (high - low)


def posesOf(C, frame: str, Q) -> np.ndarray:
    """World poses of a frame for rows of joint states; the scene does not change."""
    before = C.getJointState()
    poses = []
    for q in Q:
        C.setJointState(q)
        poses.append(C.getFrame(frame).getPose())
    C.setJointState(before)
    return np.array(poses)


def missOf(C, frame: str, pose, q) -> tuple[float, float]:
    """Distance (m) and angle (rad) between a frame and a pose at q."""
    reached = posesOf(C, frame, [q])[0]
    chord = min(np.linalg.norm(reached[3:] - pose[3:]), np.linalg.norm(reached[3:] + pose[3:]))
    return float(np.linalg.norm(reached[:3] - pose[:3])), float(4 * np.arcsin(min(1.0, chord / 2)))


def test_reachable_poses_are_reached_to_the_tolerance(panda):
    poses = posesOf(panda, "l_gripper", randomJoints(panda, 1000, 0))
    results = ry.solveIk(panda, {"l_gripper": poses}, collisions=False)
    assert len(results) == 1000 and results.q.shape == (1000, 7)
    assert results.feasible.mean() >= 0.999
    for pose, q in zip(poses[results.feasible][:200], results.q[results.feasible]):
        distance, angle = missOf(panda, "l_gripper", pose, q)
        assert distance <= 1.001e-6 and angle <= 1.1e-6


def test_answers_do_not_collide(panda):
    poses = posesOf(panda, "l_gripper", randomJoints(panda, 60, 1))
    results = ry.solveIk(panda, {"l_gripper": poses})
    assert results.feasible.sum() > 30
    for q in results.q[results.feasible]:
        panda.setJointState(q)
        assert panda.coll_totalViolation() == 0.0


def test_the_margin_is_satisfied(panda):
    result = ry.solveIk(panda, {"l_gripper": REACHABLE}, margin=0.03)
    assert result.feasible
    panda.setJointState(result.q)
    assert all(distance >= 0.03 - 1e-9 for *_, distance in panda.getCollisions(0.05))


def test_the_configuration_stays_unless_it_is_asked_to_move(panda):
    before = panda.getJointState()
    result = ry.solveIk(panda, {"l_gripper": REACHABLE})
    assert result and (panda.getJointState() == before).all()
    ry.solveIk(panda, {"l_gripper": REACHABLE}, apply=True)
    assert (panda.getJointState() == result.q).all()
    assert np.linalg.norm(panda.getFrame("l_gripper").getPosition() - REACHABLE) <= 1.001e-6
    assert not ry.solveIk(panda, {"l_gripper": [5, 0, 0]}, apply=True)
    assert (panda.getJointState() == result.q).all()


def test_targets_have_many_forms(panda):
    panda.addFrame("target").setPosition([0.3, 0.3, 1.1]).setQuaternion([0.0, 1.0, 0.0, 0.0])
    pose = np.array([0.3, 0.3, 1.1, 0.0, 1.0, 0.0, 0.0])
    matrix = np.diag([1.0, -1.0, -1.0, 1.0])
    matrix[:3, 3] = pose[:3]
    answers = [
        ry.solveIk(panda, {"l_gripper": wish}).q
        for wish in (pose, list(pose), matrix, "target", panda.getFrame("target"), {"pose": pose}, {"pose": "target"})
    ]
    answers.append(ry.solveIk(panda, {panda.getFrame("l_gripper"): pose}).q)
    for q in answers:
        np.testing.assert_allclose(q, answers[0], atol=1e-9)
    distance, angle = missOf(panda, "l_gripper", pose, answers[0])
    assert distance <= 1.001e-6 and angle <= 1.1e-6


def test_a_dict_asks_for_a_position_and_directions_of_axes(panda):
    result = ry.solveIk(panda, {"l_gripper": {"position": REACHABLE, "z": DOWN}}, apply=True)
    assert result.feasible
    gripper = panda.getFrame("l_gripper")
    np.testing.assert_allclose(gripper.getPosition(), REACHABLE, atol=1.001e-6)
    np.testing.assert_allclose(gripper.getRotationMatrix()[:, 2], DOWN, atol=1.1e-6)


def test_a_target_out_of_reach_is_explained(panda):
    result = ry.solveIk(panda, {"l_gripper": [3.0, 0.0, 0.7]})
    assert not result and not result.feasible and result.status == ry.IkStatus.goal_unreachable
    assert "frame 'l_gripper' misses its position by" in result.message and result.message in repr(result)
    assert result.attempts == 100 and 1.0 < result.position_error < 3.0


def test_a_target_inside_an_obstacle_is_explained(panda):
    panda.addFrame("wall").setShape(ry.ST.sphere, [0.25]).setPosition(REACHABLE).setContact(1)
    result = ry.solveIk(panda, {"l_gripper": REACHABLE}, attempts=20)
    assert not result and "reached the targets in collision, most often of" in result.message
    assert "'wall'" in result.message
    assert ry.solveIk(panda, {"l_gripper": REACHABLE}, collisions=False)


def test_a_limit_that_binds_is_named():
    C = ry.Config()
    C.addText("world {}  arm (world) { joint: hingeZ, limits: [-1 1] }  tip (arm) { pose: [1 0 0] }")
    result = ry.solveIk(C, {"tip": [-1.0, 0.5, 0.0]})
    assert "joint 'arm' is at its upper limit 1" in result.message


def test_two_arms_reach_at_once():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    left, right = (C.getFrame(f"{side}_gripper").getPosition() for side in "lr")
    wishes = {"l_gripper": 0.6 * left + 0.4 * right, "r_gripper": 0.4 * left + 0.6 * right}
    assert ry.solveIk(C, wishes, apply=True)
    for frame, position in wishes.items():
        np.testing.assert_allclose(C.getFrame(frame).getPosition(), position, atol=1.001e-6)
    assert C.coll_totalViolation() == 0.0


def test_answers_are_the_same_at_any_number_of_threads(panda):
    poses = posesOf(panda, "l_gripper", randomJoints(panda, 64, 2))
    one = ry.solveIk(panda, {"l_gripper": poses}, attempts=10)
    for threads in (2, 5):
        many = ry.solveIk(panda, {"l_gripper": poses}, attempts=10, threads=threads)
        assert (many.q == one.q).all() and (many.evals == one.evals).all() and many.message == one.message
    assert (ry.solveIk(panda, {"l_gripper": poses[7]}, attempts=10).q == one[7].q).all()


def test_rows_of_several_targets_go_together_and_single_ones_serve_all():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    left, right = (C.getFrame(f"{side}_gripper").getPosition() for side in "lr")
    rows = left + np.array([[0, 0, 0.05 * i] for i in range(4)])
    results = ry.solveIk(C, {"l_gripper": rows, "r_gripper": right})
    assert results.feasible.all() and len(results) == 4
    for row, q in zip(rows, results.q):
        C.setJointState(q)
        np.testing.assert_allclose(C.getFrame("l_gripper").getPosition(), row, atol=1.001e-6)
        np.testing.assert_allclose(C.getFrame("r_gripper").getPosition(), right, atol=1.001e-6)


def test_best_is_the_nearest_to_the_present_configuration(panda):
    first = ry.solveIk(panda, {"l_gripper": {"position": REACHABLE, "z": DOWN}})
    best = ry.solveIk(panda, {"l_gripper": {"position": REACHABLE, "z": DOWN}}, best=True, attempts=30)
    start = panda.getJointState()
    assert best and np.linalg.norm(best.q - start) <= np.linalg.norm(first.q - start) + 1e-6


def test_options_and_results_pickle(panda):
    options = ry.IkOptions(tolerance=1e-4, attempts=7, best=True, seed=3)
    assert pickle.loads(pickle.dumps(options)) == options != ry.IkOptions()
    assert options.position_tolerance == options.rotation_tolerance == 1e-4
    result = ry.solveIk(panda, {"l_gripper": [3.0, 0.0, 0.7]}, options)
    again = pickle.loads(pickle.dumps(result))
    assert (again.q == result.q).all() and repr(again) == repr(result) and again.status == result.status
    results = ry.solveIk(panda, {"l_gripper": [REACHABLE, [3.0, 0.0, 0.7]]}, options)
    again = pickle.loads(pickle.dumps(results))
    assert (again.q == results.q).all() and list(again.feasible) == [True, False] and again.message == results.message


def test_options_say_what_is_wrong(panda):
    for wrong, words in {
        "colisions": "no option 'colisions'.*similar names: collisions",
        "attempts": "attempts is 0; expected at least 1",
        "tolerance": "position_tolerance is -1; expected a positive number, in m",
        "margin": "margin is 'wide'; expected a number",
    }.items():
        value = {"attempts": 0, "tolerance": -1.0, "margin": "wide"}.get(wrong, False)
        with pytest.raises(ry.ArgumentError, match=words):
            ry.solveIk(panda, {"l_gripper": REACHABLE}, **{wrong: value})
        with pytest.raises(ry.ArgumentError, match=words):
            ry.IkOptions(**{wrong: value})
    options = ry.IkOptions()
    with pytest.raises(ry.ArgumentError, match="attempts is -3"):
        options.attempts = -3
    assert options.attempts == 100


def test_options_say_what_they_mean():
    fields = ry.IkOptions().dict()
    for name, default in fields.items():
        assert f"Default {default}" in getattr(ry.IkOptions, name).__doc__, name
    assert "in rad" in ry.IkOptions.rotation_tolerance.__doc__
    assert ry.IkOptions(attempts=1e2, best=1).dict() == fields | {"best": True}


@pytest.mark.parametrize(
    "targets, words",
    [
        ({"l_gripper": [1, 2]}, r"targets\['l_gripper'\] has shape \(2,\); expected \(3,\) = x y z"),
        ({"l_gripper": np.zeros((4, 6))}, r"has shape \(4, 6\)"),
        ({"l_gripper": [0, 0, float("nan")]}, "not finite"),
        ({"l_gripper": [0, 0, 0, 0, 0, 0, 0]}, "quaternion"),
        ({"l_gripper": 2 * np.eye(4)}, "is not a pose"),
        ({"l_gripper": None}, "is of type NoneType"),
        ({"l_gripper": {"posiiton": [0, 0, 0]}}, "has the key 'posiiton'.*similar names: position"),
        ({"l_gripper": {"z": [0, 0, 0]}}, "direction is zero"),
        ({"l_gripper": [[0, 0, 1]] * 2, "l_palm": [[0, 0, 1]] * 3}, "has 3 rows, but .*l_gripper.* has 2"),
        ({"table": [0, 0, 0]}, "no active joint moves frame 'table'"),
        ({7: [0, 0, 0]}, "a key of targets is of type int"),
        ({}, "no targets"),
        ([0, 0, 0], "targets is of type list; expected a dict"),
    ],
)
def test_targets_say_what_is_wrong(panda, targets, words):
    with pytest.raises(ry.ArgumentError, match=words):
        ry.solveIk(panda, targets)


def test_unknown_frames_are_named_with_the_nearest(panda):
    with pytest.raises(ry.FrameNotFound, match="'l_griper'.*l_gripper"):
        ry.solveIk(panda, {"l_griper": REACHABLE})
    with pytest.raises(ry.FrameNotFound, match="'tabel'.*table"):
        ry.solveIk(panda, {"l_gripper": "tabel"})


@pytest.mark.parametrize("threads", [1, 2])
def test_control_c_ends_a_long_search(panda, threads):
    """Without it, this search would take hours."""
    far = np.tile([5.0, 0.0, 0.0], (100, 1))
    with pytest.raises(KeyboardInterrupt), interrupt_after(0.3):
        ry.solveIk(panda, {"l_gripper": far}, attempts=10_000_000, threads=threads)


def test_other_threads_run_meanwhile(panda):
    ticks = 0
    done = threading.Event()

    def count():
        nonlocal ticks
        while not done.is_set():
            ticks += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    for attempts in [200, 2_000, 20_000, 200_000]:  # generous, for busy machines
        before = ticks
        ry.solveIk(panda, {"l_gripper": np.tile([5.0, 0.0, 0.0], (20, 1))}, attempts=attempts)
        during = ticks - before
        if during > 1:
            break
    done.set()
    other.join()
    assert during > 1


def test_verbose_logs_how_it_ended(panda, caplog):
    caplog.set_level("INFO", "kinegraph")
    ry.solveIk(panda, {"l_gripper": REACHABLE}, verbose=1)
    ry.solveIk(panda, {"l_gripper": [REACHABLE, [3, 0, 0]]}, verbose=1, attempts=3)
    first, second = caplog.messages
    assert "solved in" in first and "1 of 2 solved" in second


scene = pandaScene()
angles = st.lists(st.floats(0, 1), min_size=7, max_size=7)


@settings(deadline=None, max_examples=60, derandomize=True)
@given(angles, angles, st.integers(0, 2**64 - 1))
def test_whatever_the_start_the_target_and_the_seed(target, start, seed):
    low, high = scene.getJointLimits()
    pose = posesOf(scene, "l_gripper", [low + np.array(target) * (high - low)])[0]
    scene.setJointState(low + np.array(start) * (high - low))
    result = ry.solveIk(scene, {"l_gripper": pose}, tolerance=1e-5, collisions=False, seed=seed)
    assert result.feasible, result.message
    assert (result.q >= low).all() and (result.q <= high).all()
    distance, angle = missOf(scene, "l_gripper", pose, result.q)
    assert distance <= 1.001e-5 and angle <= 1.01e-5


def test_each_problem_of_a_batch_may_have_its_own_start():
    C = pandaScene()
    Q = randomJoints(C, 40, 3)
    targets = {"l_gripper": {"pose": posesOf(C, "l_gripper", Q)}}
    near = ry.solveIk(C, targets, start=Q + 1e-3, collisions=False, attempts=1)
    assert all(near.feasible)
    assert np.abs(near.q - Q).max() < 0.01  # the branch of each start
    far = ry.solveIk(C, targets, collisions=False)
    assert np.abs(far.q - Q).max(axis=1).min() > 0.01
    again = ry.solveIk(C, targets, start=Q + 1e-3, collisions=False, attempts=1, threads=2)
    np.testing.assert_array_equal(again.q, near.q)
    one = {"l_gripper": {"position": posesOf(C, "l_gripper", Q[:1])[0, :3]}}
    best = ry.solveIk(C, one, start=Q[0], best=True, collisions=False)
    np.testing.assert_allclose(best.q, np.clip(Q[0], *C.getJointLimits()), atol=1e-4)  # nothing is nearer
    with pytest.raises(ry.errors.ArgumentError, match=r"start has shape \(39, 7\); expected \(7,\) or \(40, 7\)"):
        ry.solveIk(C, targets, start=Q[1:])
