"""Tool paths: distances from the curve by samples, limits by differences, failures with place and pair."""

import functools
import pickle
import time

import numpy as np
import pytest

import kinegraph as ry
from tool_motion import LIMITS, X, Y, Z, distance_from_line, poses, samples


def shares(C, q, h):
    """The largest velocity, acceleration and jerk by differences, as shares of their limits."""
    v, a, j = (np.diff(q, k, axis=0) / h**k for k in (1, 2, 3))
    return (
        np.max(np.abs(v) / C.getVelocityLimits()),
        np.abs(a).max() / LIMITS["acceleration"],
        np.abs(j).max() / LIMITS["jerk"],
    )


def test_a_line_is_straight_at_constant_speed_within_all_limits(scene):
    start = scene.getFrame("tool").getPose()
    end = start[:3] + 0.1 * X + 0.2 * Y - 0.1 * Z
    plan = ry.planToolPath(scene, ry.ToolPath("tool").line(end), speed=0.1, **LIMITS)
    assert plan, plan.message
    t, q = samples(plan)
    x = poses(scene, q)
    assert distance_from_line(x[:, :3], start[:3], end).max() <= plan.deviation[0] <= 2e-5
    assert np.linalg.norm(x[-1, :3] - end) < 1e-6
    turned = 2 * np.arccos(np.clip(np.abs(x[:, 3:] @ start[3:]), 0, 1))
    assert turned.max() <= plan.deviation[1] + 1e-7 <= 8e-5
    assert max(shares(scene, q, t[1])) <= 1.001
    speed = np.linalg.norm(np.diff(x[:, :3], axis=0), axis=1) / t[1]
    assert speed.max() <= 0.1 * 1.001
    assert np.mean(np.abs(speed / 0.1 - 1) < 5e-3) > 0.85


def test_a_circle_is_round_and_ends_at_its_start(scene):
    start = scene.getFrame("tool").getPose()[:3]
    center = start - 0.08 * Z
    plan = ry.planToolPath(scene, ry.ToolPath("tool").circle(center, [1, 0, 0], 2 * np.pi), speed=0.1, **LIMITS)
    assert plan, plan.message
    x = poses(scene, samples(plan)[1])[:, :3]
    assert np.abs(np.linalg.norm(x - center, axis=1) - 0.08).max() <= plan.deviation[0]
    assert np.linalg.norm(x[-1] - start) < 2e-5
    assert plan.duration == pytest.approx(2 * np.pi * 0.08 / 0.1, abs=0.3)


def test_the_free_axis_stays_in_its_cone_between_obstacles(scene):
    C = scene
    s = np.linspace(-0.12, 0.12, 481)
    points = np.stack([s, 0.32 + 0 * s, 0.85 + 0 * s], axis=1)
    for k, x in enumerate((-0.05, 0.05)):
        C.addFrame(f"clamp{k}", "table").setShape(ry.ST.ssBox, [0.03, 0.03, 0.05, 0.002]).setPosition(
            [x, 0.36, 0.87]
        ).setContact(1)
    normals = np.tile([0.0, 0.0, 1.0], (len(s), 1))
    path = ry.ToolPath.along(points, normals).tilt(0.25)
    plan = ry.planToolPath(C, path, speed=0.1, margin=0.001, **LIMITS)
    assert plan, plan.message
    t, q = samples(plan)
    z, _ = C.evalBatch(ry.FS.vectorZ, ["tool"], q)
    assert np.arccos(np.clip(z[:, 2], -1, 1)).max() <= 0.25
    assert C.isValid(q, margin=0.001 - 1e-9).all()
    assert max(shares(C, q, t[1])) <= 1.001


def test_segments_follow_each_other_without_jumps(scene):
    start = scene.getFrame("tool").getPose()
    paths = [
        ry.ToolPath("tool").start(start + np.r_[d, np.zeros(4)]).line(start[:3] + d + 0.05 * Y).free()
        for d in np.array([[0.1, 0, -0.1], [-0.1, 0, -0.1], [0.0, 0.1, -0.1]])
    ]
    plan = ry.planToolPath(
        scene,
        paths,
        speed=0.1,
        order="free",
        approach=0.02,
        retract=0.02,
        transfer_from=scene.getJointState(),
        **LIMITS,
    )
    assert plan, plan.message
    kinds = [kind for kind, *_ in plan.segments]
    assert kinds == ["transfer", "approach", "path", "retract"] * 3
    assert sorted(path for kind, path, *_ in plan.segments if kind == "path") == [0, 1, 2]
    for before, after in zip(plan.segments, plan.segments[1:]):
        assert before[4] == pytest.approx(after[3], abs=1e-9)
    t, q = samples(plan)
    assert max(shares(scene, q, t[1])) <= 1.001
    assert scene.isValid(q).all()
    np.testing.assert_allclose(q[0], scene.getJointState(), atol=1e-9)


def test_the_order_of_seams_is_the_best_of_all_orders_and_branches():
    """Brute force over orders, directions and inverse solutions, with transfers that planMotion plans one by one."""
    C = ry.Config()
    C.addFile(ry.raiPath("irb120/irb120.g"))
    home = C.getJointState()
    down = [0, 1, 0, 0]
    ends = np.array(
        [
            [[0.3, -0.25, 0.15], [0.38, -0.3, 0.15]],
            [[0.42, 0.25, 0.25], [0.36, 0.3, 0.25]],
            [[0.3, 0.1, 0.3], [0.4, 0.1, 0.3]],
            [[0.25, -0.1, 0.2], [0.25, -0.02, 0.22]],
        ]
    )
    seams = [ry.ToolPath("tool0").start(np.r_[a, down]).line(b) for a, b in ends]
    plan = ry.planToolPath(C, seams, order="free", transfer_from=home, **LIMITS)
    assert plan, plan.message
    ways = []  # (seam, first, last, duration)
    for number, seam in enumerate(seams):
        for solution in ry.solveIk(C, {"tool0": np.r_[ends[number][0], down]}, all=True):
            one = ry.planToolPath(C, seam, start=solution.q, **LIMITS)
            if one:
                q = one.eval(np.array([0.0, one.duration]))[0]
                ways += [(number, q[0], q[1], one.duration), (number, q[1], q[0], one.duration)]

    @functools.cache
    def transfer(a, b):  # -1 is home
        from_, to = home if a < 0 else ways[a][2], ways[b][1]
        motion = ry.planMotion(C, to, start=from_, max_evaluations=20000, **LIMITS)
        return motion.duration if motion.feasible else np.inf

    def least(at, left):
        if not left:
            return 0.0
        return min(transfer(at, k) + way[3] + least(k, left - {way[0]}) for k, way in enumerate(ways) if way[0] in left)

    assert plan.duration <= 1.001 * least(-1, frozenset(range(len(seams))))


def test_a_branch_that_no_transfer_leads_to_is_left_out():
    """The branch that is nearest to where the robot is cannot be reached from there: the upper arm is in the way."""
    C = ry.Config()
    C.addFile(ry.raiPath("ur10e/ur10e.g"))
    C.addFrame("tool", "tool0").setRelativePosition([0, 0, 0.1])
    start = np.array([0.6412, -0.1773, 0.1851, 0.1861, -0.3623, -0.9133, 0.0])
    q = np.array([0.412, -1.754, 4.179, -0.894, -4.567, -2.518])
    branches = np.array([solution.q for solution in ry.solveIk(C, {"tool": start}, all=True)])
    nearest = branches[np.argmin(np.max(np.abs(branches - q) / C.getVelocityLimits(), axis=1))]
    assert not ry.planMotion(C, nearest, start=q, max_evaluations=20000).feasible
    path = ry.ToolPath("tool").start(start).line(start[:3] + 0.05 * X)
    plan = ry.planToolPath(C, path, transfer_from=q, **LIMITS)
    assert plan, plan.message
    np.testing.assert_allclose(plan.eval(0.0)[0], q, atol=1e-6)
    assert C.isValid(samples(plan)[1]).all()
    begin = time.monotonic()
    plan = ry.planToolPath(C, path, start=nearest, transfer_from=q, time_limit=0.1)
    assert plan.status == ry.ToolPathStatus.out_of_time, plan.message
    assert time.monotonic() - begin < 4  # without the limit, the search for a transfer takes longer


def test_without_a_limit_that_is_reached_the_tool_is_never_slow(scene):
    plan = ry.planToolPath(scene, ry.ToolPath("tool").line(scene.getFrame("tool").getPosition() + 0.2 * Y), speed=2.0)
    assert plan, plan.message
    assert plan.slow
    for path, begin, end, speed, cause in plan.slow:
        assert path == 0
        assert 0 <= begin <= end <= 0.2 + 1e-9
        assert speed < 2.0
        assert " of " in cause


def test_a_start_that_cannot_do_it_names_one_that_can(scene):
    C = scene
    start = C.getFrame("tool").getPose()
    path = ry.ToolPath("tool").start(start).line(start[:3] + 0.1 * X + 0.2 * Y - 0.1 * Z)
    good = ry.planToolPath(C, path)
    assert good, good.message
    same = ry.planToolPath(C, path, start=good.eval(0.0)[0])
    assert same, same.message
    np.testing.assert_allclose(same.eval(0.0)[0], good.eval(0.0)[0], atol=1e-6)


def test_equal_arguments_give_equal_bits_and_plans_are_pickled(scene):
    path = ry.ToolPath("tool").line(scene.getFrame("tool").getPosition() + 0.2 * Y).free()
    a, b = (ry.planToolPath(scene, path, seed=3) for _ in range(2))
    copy = pickle.loads(pickle.dumps(a))
    for other in (b, copy):
        assert other.duration == a.duration
        assert (other.eval(0.7)[0] == a.eval(0.7)[0]).all()
        assert (other.slow, other.segments, other.deviation) == (a.slow, a.segments, a.deviation)


def test_a_failure_names_place_and_pair(scene):
    C = scene
    start = C.getFrame("tool").getPose()
    C.addFrame("block").setShape(ry.ST.box, [0.3, 0.04, 0.3]).setPosition(start[:3] + 0.2 * Y).setContact(1)
    plan = ry.planToolPath(C, ry.ToolPath("tool").line(start[:3] + 0.4 * Y))
    assert plan.status == ry.ToolPathStatus.in_collision, plan.message
    assert "block" in plan.frames
    assert plan.where[0] == 0
    assert 0.0 < plan.where[1] < 0.2
    assert f"{plan.where[1]:.3g}"[:4] in plan.message
    assert len(plan.reached) > 0
    with pytest.raises(ValueError, match="there is no motion"):
        plan.eval(0.0)


def test_blends_that_overlap_shrink_and_the_robot_moves():
    C = ry.Config()
    C.addFile(ry.raiPath("ur5e/ur5e.g"))
    p = C.getFrame("tool0").getPosition()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C))
    square = p + 0.05 * np.array([[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0]])
    plan = bot.moveSequence("tool0", square, blend=0.5, speed=0.1)
    assert plan, plan.message
    assert [warning[:38] for warning in plan.warnings] == [
        f"path 0: the blend of 0.5 m at element {k}"[:38] for k in (1, 2, 3)
    ]
    x = poses(C, samples(plan)[1], "tool0")[:, :3] - p
    assert ((x > -1e-4) & (x < 0.05 + 1e-4))[:, :2].all() and np.abs(x[:, 2]).max() < 2e-5
    inside = np.minimum(np.minimum(x[:, 0], x[:, 1]), np.minimum(0.05 - x[:, 0], 0.05 - x[:, 1]))
    assert 1e-3 < inside.max() < 0.0245  # corners are cut within the radius


def test_a_start_away_from_the_path_is_told_with_its_distance(scene):
    C = ry.Config()
    C.addFile(ry.raiPath("irb120/irb120.g"))
    q = np.zeros(6)
    C.setJointState(q)
    first = np.array([0.4, -0.2, 0.3])
    path = ry.ToolPath("tool0").start(np.r_[first, 0, 1, 0, 0]).line([0.4, 0.2, 0.3])
    plan = ry.planToolPath(C, path, start=q)
    off = np.linalg.norm(C.getFrame("tool0").getPosition() - first)
    assert f"at `start`, the tool is {off:.3f} m from the beginning of the path; from the start (" in plan.message


def test_arguments_that_no_plan_can_keep_are_explained(scene):
    C = scene
    start = C.getFrame("tool").getPose()
    path = ry.ToolPath("tool").start(start).line(start[:3] + 0.1 * X)
    with pytest.raises(ValueError, match="tolerance is 1e-07; expected a finite number of at least 1e-06"):
        ry.planToolPath(C, path, tolerance=1e-7)
    for name in ("tolerance", "rotation_tolerance"):
        with pytest.raises(ValueError, match=f"planToolPath: {name} is (inf|nan); expected a finite number"):
            ry.planToolPath(C, path, **{name: np.inf})
        with pytest.raises(ValueError, match=f"planToolPath: {name} is (inf|nan); expected a finite number"):
            ry.planToolPath(C, path, **{name: np.nan})
    with pytest.raises(ValueError, match="element 0 ends at its start; expected another end, or a circle"):
        ry.planToolPath(C, ry.ToolPath("tool").start(start).arc(start[:3] + 0.1 * X, start))


def test_angles_that_look_like_degrees_are_warned_of(scene):
    start = scene.getFrame("tool").getPose()
    with pytest.warns(ry.KinegraphWarning, match=r"circle: angle is 360; did you mean radians\? 360 degrees are 6.28"):
        path = ry.ToolPath("tool").start(start).circle(start[:3] + 0.05 * X, Z, 360)
    assert path.warnings
    with pytest.warns(
        ry.KinegraphWarning, match=r"free: the range from -30 to 30 is more than a turn; did you mean radians\? 30 "
    ):
        ry.ToolPath("tool").free(range=(-30, 30))
    assert not ry.ToolPath("tool").circle(start[:3], Z, 6 * np.pi).free(range=(-7, 7)).warnings


def test_paths_are_pickled_to_the_last_bit(scene):
    start = scene.getFrame("tool").getPose()
    path = ry.ToolPath("tool").start(start).line(start[:3] + 0.05 * X).speed(0.05)
    path.arc(start[:3] + 0.07 * X + 0.02 * Y, start + np.r_[0.05 * X + 0.04 * Y, np.zeros(4)], blend=0.005)
    path.circle(start[:3] + 0.05 * X + 0.06 * Y, Z, 1.0).spline([start[:3] + 0.1 * Y, start[:3] + 0.1 * Y + 0.02 * Z])
    rows = ry.ToolPath.along(np.tile(start[:3], (5, 1)) + np.outer(np.arange(5), 0.01 * Y), np.tile(Z, (5, 1)))
    for one in (path.free("z", (-1.0, 1.0), prefer=0.1), rows.tilt(0.2)):
        copy = pickle.loads(pickle.dumps(one))
        assert str(copy) == str(one)
        a, b = (ry.planToolPath(scene, each) for each in (one, copy))
        assert a and a.duration == b.duration
        assert np.array_equal(samples(a)[1], samples(b)[1])
        assert copy.line(start[:3]) is copy


def test_a_verbose_call_logs_a_line(scene, caplog):
    caplog.set_level("INFO", "kinegraph")
    path = ry.ToolPath("tool").line(scene.getFrame("tool").getPosition() + 0.1 * Y)
    ry.planToolPath(scene, path)
    assert not caplog.messages
    plan = ry.planToolPath(scene, path, verbose=1)
    assert f"planToolPath: solved: 1 path in {plan.duration:.6g} s, " in caplog.messages[0]


def test_a_simulated_robot_follows_the_plan(scene):
    end = scene.getFrame("tool").getPosition() + 0.1 * Y
    plan = ry.planToolPath(scene, ry.ToolPath("tool").line(end), speed=0.1)
    assert plan, plan.message
    bot = ry.BotOp(scene, False)
    bot.follow(plan)
    bot.wait(scene)
    scene.setJointState(bot.get_q())
    assert np.linalg.norm(scene.getFrame("tool").getPosition() - end) < 2e-3


def test_a_torch_leans_by_its_travel_and_work_angles(scene):
    """On a line along x, travel leans z to +x, and work to the left, seen along the path with z up."""
    s = np.linspace(-0.1, 0.1, 41)
    points = np.stack([s, 0.3 + 0 * s, 0.85 + 0 * s], axis=1)
    travel, work = np.radians([10, 5])
    for down, sign in (([0.0, 0.0, 1.0], 1.0), ([0.0, 0.0, -1.0], -1.0)):
        path = ry.ToolPath.along(points, np.tile(down, (41, 1))).lean(travel, work).free()
        plan = ry.planToolPath(scene, path, speed=0.05, **LIMITS)
        if sign < 0 and not plan:
            continue  # the hand points up there
        assert plan, plan.message
        z = scene.evalBatch(ry.FS.vectorZ, ["tool"], samples(plan, 100.0)[1])[0]
        expected = [np.cos(work) * np.sin(travel), sign * np.sin(work), sign * np.cos(work) * np.cos(travel)]
        assert np.abs(z - expected).max() < 1e-4


def test_lean_refuses_paths_without_normals(scene):
    with pytest.raises(ValueError, match=r"lean: the path has no rows with normals"):
        ry.ToolPath("tool").line([0, 0, 1]).lean(0.1)
    rows = ry.ToolPath.along([[0, 0, 0], [0, 0, 1]], [[0, 0, 1], [0, 0, 1]])
    with pytest.raises(ValueError, match="row 0 is along the tool's z axis"):
        rows.lean(0.1)
    with pytest.raises(ValueError, match="travel is 2"):
        rows.lean(2.0)


def test_invalid_arguments_are_explained(scene):
    path = ry.ToolPath("tool")
    with pytest.raises(ValueError, match="expected 7"):
        path.line([0, 0, 0, 1])
    with pytest.raises(ValueError, match="about is 'w'"):
        path.free("w")
    with pytest.raises(ValueError, match="tilt"):
        path.tilt(2.0)
    with pytest.raises(ValueError, match="has no length"):
        ry.planToolPath(scene, path)
    with pytest.raises(ValueError, match="speed is -1"):
        ry.planToolPath(scene, path.line([0.3, 0.3, 1.0]), speed=-1)
    with pytest.raises(ry.FrameNotFound, match="tol"):
        ry.planToolPath(scene, ry.ToolPath("tol").line([0.3, 0.3, 1.0]))
    with pytest.raises(ValueError, match="order is 'any'"):
        ry.planToolPath(scene, path, order="any")


def test_the_free_rotation_keeps_its_range_and_the_preferred_angle(scene):
    start = scene.getFrame("tool").getPose()

    def twists(plan):
        """Angles about the tool's z axis from the start; the axis keeps its direction."""
        x = poses(scene, samples(plan, 200.0)[1])[:, 3:]
        w, v = start[3], start[4:]
        turn = np.c_[w * x[:, 0] + x[:, 1:] @ v, w * x[:, 1:] - x[:, :1] * v - np.cross(v, x[:, 1:])]
        angle = 2 * np.arctan2(turn[:, 3], turn[:, 0])
        return (angle + np.pi) % (2 * np.pi) - np.pi

    def plan(**how):
        path = ry.ToolPath("tool").start(start).line(start[:3] + 0.15 * Y - 0.05 * Z).free("z", **how)
        plan = ry.planToolPath(scene, path, speed=0.2, **LIMITS)
        assert plan, plan.message
        return plan

    angles = twists(plan(range=(0.2, 0.6)))
    assert angles.min() >= 0.2 and angles.max() <= 0.6
    assert np.abs(twists(plan(prefer=-0.5)) + 0.5).max() < 1e-2
    with pytest.raises(ry.errors.ArgumentError, match=r"range is \(0\.6, 0\.2\)"):
        ry.ToolPath("tool").free(range=(0.6, 0.2))
    with pytest.raises(ry.errors.ArgumentError, match="prefer is 1"):
        ry.ToolPath("tool").free(range=(0, 0.5), prefer=1)


def test_each_of_several_speeds_is_kept_within_half_a_percent(scene):
    at = scene.getFrame("tool").getPose() - np.r_[0.2 * X, 0, 0, 0, 0]
    path = ry.ToolPath("tool").start(at)
    for k, speed in enumerate((0.05, 0.2, 0.08)):
        path.speed(speed).line(at[:3] + 0.15 * (k + 1) * X)
    plan = ry.planToolPath(scene, path, speed=1.0, **LIMITS)
    assert plan, plan.message
    t, q = samples(plan)
    way = np.array([plan.way(time)[1] for time in t])
    speed = np.linalg.norm(np.diff(poses(scene, q)[:, :3], axis=0), axis=1) / t[1]
    asked = np.select([way[1:] < 0.15, way[1:] < 0.3], [0.05, 0.2], 0.08)
    at_a_change = np.abs(way[1:, None] - [0.15, 0.3]).min(axis=1) < 2e-4
    assert (speed[~at_a_change] <= 1.001 * asked[~at_a_change]).all()
    # The ramp from .05 to .2 m/s takes 16 mm at 2 m/s^2 and 40 m/s^3. It begins a little before the change.
    ramps = [(-1, 0.003), (0.147, 0.168), (0.285, 0.305), (0.445, 1)]
    steady = ~np.any([(way[1:] > begin) & (way[1:] < end) for begin, end in ramps], axis=0)
    assert np.sum(steady) > 0.9 * len(steady)
    assert np.abs(speed / asked - 1)[steady].max() < 5e-3


def test_the_approach_is_on_the_side_of_the_arm_for_axes_that_point_into_the_work():
    C = ry.Config()
    C.addFile(ry.raiPath("ur10e/ur10e.g"))
    C.addFrame("tip", "tool0").setRelativePosition([0, 0, 0.1])
    path = ry.ToolPath("tip").start([0.6, 0.1, 0.3, 0, 1, 0, 0]).line([0.7, 0.1, 0.3])
    plan = ry.planToolPath(C, path, approach=0.05, retract=0.05)
    assert plan, plan.message
    x = poses(C, plan.eval(np.array([0.0, plan.duration]))[0], "tip")
    np.testing.assert_allclose(x[:, :3], [[0.6, 0.1, 0.35], [0.7, 0.1, 0.35]], atol=3e-5)


def test_touching_a_part_does_not_include_its_clamps(scene):
    C = scene
    C.addFrame("part", "table").setShape(ry.ST.ssBox, [0.4, 0.2, 0.02, 0.002]).setRelativePosition([0, 0.35, 0.06])
    C.getFrame("part").setContact(1)
    C.addFrame("clamp", "part").setShape(ry.ST.ssBox, [0.02, 0.2, 0.1, 0.002]).setRelativePosition([0.05, 0, 0.06])
    C.getFrame("clamp").setContact(1)
    points = np.linspace([-0.1, 0.35, 0.72], [0.15, 0.35, 0.72], 100)
    path = ry.ToolPath.along(points, np.tile(Z, (100, 1))).tilt(0.2)
    plan = ry.planToolPath(C, path, touching=["part"], **LIMITS)
    assert plan.status == ry.ToolPathStatus.in_collision, plan
    assert "clamp" in plan.frames
    assert 0.1 < plan.where[1] < 0.15


def test_motions_name_their_first_contact_and_nearest_limit(scene):
    C = scene
    q = C.getJointState()
    motion = ry.retime(C, [q, q + 0.5], acceleration=4.0, jerk=60.0, tool_speed={"tool": 0.15})
    t, Q = motion.sample(1000)[:2]
    speed = np.linalg.norm(np.diff(poses(C, Q)[:, :3], axis=0), axis=1) / t[1]
    assert 0.149 < speed.max() <= 0.15 * 1.001
    assert motion.firstContact(C) is None
    faster = ry.retime(C, [q, q + 0.5], acceleration=4.0, jerk=60.0)
    assert faster.duration < motion.duration
    share, kind, dof = faster.nearestLimit(0.01, C.getVelocityLimits(), 4.0, 60.0)
    assert kind == "jerk" and share == pytest.approx(1, abs=0.02) and 0 <= dof < 7

    way = ry.planToolPath(C, ry.ToolPath("tool").line(C.getFrame("tool").getPosition() + 0.2 * Y), **LIMITS)
    assert way.firstContact(C) is None
    middle = poses(C, way.eval(0.5 * way.duration)[0][None])[0]
    C.addFrame("post").setShape(ry.ST.sphere, [0.01]).setPosition(middle[:3]).setContact(1)
    moment, a, b, distance = way.firstContact(C)
    assert "post" in (a, b) and distance < 1e-3
    free = C.isValid(way.eval(np.array([moment - 0.05, moment + 0.05]))[0])
    assert free.tolist() == [True, False]


def test_a_plan_shows_its_curve_and_the_place_of_its_failure(scene):
    start = scene.getFrame("tool").getPose()
    path = ry.ToolPath("tool").start(start).line(start[:3] + 0.1 * Y).tilt(0.2)
    plan = ry.planToolPath(scene, path, **LIMITS)
    assert plan.view(scene, path) == 0
    v = scene.viewer()
    for drawing in ("start", "end", "cone"):
        v.remove(f"tool path 0, {drawing}")  # raises unless it is there
    far = ry.ToolPath("tool").free().line(start[:3] + 1.5 * Y)
    assert ry.planToolPath(scene, far).view(scene, [far]) == 0
    v.remove("tool path, failure")
    v.remove("tool path, cause")
    with pytest.raises(ry.errors.ArgumentError, match="nothing is named 'tool path 0, speed'"):
        v.remove("tool path 0, speed")  # of the first plan
