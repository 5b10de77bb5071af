"""BotOp.follow executes a trajectory exactly as it was verified."""

import sys
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

sys.path.append(str(Path(__file__).parents[3] / "benchmarks"))

import follow as benchmark

MARGIN, ALLOWED = 0.01, 2e-4


class Swing(ry.Trajectory):
    """q = (a (1 - cos w t), ...): from rest to rest in `duration`."""

    def __init__(self, start: np.ndarray, size: float = 0.3, duration: float = 2.0):
        super().__init__()
        self.start, self.size, self.seconds = np.asarray(start), size, duration

    @property
    def duration(self) -> float:
        return self.seconds

    def eval(self, t: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        w, one = 2 * np.pi / self.seconds, np.ones(len(self.start))
        return (
            self.start + self.size * (1 - np.cos(w * t)) * one,
            self.size * w * np.sin(w * t) * one,
            self.size * w**2 * np.cos(w * t) * one,
        )


@pytest.fixture
def arm() -> ry.Config:
    C = ry.Config()
    C.addText(benchmark.ARM)
    return C


@pytest.mark.parametrize("kind", ["arm", "panda"])
@pytest.mark.parametrize("seed", range(3))
def test_a_plan_among_obstacles_keeps_its_margin_at_every_control_period(kind: str, seed: int) -> None:
    C, plan, distances = benchmark.planned(kind, seed, MARGIN)
    Q = benchmark.execute(C, plan, ry.KinematicDriver(C), True)
    assert len(Q) >= plan.duration / 0.01
    beyond, off = benchmark.measured(C, plan, distances, Q)
    assert beyond > -ALLOWED
    assert off < 1e-12  # the robot is at the plan's q at each time
    np.testing.assert_allclose(Q[-1], plan.path[-1], atol=1e-12)
    Q = benchmark.execute(C, plan, ry.SimulatedDriver(C), True)
    beyond, off = benchmark.measured(C, plan, distances, Q)
    assert beyond > -ALLOWED
    assert off < 5e-3


def test_python_subclasses_are_trajectories(arm: ry.Config) -> None:
    swing = Swing(arm.getJointState())
    times, q, velocity, acceleration = swing.sample(50.0)
    assert times.shape == (101,) and q.shape == velocity.shape == acceleration.shape == (101, 4)
    np.testing.assert_array_equal(q[7], swing.eval(times[7])[0])
    bot = ry.BotOp(arm, driver=ry.KinematicDriver(arm))
    bot.follow(swing)
    for k in range(1, 201):
        bot.sync(arm, 0.01)
        np.testing.assert_allclose(arm.getJointState(), swing.eval(0.01 * k)[0], atol=1e-14)
    assert bot.getTimeToEnd() <= 1e-9


def test_mistakes_of_a_subclass_are_told(arm: ry.Config) -> None:
    class Nothing(ry.Trajectory):
        pass

    class NoNumbers(ry.Trajectory):
        duration = 1.0

        def eval(self, t: float) -> str:
            return "at rest"

    class Changes(ry.Trajectory):
        duration = 1.0

        def eval(self, t: float) -> list[np.ndarray]:
            return 3 * [np.zeros(4 if t < 0.5 else 3)]

    class Raises(ry.Trajectory):
        duration = 1.0

        def eval(self, t: float) -> None:
            raise ZeroDivisionError("no state")

    bot = ry.BotOp(arm, driver=ry.KinematicDriver(arm))
    for motion, message in (
        (Nothing(), "class Nothing has no (eval|duration)"),
        (NoNumbers(), r"NoNumbers.eval\(.*\) returned 'at rest'; expected q, velocity and acceleration"),
        (Changes(), r"Changes.eval\(.*\) returned an array of rank 1 with 3 numbers; expected shape \(4,\)"),
    ):
        with pytest.raises(ry.ArgumentError, match=message):
            bot.follow(motion)
    with pytest.raises(ZeroDivisionError, match="no state"):
        bot.follow(Raises())
    with pytest.raises(TypeError):
        ry.TimedPath()
    assert len(bot.getLog()) == 0


def test_a_spline_is_followed_as_a_trajectory(arm: ry.Config) -> None:
    q = arm.getJointState()
    spline = ry.BSpline().set(3, [q, q + 0.4, q + 0.1, q + 0.3], [1.0, 1.5, 2.0, 3.0])
    motion = ry.SplineTrajectory(spline)
    assert isinstance(motion, ry.Trajectory) and motion.duration == 2.0
    np.testing.assert_array_equal(motion.eval([0.0, 0.7])[1], spline.eval([1.0, 1.7], 1))
    bot = ry.BotOp(arm, driver=ry.KinematicDriver(arm))
    bot.follow(spline)
    bot.sync(arm, 0.7)
    np.testing.assert_allclose(arm.getJointState(), spline.eval([1.7])[0], atol=1e-12)
    bot.wait(arm)
    np.testing.assert_allclose(arm.getJointState(), q + 0.3, atol=1e-12)


def test_a_motion_starts_at_the_robot_or_not_at_all(arm: ry.Config) -> None:
    q = arm.getJointState()
    bot = ry.BotOp(arm, driver=ry.KinematicDriver(arm))
    with pytest.raises(
        ry.ArgumentError, match="starts with joint 'link0' at 0.002, the robot is at 0; the tolerance is 0.001"
    ):
        bot.follow(Swing(q + 0.002))
    with pytest.raises(ry.ArgumentError, match="its limit is 2 /s; take at least 1.57"):
        bot.follow(Swing(q, 0.5, 1.0))
    with pytest.raises(ry.ArgumentError, match="has 3 dofs; the robot has 4 joints"):
        bot.follow(Swing(q[:3]))
    with pytest.raises(TypeError):
        bot.follow([q, q])
    bot.follow(Swing(q + 0.002), tolerance=0.01)
    bot.sync(arm, 1.0)
    np.testing.assert_allclose(arm.getJointState(), q + 0.602, atol=1e-12)
    bot.stop(arm)
    assert bot.getMode() == ry.LoopMode.hold


def test_motions_follow_one_another_and_a_log_repeats_them(arm: ry.Config) -> None:
    start, shown = arm.copy(), arm.copy()
    q = arm.getJointState()
    bot = ry.BotOp(arm, driver=ry.KinematicDriver(arm))
    bot.follow(Swing(q))
    bot.follow(Swing(q, 0.1))
    bot.move(q + 0.2, [1.0])
    assert bot.getTimeToEnd() == pytest.approx(5.0)
    bot.sync(shown, 3.0)
    np.testing.assert_allclose(shown.getJointState(), q + 0.2, atol=1e-12)
    bot.wait(shown)
    np.testing.assert_allclose(shown.getJointState(), q + 0.2, atol=1e-12)
    again = ry.BotOp(start, driver=ry.KinematicDriver(start))
    again.replay(ry.CommandLog.fromText(bot.getLog().text()))
    np.testing.assert_array_equal(again.get_q(), bot.get_q())
