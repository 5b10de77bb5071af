"""The driver of the FR3 against a stand-in for pylibfranka, with an arm that follows its commands at once."""

from __future__ import annotations

import sys
import threading
import time
import types

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.robots import FrankaDriver
from kinegraph.robots.franka import ACCELERATION, VELOCITY

START = [0.0, -0.5, 0.0, -2.0, 0.0, 2.0, 0.785]


class StandIn:
    """The arm: a cycle of 1 ms whenever the driver reads, at the pace of the wall clock."""

    def __init__(self) -> None:
        self.q = list(START)
        self.sent: list[list[float]] = []
        self.time = 0.0
        self.began = 0.0
        self.reflex = ""
        self.errors = ""
        self.calls: list[str] = []
        self.width = 0.08
        self.may_finish = threading.Event()

    def state(self) -> types.SimpleNamespace:
        now = self.time
        return types.SimpleNamespace(
            q=list(self.q),
            q_d=list(self.q),
            dq=[0.0] * 7,
            tau_J=[1.0] * 7,
            tau_ext_hat_filtered=[0.25] * 7,
            current_errors=self.errors,
            time=types.SimpleNamespace(to_sec=lambda: now),
        )

    def install(self, monkeypatch: pytest.MonkeyPatch) -> None:
        arm = self

        class JointPositions:
            def __init__(self, q: list[float]) -> None:
                assert len(q) == 7
                self.q, self.motion_finished = q, False

        class Control:
            def readOnce(self) -> tuple[types.SimpleNamespace, types.SimpleNamespace]:
                arm.time += 0.001
                ahead = arm.began + arm.time - time.monotonic()
                if ahead > 0:
                    time.sleep(ahead)
                if arm.reflex:
                    raise RuntimeError(arm.reflex)
                return arm.state(), types.SimpleNamespace(to_sec=lambda: 0.001)

            def writeOnce(self, command: JointPositions) -> None:
                arm.q = list(command.q)
                arm.sent.append(list(command.q))
                if command.motion_finished:
                    arm.calls.append("finished")

        class Robot:
            def __init__(self, host: str, realtime: str) -> None:
                if host == "panda":
                    raise RuntimeError(
                        "libfranka: Incompatible library version (server version: 5, library version: 10)."
                    )
                arm.calls.append(f"connect {host} {realtime}")

            def read_once(self) -> types.SimpleNamespace:
                return arm.state()

            def start_joint_position_control(self, mode: str) -> Control:
                arm.calls.append(f"start {mode}")
                arm.began = time.monotonic() - arm.time
                return Control()

            def automatic_error_recovery(self) -> None:
                arm.calls.append("recovery")
                arm.reflex = arm.errors = ""

        class Gripper:
            def __init__(self, host: str) -> None:
                pass

            def read_once(self) -> types.SimpleNamespace:
                return types.SimpleNamespace(width=arm.width)

            def move(self, width: float, speed: float) -> bool:
                assert arm.may_finish.wait(10.0)
                arm.width = width
                return True

            def grasp(self, width: float, speed: float, force: float, inner: float, outer: float) -> bool:
                arm.calls.append(f"grasp {force:g} N")
                return self.move(0.03, speed)

        module = types.ModuleType("pylibfranka")
        module.JointPositions, module.Robot, module.Gripper = JointPositions, Robot, Gripper
        module.ControllerMode = types.SimpleNamespace(JointImpedance="impedance")
        module.RealtimeConfig = types.SimpleNamespace(kEnforce="enforced", kIgnore="ignored")
        monkeypatch.setitem(sys.modules, "pylibfranka", module)


@pytest.fixture
def arm(monkeypatch: pytest.MonkeyPatch) -> StandIn:
    stand_in = StandIn()
    stand_in.install(monkeypatch)
    return stand_in


@pytest.fixture
def C() -> ry.Config:
    config = ry.Config()
    config.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return config


def test_an_fr3_follows_smoothly_and_rests_before_the_end(arm: StandIn, C: ry.Config) -> None:
    driver = FrankaDriver(C, "fr3", hand=False)
    bot = ry.BotOp(C, True, driver=driver)
    assert arm.calls == ["connect fr3 enforced", "start impedance"]
    np.testing.assert_allclose(bot.get_q(), START)
    goal = np.add(START, [0.3, 0.1, 0, 0, 0, 0, 0.2])
    bot.moveTo(goal)
    bot.wait(C)
    bot.sync(C, 0.2)
    np.testing.assert_allclose(arm.q, goal, atol=1e-3)
    np.testing.assert_allclose(bot.get_tauExternal(), 0.25)
    bot.moveTo(np.array(START))
    bot.sync(C, 0.3)
    bot.close()
    assert arm.calls[-1] == "finished" and driver.cycles == len(arm.sent)
    sent = np.array(arm.sent)
    velocity = np.diff(sent, axis=0) / 1e-3
    acceleration = np.diff(velocity, axis=0) / 1e-3
    assert (np.abs(velocity) <= VELOCITY).all() and np.abs(velocity[-1]).max() < 1e-2
    assert (np.abs(acceleration) <= np.array(ACCELERATION) * 1.01).all()


def test_a_reflex_stops_the_robot_until_it_recovers(arm: StandIn, C: ry.Config) -> None:
    bot = ry.BotOp(C, True, driver=FrankaDriver(C, "fr3", hand=False))
    arm.reflex = "libfranka: Move command aborted: motion aborted by reflex! [cartesian_reflex]"
    with pytest.raises(ry.RobotFault, match="cartesian_reflex"):
        bot.sync(C, 0.3)
    bot.recover()
    assert "recovery" in arm.calls
    bot.moveTo(np.add(START, 0.05))
    bot.wait(C)
    assert bot.getFault() == ""
    bot.close()


def test_states_that_are_not_numbers_stop_the_robot_within_its_limits(arm: StandIn, C: ry.Config) -> None:
    bot = ry.BotOp(C, True, driver=FrankaDriver(C, "fr3", hand=False))
    bot.moveTo(np.add(START, [0.5, 0, 0, 0, 0, 0, 0]))
    bot.sync(C, 0.3)
    healthy = arm.state

    def broken() -> types.SimpleNamespace:
        state = healthy()
        state.q = [float("nan")] * 7
        return state

    arm.state = broken  # type: ignore[method-assign]
    with pytest.raises(ry.RobotFault, match="finite"):
        bot.sync(C, 0.5)
    bot.close()
    sent = np.array(arm.sent)
    assert np.isfinite(sent).all() and np.ptp(sent[-20:, 0]) < 1e-6
    assert np.abs(np.diff(sent, 2, axis=0)).max() / 1e-6 <= 10.1


def test_the_hand_moves_while_the_arm_does(arm: StandIn, C: ry.Config) -> None:
    bot = ry.BotOp(C, True, driver=FrankaDriver(C, "fr3", realtime=False))
    assert arm.calls[0] == "connect fr3 ignored"
    bot.gripperClose(0, force=30.0)
    bot.sync(C, 0.1)
    assert not bot.gripperDone(0)
    arm.may_finish.set()
    bot.wait(C, forTimeToEnd=False, forGripper=True)
    assert bot.getGripperPos(0) == pytest.approx(0.03) and "grasp 30 N" in arm.calls
    bot.close()


def test_a_wrong_version_and_a_missing_package_are_named(
    arm: StandIn, C: ry.Config, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(
        ry.RobotFault, match=r"no connection to an FR3 at panda .*server version: 5, library version: 10"
    ):
        ry.BotOp(C, True, driver=FrankaDriver(C, "panda"))
    monkeypatch.setitem(sys.modules, "pylibfranka", None)
    with pytest.raises(ry.RobotFault, match="pylibfranka"):
        ry.BotOp(C, True, driver=FrankaDriver(C, "fr3"))
