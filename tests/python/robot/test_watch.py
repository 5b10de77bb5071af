"""Functions that waiting calls call regularly: for records, bridges and guards."""

import gc
import weakref

import numpy as np
import pytest

import kinegraph as ry
from task_scenes import panda_tasks, planned


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def test_a_function_is_called_at_multiples_of_its_period() -> None:
    C = panda()
    bot, times = ry.BotOp(C), []
    bot.watch(0.05, times.append)
    assert times == []  # the first call comes with the first wait
    bot.moveTo(bot.get_qHome() + 0.2)
    bot.sync(C, 0.5)
    np.testing.assert_allclose(times, times[0] + 0.05 * np.arange(11), atol=1e-9)
    bot.wait(C)
    assert len(times) == 1 + int((bot.get_t() - times[0]) / 0.05 + 1e-6)


def test_each_control_period_has_a_call() -> None:
    C = panda()
    bot, times = ry.BotOp(C), []
    bot.watch(0, times.append)
    bot.sync(C, 0.2)
    np.testing.assert_allclose(np.diff(times), 0.01, atol=1e-9)
    assert len(times) == 21


def test_polling_waits_too() -> None:
    bot, times = ry.BotOp(panda()), []
    bot.watch(0.01, times.append)
    bot.moveTo(bot.get_qHome() + 0.1)
    while bot.getTimeToEnd() > 0:
        pass
    assert len(times) > 50


def test_false_ends_it_and_nothing_else_does() -> None:
    C = panda()
    bot, calls = ry.BotOp(C), []

    def count(time: float) -> bool:
        calls.append(time)
        return len(calls) < 3

    bot.watch(0.01, count)
    bot.watch(0.01, lambda _: None)
    bot.sync(C, 0.2)
    assert len(calls) == 3


def test_queries_inside_see_one_state_and_do_not_move_the_clock() -> None:
    C = panda()
    bot, seen = ry.BotOp(C), []
    bot.moveTo(bot.get_qHome() + 0.2)

    def look(time: float) -> None:
        seen.append((time, bot.get_t(), bot.get_t(), *[bot.get_q() for _ in range(3)], bot.stepObservation().qpos))

    bot.watch(0.1, look)
    before = bot.get_t()
    bot.sync(C, 0.5)
    assert bot.get_t() - before == pytest.approx(0.5)
    for time, a, b, *q in seen:
        assert time == a == b
        for other in q[1:]:
            np.testing.assert_array_equal(q[0], other)


def test_a_watched_motion_is_the_same_to_the_bit() -> None:
    ends = []
    for watched in (False, True):
        C = panda()
        bot = ry.BotOp(C)
        if watched:
            bot.watch(0.02, lambda _, bot=bot: (bot.get_q(), bot.getGripperPos(0), None)[2])
        bot.moveTo(bot.get_qHome() + 0.3)
        bot.sync(C, 1.0)
        ends.append(C.getFrameState())
    np.testing.assert_array_equal(*ends)


def test_a_guard_holds_the_robot() -> None:
    C = panda()
    bot = ry.BotOp(C)
    bot.moveTo(bot.get_qHome() + 0.5)

    def guard(_: float) -> bool:
        if bot.get_q()[0] - bot.get_qHome()[0] < 0.1:
            return True
        bot.hold()
        return False

    bot.watch(0.01, guard)
    bot.wait(C)
    assert 0.1 < bot.get_q()[0] - bot.get_qHome()[0] < 0.25


def test_an_exception_holds_the_robot_and_reaches_the_caller() -> None:
    C = panda()
    bot, calls = ry.BotOp(C), []
    bot.moveTo(bot.get_qHome() + 0.5)

    def broken(time: float) -> None:
        calls.append(time)
        if len(calls) == 20:
            raise ZeroDivisionError("by a guard")

    bot.watch(0.01, broken)
    with pytest.raises(ZeroDivisionError, match="by a guard"):
        bot.wait(C)
    assert bot.getMode() == ry.LoopMode.hold
    bot.sync(C, 0.1)
    assert len(calls) == 20  # it is called no more


def test_a_function_cannot_wait() -> None:
    C = panda()
    bot = ry.BotOp(C)
    bot.watch(0.01, lambda _: bot.sync(C, 0.1) and None)
    with pytest.raises(ry.ArgumentError, match="a function of watch cannot wait"):
        bot.sync(C, 0.1)
    with pytest.raises(ry.ArgumentError, match=r"period is -1 s; expected 0 or more"):
        bot.watch(-1, print)
    with pytest.raises(TypeError):
        bot.watch(0.1, 3)


def test_real_time_calls_come_from_the_waiting_thread() -> None:
    import threading

    C = panda()
    bot, calls = ry.BotOp(C, realtime=True), []
    bot.watch(0.02, lambda time: calls.append((time, threading.get_ident())))
    bot.sync(C, 0.5)
    times = np.array([time for time, _ in calls])
    assert {thread for _, thread in calls} == {threading.get_ident()}
    assert 5 <= len(times) <= 30 and np.all(np.diff(times) > 0.005)
    bot.close()


def test_a_robot_with_a_function_that_refers_to_it_is_freed() -> None:
    def made() -> weakref.ref:
        bot = ry.BotOp(panda())
        bot.watch(0.1, lambda _: bot.get_q())
        return weakref.ref(bot)

    freed = made()
    gc.collect()
    assert freed() is None


def test_the_execution_of_a_plan_is_watched() -> None:
    C, plan = planned(panda_tasks.tower(1, 2))
    bot, widths = ry.BotOp(C), []
    bot.watch(0.05, lambda _: widths.append((bot.getGripperPos(0), bot.getGripperTarget(0))))
    assert plan.execute(bot).feasible
    opened, targets = np.array(widths).T
    assert len(opened) == 1 + int(bot.get_t() / 0.05 + 1e-6)
    assert opened.max() > 0.07 and 0.03 < opened.min() < 0.06  # the cube keeps the fingers apart
    assert set(np.round(targets, 6)) == {0.0, 0.08}


class Follower(ry.RobotDriver):
    """A robot without a simulated world, whose hand stops at the width of a cube."""

    def __init__(self, config: ry.Config, grippers: list, width: float = 0.05):
        super().__init__()
        self._info = ry.RobotInfo.of(config, "follower")
        self._info.grippers = grippers
        self.q, self.v, self.time, self.width, self.grip = config.getJointState(), np.zeros(7), 0.0, 0.08, width

    def info(self):
        return self._info

    def read(self):
        grippers = [ry.GripperState(self.width, True) for _ in self._info.grippers]
        return ry.RobotState(self.time, self.q, self.v, grippers=grippers)

    def write(self, command):
        self.q, self.v = command.q, command.velocity

    def moveGripper(self, command):
        self.width = self.grip if command.grasp else command.width

    def stop(self, reason):
        self.v = np.zeros(7)

    def step(self, period):
        self.time += period


def test_a_plan_runs_on_a_robot_without_a_world() -> None:
    C, plan = planned(panda_tasks.tower(1, 2))
    driver = Follower(C, [ry.GripperInfo("hand", 0.0, 0.08, 0.1, 70.0)])  # not the name of the scene's hand
    bot = ry.BotOp(C, driver=driver)
    assert not bot.isSimulated()
    widths = []
    bot.watch(0.05, lambda _: widths.append(driver.width))
    run = plan.execute(bot)
    assert run.feasible and run.repairs == 0, run
    assert min(widths) == 0.05  # the hand closed
    assert run.C.getFrame("b0").getParent().name == "b1"
    fingers = bot.getWorld().getFrame("l_panda_finger_joint1").getRelativePosition()
    driver.moveGripper(type("C", (), {"grasp": True}))
    bot.sync(C, 0.1)
    moved = C.getFrame("l_panda_finger_joint1").getRelativePosition()
    assert np.linalg.norm(fingers - moved) == pytest.approx(0.015, abs=2e-3)


def test_cameras_tell_where_things_are_on_a_robot_without_a_world() -> None:
    C, plan = planned(panda_tasks.tower(1, 2))
    bot = ry.BotOp(C, driver=Follower(C, [ry.GripperInfo("hand", 0.0, 0.08, 0.1, 70.0)]))
    moved = C.getFrame("b0").getPose() + np.array([0.05, 0, 0, 0, 0, 0, 0])
    seen = [moved]

    def observe() -> dict:
        return {"b0": seen[-1]}

    run = plan.execute(bot, observe=observe, repairs=0)
    assert not run.feasible and "'b0' is 0.050 m away" in run.message
    repaired = plan.repair(run.C)
    np.testing.assert_allclose(run.C.getFrame("b0").getPosition(), moved[:3], atol=1e-6)
    assert repaired.feasible and repaired.execute(bot).feasible
    again = ry.BotOp(C, driver=Follower(C, [ry.GripperInfo("hand", 0.0, 0.08, 0.1, 70.0)]))
    run = plan.execute(again, observe=lambda: {"b0": moved} if again.get_t() < 1 else {}, time_limit=60)
    assert run.feasible and run.repairs == 1, run


def test_things_that_appear_later_are_brought_by_sync() -> None:
    C = panda_tasks.scene()
    bot = ry.BotOp(C, driver=Follower(C, [ry.GripperInfo("hand", 0.0, 0.08, 0.1, 70.0)]))
    panda_tasks.pad(C, "pad", [0.3, 0.35], [0.2, 0.2])
    panda_tasks.box(C, "late", "table", [-0.3, 0.3], [0.05, 0.05, 0.07])
    plan = ry.planTask(C, "(on pad late)")
    with pytest.raises(ry.ArgumentError, match=r"'late' is not in the scene of the robot; call bot.sync\(C\)"):
        plan.execute(bot)
    bot.sync(C, 0.0)
    assert plan.execute(bot).feasible


def test_a_hand_without_a_gripper_and_a_hand_that_closes_on_nothing_are_told() -> None:
    C, plan = planned(panda_tasks.tower(1, 2))
    with pytest.raises(ry.ArgumentError, match="closes 'l_gripper', and the robot's driver has no gripper"):
        plan.execute(ry.BotOp(C, driver=Follower(C, [])))
    empty = Follower(C, [ry.GripperInfo("hand", 0.0, 0.08, 0.1, 70.0)], width=0.0)
    run = plan.execute(ry.BotOp(C, driver=empty), repairs=0)
    assert not run.feasible and "closed on nothing" in run.message


def test_a_goal_that_holds_needs_no_world() -> None:
    C = panda_tasks.scene()
    panda_tasks.box(C, "a", "table", [-0.3, 0.3], [0.05, 0.05, 0.07])
    plan = ry.planTask(C, "(on table a)")
    assert plan.feasible and plan.actions == []
    assert plan.execute(ry.BotOp(C, driver=Follower(C, [ry.GripperInfo("hand")]))).feasible
