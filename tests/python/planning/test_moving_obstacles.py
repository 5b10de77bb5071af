"""planMotion among dynamic obstacles, MotionPlan.replan, and planMotions."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph as ry


@pytest.fixture
def cart(panda: ry.Config) -> ry.Config:
    """A Panda, and a load on a cart that can be anywhere."""
    panda.addFrame("cart").setPose([0, 2, 1, 1, 0, 0, 0])
    panda.addFrame("load", "cart").setShape(ry.ST.ssBox, [0.3, 0.3, 0.5, 0.02]).setContact(1)
    return panda


def ends(C: ry.Config) -> tuple[np.ndarray, np.ndarray]:
    start, goal = C.getJointState(), C.getJointState()
    start[0] -= 0.6
    goal[0] += 0.6
    return start, goal


def poseAt(times: np.ndarray, poses: np.ndarray, t: float) -> np.ndarray:
    pose = np.array([np.interp(t, times, column) for column in poses.T])
    pose[3:] /= np.linalg.norm(pose[3:])
    return pose


def leastOfTime(C: ry.Config, plan: ry.MotionPlan, tracks: dict, step: float = 2e-3, after: float = 1.0) -> float:
    """The least distance of links that q moves to any other body, every `step` s."""
    scene = ry.Config()
    scene.addConfigurationCopy(C)
    least = 1.0
    for t in np.arange(0, plan.duration + after, step):
        for name, (times, values) in tracks.items():
            if values.shape[1] == 7:
                scene.getFrame(name).setPose(poseAt(times, values, t))
            else:
                scene.getFrame(name).setJointState(np.array([np.interp(t, times, column) for column in values.T]))
        scene.setJointState(plan.eval(t)[0])
        for a, b, distance in scene.getCollisions(0.1):
            robot = {a.startswith(("l_", "panda")), b.startswith(("l_", "panda"))}
            if True in robot:
                least = min(least, distance)
    return least


TIMES = np.array([0.0, 2.0, 4.0])
POSES = np.array([[-0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 1.5, 1.1, 0.7, 0, 0, 0.7]])


@pytest.mark.parametrize("slower", [0.5, 1.0, 2.0])
def test_a_panda_keeps_clear_of_a_load_that_passes(cart: ry.Config, slower: float) -> None:
    start, goal = ends(cart)
    tracks = {"cart": (slower * TIMES, POSES)}
    plan = ry.planMotion(cart, goal, start, margin=0.01, obstacle_trajectories=tracks)
    assert plan.feasible, plan.message
    np.testing.assert_allclose(plan.path[0], start)
    np.testing.assert_allclose(plan.path[-1], goal)
    assert leastOfTime(cart, plan, tracks) >= 0.01 - 1e-6
    assert any("waits for" in note for note in plan.warnings)
    np.testing.assert_allclose(plan.obstaclesAt(slower)["cart"], poseAt(slower * TIMES, POSES, slower))
    assert plan.stages[-1]["name"] == "dynamic_timing"


def test_another_arm_moves_as_its_joints_are_told() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    left = [name for name in C.getJointNames() if name.startswith("l_")]
    right = [name for name in C.getJointNames() if name.startswith("r_")]
    q = C.getJointState()
    first = dict(zip(C.getJointNames(), q, strict=True))
    C.selectJoints(left)
    start = np.array([first[name] for name in left])
    goal = start.copy()
    start[0], goal[0] = start[0] - 0.6, goal[0] + 0.9
    times = np.array([0.0, 1.0, 2.5])
    tracks = {name: (times, np.full((3, 1), first[name])) for name in right}
    tracks[right[0]] = (times, first[right[0]] + np.array([[-0.9], [0.9], [-0.9]]))
    plan = ry.planMotion(C, goal, start, margin=0.005, obstacle_trajectories=tracks)
    assert plan.feasible, plan.message
    scene = ry.Config()
    scene.addConfigurationCopy(C)
    for t in np.arange(0, plan.duration + 0.5, 2e-3):
        for name, (at, values) in tracks.items():
            scene.getFrame(name).setJointState([np.interp(t, at, values[:, 0])])
        scene.setJointState(plan.eval(t)[0])
        pairs = {(a[:2], b[:2]): d for a, b, d in scene.getCollisions(0.02)}
        assert pairs.get(("l_", "r_"), 1.0) >= 0.005 - 1e-6 and pairs.get(("r_", "l_"), 1.0) >= 0.005 - 1e-6


def test_what_stands_at_the_goal_for_good_is_named(cart: ry.Config) -> None:
    start, goal = ends(cart)
    cart.setJointState(goal)
    hand = cart.getFrame("l_gripper").getPosition()
    cart.setJointState(start)
    poses = np.array([[hand[0], 2, hand[2], 1, 0, 0, 0], [*hand, 1, 0, 0, 0]])
    plan = ry.planMotion(cart, goal, start, obstacle_trajectories={"cart": ([0.0, 2.0], poses)}, max_evaluations=3000)
    assert plan.status == ry.PlanStatus.no_timing_found and "meets 'load', which stays there" in plan.message


def test_tracks_that_make_no_sense_are_refused(cart: ry.Config) -> None:
    q = cart.getJointState()
    for moving, said in [
        ({"cart": ([0.0], [[0.0, 0, 0]])}, "expected 7"),
        ({"cart": ([1.0, 0.0], np.tile(POSES[0], (2, 1)))}, "increasing"),
        ({"cart": [0.0]}, "expected a dict"),
        ([1], "expected a dict"),
        ({"l_gripper": ([0.0], POSES[:1])}, "moves with q"),
    ]:
        with pytest.raises(ry.ArgumentError, match=said):
            ry.planMotion(cart, q, obstacle_trajectories=moving)
    with pytest.raises(
        ry.ArgumentError, match="no option 'obstacle_trajectores'; similar names: obstacle_trajectories"
    ):
        ry.planMotion(cart, q, obstacle_trajectores={})
    with pytest.raises(ry.FrameNotFound):
        ry.planMotion(cart, q, obstacle_trajectories={"crt": ([0.0], POSES[:1])})


def test_a_robot_on_its_way_goes_on_to_another_goal(cart: ry.Config) -> None:
    start, goal = ends(cart)
    plan = ry.planMotion(cart, goal, start, margin=0.01)
    for share in (0.2, 0.5, 0.8):
        at = share * plan.duration
        other = goal + np.array([-0.8, 0.2, 0, 0, 0, 0.1, 0])
        bend = plan.replan(cart, at=at, goal=other)
        assert bend.feasible, bend.message
        q, velocity, _ = plan.eval(at)
        np.testing.assert_allclose(bend.eval(0)[0], q, atol=1e-12)
        np.testing.assert_allclose(bend.eval(0)[1], velocity, atol=1e-9)
        np.testing.assert_allclose(bend.eval(bend.duration)[0], other, atol=1e-12)
        assert leastOfTime(cart, bend, {}, 4e-3, 0.0) >= 0.01 - 1e-6
    same = plan.replan(cart, at=0.5 * plan.duration)
    assert same.duration == pytest.approx(0.5 * plan.duration, abs=0.02)
    with pytest.raises(ry.NotFound):
        plan.replan(cart, at=0.1, goal="nowhere")
    with pytest.raises(ry.ArgumentError, match="there is no motion"):
        ry.planMotion(cart, [0.0] * 7).replan(cart, at=0.1)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.6])
def test_what_moves_lets_a_robot_go_on_with_its_acceleration(cart: ry.Config, share: float) -> None:
    start, goal = ends(cart)
    limits = {"velocity": 1.5, "acceleration": 6.0, "jerk": 40.0, "margin": 0.01}
    plan = ry.planMotion(cart, goal, start, **limits)
    at = share * plan.duration
    other = goal + np.array([-0.8, 0.2, 0, 0, 0, 0.1, 0])
    poses = np.array([[0.8, 1.0, 1.1, 1, 0, 0, 0], [-0.1, 0.45, 1.1, 1, 0, 0, 0], [-1.2, 0.8, 1.1, 1, 0, 0, 0]])
    tracks = {"cart": (TIMES, poses)}
    for target in (None, other):
        bend = plan.replan(cart, at=at, goal=target, obstacle_trajectories=tracks)
        assert bend.feasible, bend.message
        assert not [note for note in bend.warnings if "without" in note]
        for before, after, tolerance in zip(plan.eval(at), bend.eval(0), (1e-12, 1e-9, 1e-6), strict=True):
            np.testing.assert_allclose(after, before, atol=tolerance)
        assert leastOfTime(cart, bend, tracks, 4e-3) >= 0.01 - 1e-6
        step = 1e-3
        states = [bend.eval(t) for t in np.arange(0, bend.duration, step)]
        for values, limit in zip((1, 2), (1.5, 6.0), strict=True):
            assert np.abs([state[values] for state in states]).max() <= limit * (1 + 1e-9)
        assert np.abs(np.diff([state[2] for state in states], axis=0)).max() <= 40 * step * (1 + 1e-6)


def test_a_running_bot_takes_a_new_plan_without_a_stop(cart: ry.Config) -> None:
    start, goal = ends(cart)
    limits = {"velocity": 0.6, "acceleration": 1.5, "margin": 0.01}
    cart.setJointState(start)
    bot = ry.BotOp(cart, False)
    plan = ry.planMotion(cart, goal, start, **limits)

    def sampled(motion: ry.MotionPlan) -> tuple[np.ndarray, np.ndarray]:
        times = np.linspace(0, motion.duration, 120)[1:]
        return np.array([motion.eval(t)[0] for t in times]), times

    path, times = sampled(plan)
    bot.move(path, times)
    bot.wait(cart, forKeyPressed=False, forTimeToEnd=False)
    while bot.get_t() < 0.4 * plan.duration:
        bot.sync(cart, 0.05)
    at = bot.get_t() + 0.1
    other = goal + np.array([-0.3, 0.3, 0, 0, 0, 0.1, 0])
    bend = plan.replan(cart, at=at, goal=other)
    assert bend.feasible, bend.message
    path, times = sampled(bend)
    bot.move(path, times, overwrite=True, overwriteCtrlTime=at)
    speeds, before = [], bot.get_qDot()
    while bot.getTimeToEnd() > 0:
        bot.sync(cart, 0.01)
        speeds.append(np.linalg.norm(bot.get_qDot()))
        assert np.abs(bot.get_qDot() - before).max() <= 0.01 * 3 * 1.5  # no jump
        before = bot.get_qDot()
        assert not [pair for pair in cart.getCollisions(0) if pair[2] < -1e-4 and "load" in pair[:2]]
    assert min(speeds[:20]) > 0.1  # it did not stop first
    np.testing.assert_allclose(bot.get_q(), other, atol=2e-3)


def test_plans_get_better_while_one_waits(cart: ry.Config) -> None:
    start, goal = ends(cart)
    cart.getFrame("cart").setPose([0, 0.35, 1.1, 1, 0, 0, 0])
    options = {"margin": 0.01, "optimize": "length", "restarts": 1, "improvement_evaluations": 20000}
    plans = list(ry.planMotions(cart, goal, start, **options))
    lengths = [plan.length for plan in plans]
    assert lengths == sorted(lengths, reverse=True) and len(set(lengths)) == len(lengths)
    for plan in plans:
        assert plan.feasible and leastOfTime(cart, plan, {}, 5e-3, 0.0) >= 0.01 - 1e-6
    last = ry.planMotion(cart, goal, start, threads=2, **options)
    np.testing.assert_array_equal(last.path, plans[-1].path)
    blocked = list(ry.planMotions(cart, [0.0] * 7, improvement_evaluations=10))
    assert len(blocked) == 1 and not blocked[0].feasible
    with pytest.raises(ry.ArgumentError, match="planMotions"):
        ry.planMotions(cart, goal, obstacle_trajectories={"cart": (TIMES, POSES)})
