"""The fastest motion along a path: limits checked by differences, durations against exact results."""

import pickle
import threading
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kinegraph as ry
from interrupts import interrupt_after

WITHIN = 1e-9


def use(timed, velocity, acceleration, samples=4001):
    """The largest ratio of a motion to its limits."""
    _, qd, qdd = timed.eval(np.linspace(0, timed.duration, samples))
    return np.max(np.abs(qd) / velocity), np.max(np.abs(qdd) / acceleration)


@st.composite
def problems(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    dofs, count = draw(st.integers(1, 8)), draw(st.integers(2, 10))
    path = rng.uniform(-3, 3, (count, dofs))
    if draw(st.booleans()):
        path[rng.integers(count)] = path[rng.integers(count)]
    return path, rng.uniform(0.1, 4, dofs), rng.uniform(0.1, 30, dofs), rng.uniform(1, 1000, dofs)


@settings(max_examples=30, deadline=None)
@given(problems(), st.sampled_from(["blend", "stop", "spline"]), st.booleans())
def test_limits_hold_and_the_ends_are_reached(problem, corners, with_jerk):
    path, velocity, acceleration, jerk = problem
    timed = ry.retime(path, velocity, acceleration, jerk if with_jerk else None, corners=corners, intervals=40)
    assert timed, timed.message
    most_velocity, most_acceleration = use(timed, velocity, acceleration)
    assert most_velocity <= 1 + WITHIN
    assert most_acceleration <= 1 + WITHIN
    for t, point in ((0.0, path[0]), (timed.duration, path[-1])):
        q, qd, _ = timed.eval(t)
        np.testing.assert_allclose(q, point, atol=1e-8)
        np.testing.assert_allclose(qd, 0, atol=1e-6)
    assert np.all(np.diff(timed.times) >= 0)
    if with_jerk:
        t = np.linspace(0, timed.duration, 3001)
        qdd = timed.eval(t)[2]
        if timed.duration > 0:
            assert np.max(np.abs(np.diff(qdd, axis=0)) / ((t[1] - t[0]) * jerk)) <= 1 + 1e-6


@settings(max_examples=10, deadline=None)
@given(problems())
def test_twice_the_limits_never_take_longer(problem):
    path, velocity, acceleration, _ = problem
    slow = ry.retime(path, velocity, acceleration).duration
    fast = ry.retime(path, 2 * velocity, 4 * acceleration).duration
    assert fast == pytest.approx(slow / 2, rel=1e-6)


def test_a_line_takes_what_is_known():
    assert ry.retime([[0.0], [10.0]], 2, 4).duration == pytest.approx(5.5)
    assert ry.retime([[0.0], [2.0]], 100, 100, 1).duration == pytest.approx(4.0)


def test_a_number_stands_for_all_dofs():
    path = [[0.0, 0.0], [1.0, 2.0]]
    assert ry.retime(path, 1, 2).duration == ry.retime(path, [1, 1], [2, 2]).duration


def test_eval_takes_one_time_or_many():
    timed = ry.retime([[0.0, 0.0], [1.0, 2.0]], 1, 2)
    one, many = timed.eval(0.5), timed.eval([0.1, 0.5])
    for a, b in zip(one, many, strict=True):
        assert a.shape == (2,)
        assert b.shape == (2, 2)
        np.testing.assert_array_equal(a, b[1])


def test_blends_are_asked_for():
    asked = []

    def is_free(points, deviation):
        asked.append((points.shape, deviation))
        return len(asked) > 1

    timed = ry.retime([[0, 0], [1, 0], [1, 1]], 1, 2, tolerance=0.1, is_free=is_free)
    assert timed
    assert len(asked) == 2
    assert asked[0][0][1] == 2
    with pytest.raises(ZeroDivisionError):
        ry.retime([[0, 0], [1, 0], [1, 1]], 1, 2, is_free=lambda points, deviation: 1 / 0)


def test_a_motion_may_begin_with_an_acceleration():
    motion = ry.retime([[0.0], [1.0]], 1, 2, 30, start_velocity=[0.4], start_acceleration=[-1.5])
    _, velocity, acceleration = motion.eval(0.0)
    assert (velocity[0], acceleration[0]) == pytest.approx((0.4, -1.5), abs=1e-9)
    with pytest.raises(ry.ArgumentError, match="start_acceleration has 2 entries"):
        ry.retime([[0.0], [1.0]], 1, 2, 30, start_velocity=[0.4], start_acceleration=[1.0, 0.0])


@pytest.mark.parametrize("corners", ["blend", "stop", "spline"])
@pytest.mark.parametrize("jerk", [None, 30.0])
def test_copies_move_alike(corners, jerk):
    path = np.random.default_rng(4).uniform(-2, 2, (6, 3))
    timed = ry.retime(path, 1, 2, jerk, corners=corners)
    copy = pickle.loads(pickle.dumps(timed))
    t = np.linspace(0, timed.duration, 100)
    assert copy.duration == timed.duration
    assert repr(copy) == repr(timed)
    for a, b in zip(timed.eval(t), copy.eval(t), strict=True):
        np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(copy.times, timed.times)
    np.testing.assert_array_equal(copy.path, path)


def test_a_failure_and_a_path_without_motion_can_be_stored():
    for timed in (ry.retime([[0.0], [1.0]], 10, 2, start_velocity=[3.0]), ry.retime([[1.0, 2.0]], 1, 1)):
        copy = pickle.loads(pickle.dumps(timed))
        assert copy.status == timed.status
        assert copy.message == timed.message
        np.testing.assert_array_equal(copy.path, timed.path)


def test_a_damaged_state_is_refused():
    state = list(ry.retime([[0.0], [1.0]], 1, 2).__getstate__())
    for place, damaged in (
        (5, state[5][:-1]),
        (6, [*state[6], 0]),
        (6, [piece + 1 for piece in state[6]]),
        (6, [-1 for _ in state[6]]),
        (5, np.zeros((0, 7))),
        (4, (*state[4][:5], state[4][5][:-1], *state[4][6:])),
    ):
        broken = [*state]
        broken[place] = damaged
        with pytest.raises(ry.ArgumentError, match="TimedPath|curve"):
            ry.TimedPath.__new__(ry.TimedPath).__setstate__(tuple(broken))
    broken = [*state]
    broken[5], broken[6] = np.zeros((0, 7)), []
    with pytest.raises(ry.ArgumentError, match="a motion without phases"):
        ry.TimedPath.__new__(ry.TimedPath).__setstate__(tuple(broken))


@pytest.mark.parametrize("jerk", [None, 30.0])
def test_ctrl_c_ends_it(jerk):
    path = np.random.default_rng(4).uniform(-2, 2, (6, 3))
    with pytest.raises(KeyboardInterrupt), interrupt_after(0.2):
        ry.retime(path, 1, 2, jerk, corners="spline", intervals=1000000)


def test_ctrl_c_ends_the_search_with_jerk_limits():
    path = np.random.default_rng(4).uniform(-2, 2, (6, 7))
    begin = time.perf_counter()
    ry.retime(path, 1, 2, 30.0, corners="spline", intervals=30000)
    whole = time.perf_counter() - begin
    with pytest.raises(KeyboardInterrupt), interrupt_after(0.5 * whole) as interrupt:
        ry.retime(path, 1, 2, 30.0, corners="spline", intervals=30000)
    assert time.perf_counter() - interrupt.time < 0.2  # s; a busy machine needs some of it


def test_other_threads_run_meanwhile(panda):
    q = np.array(panda.getJointState())
    path = np.vstack([q, q + 0.4, q - [0.3, 0, 0, 0, 0.2, 0, 0]])
    done = threading.Event()
    counted = []

    def count():
        while not done.wait(0.001):
            counted.append(1)

    thread = threading.Thread(target=count)
    thread.start()
    ry.retime(panda, path, acceleration=5, jerk=50, corners="spline", intervals=20000)
    done.set()
    thread.join()
    assert len(counted) > 3


def test_an_end_velocity_that_cannot_be_braked_is_an_outcome():
    timed = ry.retime([[0.0], [1.0]], 10, 2, start_velocity=[3.0])
    assert not timed
    assert timed.status == ry.RetimeStatus.start_too_fast
    assert "at most 2 would do" in timed.message
    with pytest.raises(ry.ArgumentError, match="there is no motion"):
        timed.eval(0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.0, 1.0], 1, 1), "expected shape"),
        (([[0.0], [1.0]], -1, 1), "velocity.0. is -1"),
        (([[0.0], [1.0]], [1, 1], 1), "velocity has 2 entries"),
        (([[0.0], [np.inf]], 1, 1), "path.1, 0. is inf"),
    ],
)
def test_mistakes_are_named(arguments, message):
    with pytest.raises(ry.ArgumentError, match=message):
        ry.retime(*arguments)


def test_unknown_corners_have_neighbors():
    with pytest.raises(ry.ArgumentError, match="similar names: blend"):
        ry.retime([[0.0], [1.0]], 1, 1, corners="blnd")


@pytest.fixture
def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def test_a_robot_brings_its_velocity_limits(panda):
    q = np.array(panda.getJointState())
    path = np.vstack([q, q + 0.4, q - [0.3, 0, 0, 0, 0.2, 0, 0]])
    limits = panda.getVelocityLimits()
    timed = ry.retime(panda, path, acceleration=5)
    if np.all(np.isfinite(limits)):
        assert use(timed, limits, 5)[0] <= 1 + WITHIN
    with pytest.raises(ry.ArgumentError, match="acceleration is missing"):
        ry.retime(panda, path)
    with pytest.raises(ry.ArgumentError, match="the path has 6 dofs; the scene has 7"):
        ry.retime(panda, path[:, :6], acceleration=5)


PENDULUM = """
base: {}
arm (base): { joint: hingeX, ctrl_limits: [5 %g] }
rod (arm): { shape: box, size: [.02 1 .02], Q: "t(0 .5 0)", mass: 1 }
"""


def pendulum(effort):
    C = ry.Config()
    C.addText(PENDULUM % effort)
    return C


@pytest.mark.parametrize("jerk", [None, 400])
def test_torques_hold_all_along(jerk):
    C = pendulum(7.0)
    timed = ry.retime(C, [[-1.5], [0.3], [1.5]], acceleration=100, jerk=jerk, torque=True)
    assert timed, timed.message
    torques = []
    for t in np.linspace(0, timed.duration, 3000):
        q, qd, qdd = timed.eval(t)
        C.setJointState(q)
        torques.append(C.inverseDynamics(qd, qdd)[0])
    assert np.max(np.abs(torques)) <= 7.0 * (1 + WITHIN)
    assert np.max(np.abs(torques)) > 6.9  # the torques limit the motion
    assert ry.retime(pendulum(70.0), [[-1.5], [1.5]], acceleration=100, torque=True).duration < timed.duration


def test_an_arm_that_is_too_heavy_is_named():
    timed = ry.retime(pendulum(3.0), [[-1.5], [1.5]], acceleration=100, torque=True)
    assert timed.status == ry.RetimeStatus.cannot_move
    assert "'arm' cannot rest" in timed.message
    assert "the limits are -3 to 3 N m" in timed.message
    C = ry.Config()
    C.addText("base: {}\narm (base): { joint: hingeX }")
    with pytest.raises(ry.ArgumentError, match="no joint of the scene has one"):
        ry.retime(C, [[0], [1]], acceleration=1, torque=True)
