"""Times of the ways of other motions, and the limits that are active along them."""

import numpy as np
import pytest

import kinegraph as ry


@pytest.fixture(scope="module")
def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def spline_motion(C):
    """A spline through four configurations that rests at its ends, and its samples."""
    q = C.getJointState() + np.vstack([np.zeros(7), np.random.default_rng(1).uniform(-0.4, 0.4, (3, 7))])
    motion = ry.SplineTrajectory(ry.BSpline().set(3, q, [0.0, 1.0, 2.5, 4.0]))
    return motion, motion.eval(np.linspace(0, motion.duration, 4001))[0]


def distance_from(points, way):
    """Largest distance of the points from a dense polyline, in any dof."""
    far = 0.0
    for p in points:
        k = np.clip(np.argmin(np.abs(way - p).max(axis=1)), 1, len(way) - 2)
        a, b = way[k - 1 : k + 1], way[k : k + 2]
        u = np.clip(np.sum((p - a) * (b - a), axis=1) / np.sum((b - a) ** 2, axis=1), 0, 1)
        far = max(far, np.abs(a + u[:, None] * (b - a) - p).max(axis=1).min())
    return far


@pytest.mark.parametrize("jerk", [None, 100.0])
def test_the_way_of_a_spline_is_timed_again(panda, jerk):
    C = panda
    motion, way = spline_motion(C)
    timed = ry.retime(C, motion, acceleration=6.0, jerk=jerk, tool_speed={"l_gripper": 0.1})
    assert timed, timed.message
    q, v, a = timed.eval(np.linspace(0, timed.duration, 301))
    assert distance_from(q, way) < 3e-6
    assert np.allclose(q[[0, -1]], way[[0, -1]], atol=1e-9) and np.abs(v[[0, -1]]).max() < 1e-9
    assert (np.abs(v) <= 1.0001 * C.getVelocityLimits()).all() and np.abs(a).max() < 6.001
    p = C.evalBatch(ry.FS.position, ["l_gripper"], timed.eval(np.arange(0, timed.duration, 1e-3))[0])[0]
    speed = np.linalg.norm(np.diff(p, axis=0), axis=1) / 1e-3
    assert 0.095 < speed.max() < 0.1001
    assert timed.duration < ry.retime(C, motion, acceleration=6.0, jerk=jerk, tool_speed={"l_gripper": 0.05}).duration


def test_a_coarse_grid_is_made_finer_if_speeds_of_frames_need_it(panda):
    motion = spline_motion(panda)[0]
    assert ry.retime(panda, motion, acceleration=6.0, tool_speed={"l_gripper": 0.1}, intervals=100)


def test_active_limits_tell_why_a_motion_is_slow(panda):
    C = panda
    motion = spline_motion(C)[0]
    limits = {"acceleration": 6.0, "tool_speed": {"l_gripper": 0.1}}
    timed = ry.retime(C, motion, **limits)
    active = ry.activeLimits(C, timed, **limits)
    begin, end = np.array([entry[:2] for entry in active]).T
    assert (begin < end).all() and (begin[1:] >= end[:-1] - 1e-12).all()
    assert begin[0] < 0.01 and end[-1] == pytest.approx(timed.duration)
    assert active[0][3].startswith("acceleration of '") and active[0][2] == pytest.approx(1, abs=0.01)
    tool = [entry for entry in active if entry[3] == "speed of 'l_gripper'"]
    assert sum(to - from_ for from_, to, *_ in tool) > 0.6 * timed.duration
    assert max(share for *_, share, _ in tool) == pytest.approx(1, abs=0.05)
    alone = ry.activeLimits(C, ry.retime(C, motion, acceleration=6.0), acceleration=6.0)
    assert not any("speed of" in cause for *_, cause in alone)
    with pytest.raises(ry.ArgumentError, match="activeLimits: acceleration is missing"):
        ry.activeLimits(C, timed)


def test_the_share_of_a_torque_on_a_slide_at_rest_is_that_of_its_force():
    C = ry.Config()
    C.addText(
        "base: {} arm (base): { joint: hingeZ, ctrl_limits: [5 100] } slide (arm): { joint: transX, ctrl_limits: [5 8], "
        "shape: sphere, size: [.01], mass: 1 }"
    )
    q = [[0.0, 0.5], [3.0, 0.5]]
    timed = ry.retime(C, q, velocity=2.0, acceleration=4.0)
    limits = {"velocity": 4.0, "acceleration": 40.0, "torque": True}
    share = max(share for *_, share, cause in ry.activeLimits(C, timed, **limits) if cause == "velocity of 'arm'")
    assert share == pytest.approx(0.5)
    limits["velocity"] = 40.0  # m r w^2 = 2 N of 8 N
    active = [entry for entry in ry.activeLimits(C, timed, **limits) if entry[3] == "torque of 'slide'"]
    assert max(share for *_, share, _ in active) == pytest.approx(0.25, abs=1e-3)


def test_motions_stop_at_the_corners_of_a_way_and_timed_paths_are_kept_to_the_bit(panda):
    C = panda
    q = C.getJointState() + np.array([[0.0], [0.3], [0.1]]) * np.array([1, 0.5, -1, 0.3, 0.2, 0.4, 1])
    q[2, 0] += 0.2
    polyline = ry.SplineTrajectory(ry.BSpline().set(1, q, [0.0, 1.0, 2.0]))
    timed = ry.retime(C, polyline, acceleration=6.0)
    corner = timed.times[np.argmin(np.abs(timed.path - q[1]).max(axis=1))]
    assert np.allclose(timed.eval(corner)[0], q[1], atol=2e-6) and np.abs(timed.eval(corner)[1]).max() < 1e-6
    stops = ry.retime(C, q, acceleration=6.0, corners="stop")
    assert timed.duration == pytest.approx(stops.duration, rel=1e-4)
    again = ry.retime(C, ry.retime(C, q, acceleration=1.0, corners="stop"), acceleration=6.0)
    assert again.duration == stops.duration


def test_a_tool_path_is_timed_again_with_another_speed_of_the_tool(panda):
    C = panda
    p, way = C.getFrame("l_gripper").getPosition(), np.array([0.1, 0.1, -0.1])
    plan = ry.planToolPath(C, ry.ToolPath("l_gripper").line(p + way), speed=0.1)
    timed = ry.retime(C, plan, acceleration=6.0, tool_speed={"l_gripper": 0.2})
    x = C.evalBatch(ry.FS.position, ["l_gripper"], timed.sample(100.0)[1])[0]
    assert np.linalg.norm(np.cross(x - p, way / np.linalg.norm(way)), axis=1).max() < 2.5e-5
    assert timed.duration < 0.7 * plan.duration
