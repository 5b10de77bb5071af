"""The driver of WidowX AI arms: against a stand-in for trossen-arm, and, if installed, Trossen's simulator."""

from __future__ import annotations

import subprocess
import sys
import time
import types
from typing import Any

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.robots import TrossenDriver


class StandIn:
    """An arm that follows at once; 1 ms passes with each read."""

    def __init__(self) -> None:
        self.q, self.gripper, self.error, self.time = [0.0] * 6, 0.02, "No error", 0.0
        self.calls: list[tuple[Any, ...]] = []
        self.sent: list[list[float]] = []
        self.joints, self.broken = 7, False

    def install(self, monkeypatch: pytest.MonkeyPatch) -> None:
        arm = self

        class TrossenArmDriver:
            def configure(self, model: str, end_effector: str, host: str, clear: bool, timeout: float) -> None:
                arm.calls.append(("configure", model, end_effector, host, clear))

            def get_joint_limits(self) -> list[types.SimpleNamespace]:
                limit = types.SimpleNamespace(position_min=-3.0, position_max=3.0, velocity_max=2.0, effort_max=27.0)
                hand = types.SimpleNamespace(position_min=0.0, position_max=0.044, velocity_max=1.0, effort_max=100.0)
                return [limit] * (arm.joints - 1) + [hand]

            def set_all_modes(self, mode: str) -> None:
                arm.calls.append(("mode", mode))

            def get_robot_output(self) -> types.SimpleNamespace:
                arm.time += 0.01
                values = types.SimpleNamespace(
                    positions=[float("nan")] * 6 if arm.broken else list(arm.q),
                    velocities=[0.0] * 6,
                    efforts=[1.0] * 6,
                    external_efforts=[0.5] * 6,
                )
                joint = types.SimpleNamespace(arm=values, gripper=types.SimpleNamespace(position=arm.gripper))
                return types.SimpleNamespace(header=types.SimpleNamespace(timestamp=int(arm.time * 1e6)), joint=joint)

            def get_error_information(self) -> str:
                return arm.error

            def get_arm_positions(self) -> list[float]:
                return list(arm.q)

            def set_arm_positions(
                self, goal: list[float], seconds: float, blocking: bool, velocities: list[float] | None = None
            ) -> None:
                assert not blocking and all(type(x) is float for x in goal)
                arm.q = list(goal)
                arm.sent.append(list(goal))

            def set_gripper_position(self, goal: float, seconds: float, blocking: bool) -> None:
                assert not blocking and seconds > 0
                arm.gripper = goal

            def clear_error(self) -> None:
                arm.error = "No error"

            def cleanup(self) -> None:
                arm.calls.append(("cleanup",))

        module = types.ModuleType("trossen_arm")
        module.TrossenArmDriver = TrossenArmDriver
        module.Model = types.SimpleNamespace(wxai_v0="model")
        module.StandardEndEffector = types.SimpleNamespace(wxai_v0_follower="follower")
        module.Mode = types.SimpleNamespace(position="position", idle="idle")
        monkeypatch.setitem(sys.modules, "trossen_arm", module)


@pytest.fixture
def arm(monkeypatch: pytest.MonkeyPatch) -> StandIn:
    stand_in = StandIn()
    stand_in.install(monkeypatch)
    return stand_in


@pytest.fixture
def C() -> ry.Config:
    config = ry.Config()
    config.addFile(ry.raiPath("trossen/trossen.g"))
    config.selectJoints([f"joint_{i}" for i in range(6)])
    return config


def test_a_widowx_follows_and_has_the_narrower_limits(arm: StandIn, C: ry.Config) -> None:
    bot = ry.BotOp(C, driver=TrossenDriver(C, "192.168.1.2"))
    assert arm.calls == [("configure", "model", "follower", "192.168.1.2", False), ("mode", "position")]
    info = bot.getInfo()
    np.testing.assert_allclose(info.velocity, 2.0)
    assert info.upper[0] == 3.0 and info.upper[3] == pytest.approx(np.pi / 2)
    assert info.grippers[0].max_width == pytest.approx(0.088)
    goal = np.array([0.3, 0.5, 0.6, -0.4, 0.1, 0.2])
    bot.moveTo(goal)
    bot.wait(C)
    bot.sync(C, 0.05)
    np.testing.assert_allclose(bot.get_q(), goal, atol=1e-6)
    np.testing.assert_allclose(bot.get_tauExternal(), 0.5)
    assert np.abs(np.diff(arm.sent, axis=0)).max() <= 2.0 * 0.01 * 1.3
    with pytest.raises(ry.ArgumentError, match="limit is 2"):
        bot.move([goal + 0.3], [0.15])
    bot.gripperMove(0, 0.06)
    assert arm.gripper == pytest.approx(0.03)
    bot.sync(C, 0.1)
    assert bot.gripperDone(0) and bot.getGripperPos(0) == pytest.approx(0.06)
    bot.close()
    assert arm.calls[-2:] == [("mode", "idle"), ("cleanup",)]


def test_an_error_of_the_controller_holds_the_arm_until_it_recovers(arm: StandIn, C: ry.Config) -> None:
    bot = ry.BotOp(C, driver=TrossenDriver(C, "arm"))
    bot.moveTo(np.array([0.5, 0.5, 0.5, 0.0, 0.0, 0.0]))
    bot.sync(C, 0.2)
    arm.error = "Joint 2 overheats"
    with pytest.raises(ry.RobotFault, match="Joint 2 overheats"):
        bot.wait(C)
    assert arm.sent[-1] == arm.sent[-2]
    bot.recover()
    bot.sync(C, 0.1)
    assert arm.error == "No error" and bot.getFault() == ""
    arm.broken = True
    with pytest.raises(ry.RobotFault, match="finite"):
        bot.sync(C, 0.1)


def test_states_that_are_not_numbers_and_a_lost_connection_hold_the_arm(
    arm: StandIn, C: ry.Config, monkeypatch: pytest.MonkeyPatch
) -> None:
    bot = ry.BotOp(C, driver=TrossenDriver(C, "192.168.1.2"))
    bot.moveTo(bot.get_q() + 0.3)
    bot.sync(C, 0.3)
    arm.broken = True
    with pytest.raises(ry.RobotFault, match="not finite|nan"):
        bot.sync(C, 0.5)
    held = list(arm.q)
    arm.broken = False
    bot.recover()
    bot.sync(C, 0.2)
    np.testing.assert_allclose(arm.q, held, atol=1e-9)

    def lost(_: object) -> None:
        raise RuntimeError("connection reset by peer")

    monkeypatch.setattr(sys.modules["trossen_arm"].TrossenArmDriver, "get_robot_output", lost)
    with pytest.raises(ry.RobotFault, match="connection reset by peer"):
        bot.sync(C, 0.5)
    np.testing.assert_allclose(arm.q, held, atol=1e-9)


def test_other_arms_and_names_are_refused(arm: StandIn, C: ry.Config) -> None:
    whole = ry.Config()
    whole.addFile(ry.raiPath("trossen/trossen.g"))
    with pytest.raises(ry.ArgumentError, match=r"has 7 joints \(joint_0, .*right_carriage_joint\); expected the six"):
        TrossenDriver(whole, "arm")
    with pytest.raises(ry.ArgumentError, match="acceleration is -1"):
        TrossenDriver(C, "arm", acceleration=-1)
    with pytest.raises(ry.RobotFault, match="model is 'wxai'; expected one of wxai_v0"):
        ry.BotOp(C, driver=TrossenDriver(C, "arm", model="wxai"))
    arm.joints = 8
    with pytest.raises(ry.RobotFault, match="the arm has 8 joints; expected 6 and the gripper"):
        ry.BotOp(C, driver=TrossenDriver(C, "arm"))
    assert arm.calls[-1] == ("cleanup",)


def test_an_arm_of_trossen_s_simulator_moves(C: ry.Config) -> None:
    pytest.importorskip("trossen_arm")
    pytest.importorskip("trossen_arm_sim")
    command = [sys.executable, "-m", "trossen_arm_sim", "--host", "127.0.0.1", "--ws-port", "0"]
    simulator = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + 30
        while True:
            try:
                bot = ry.BotOp(C, True, driver=TrossenDriver(C, "127.0.0.1", connect_timeout=1.0))
                break
            except ry.RobotFault:
                assert time.monotonic() < deadline
        goal = np.array([0.5, 1.0, 1.0, -0.5, 0.3, 0.2])
        bot.moveTo(goal)
        bot.wait(C)
        bot.sync(C, 0.5)
        np.testing.assert_allclose(bot.get_q(), goal, atol=5e-3)
        bot.gripperMove(0, 0.06)
        bot.wait(C, forTimeToEnd=False, forGripper=True)
        assert bot.getGripperPos(0) == pytest.approx(0.06, abs=5e-3)
        simulator.kill()
        with pytest.raises(ry.RobotFault, match="Failed to read UDP message"):
            bot.sync(C, 1.0)
        bot.close()
    finally:
        simulator.kill()
