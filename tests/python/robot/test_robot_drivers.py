"""Drivers of robots: vendors' drivers against stand-ins for the vendors' packages, and drivers in Python."""

from __future__ import annotations

import importlib
import sys
import threading
import time
import types
from typing import Any

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.robots import FrankaDriver, PandaDriver, TrossenDriver, UrDriver


def ur_scene() -> ry.Config:
    C = ry.Config()
    C.addFrame("joint0_base")
    for i, axis in enumerate("ZYYYZY"):
        parent = f"joint{i - 1}" if i else "joint0_base"
        C.addFrame(f"joint{i}", parent, f"joint: hinge{axis}, limits: [-6.28 6.28], ctrl_limits: [3.14 150 -1]")
    return C


class UrStandIn:
    """Stand-in for the two interfaces of ur-rtde, with a controller that follows at once."""

    def __init__(self) -> None:
        self.q, self.qd, self.calls, self.stopped = [0.1] * 6, [0.0] * 6, [], False
        self.emergency, self.running, self.connected, self.time = False, True, True, 0.0

    def install(self, monkeypatch: pytest.MonkeyPatch) -> None:
        stand_in = self

        class RTDEControlInterface:
            def __init__(self, hostname: str, frequency: float = -1.0, flags: int = 1) -> None:
                stand_in.calls.append(("control", hostname))

            def servoJ(self, q: list[float], a: float, b: float, t: float, lookahead: float, gain: float) -> bool:
                assert all(type(x) is float for x in q) and 0.03 <= lookahead <= 0.2 and 100 <= gain <= 2000
                stand_in.qd = [(new - old) / t for new, old in zip(q, stand_in.q, strict=True)]
                stand_in.q = list(q)
                return stand_in.running

            def servoStop(self, a: float = 10.0) -> bool:
                stand_in.calls.append(("servoStop", a))
                return True

            def isProgramRunning(self) -> bool:
                return stand_in.running

            def reuploadScript(self) -> bool:
                stand_in.calls.append(("reuploadScript",))
                stand_in.running = not stand_in.stopped
                return stand_in.running

            def disconnect(self) -> None:
                stand_in.calls.append(("disconnect",))

        class RTDEReceiveInterface:
            def __init__(self, hostname: str, frequency: float = -1.0) -> None:
                stand_in.calls.append(("receive", hostname))

            def getTimestamp(self) -> float:
                stand_in.time += 0.008
                return stand_in.time

            def getActualQ(self) -> list[float]:
                return stand_in.q

            def getActualQd(self) -> list[float]:
                return stand_in.qd

            def isConnected(self) -> bool:
                return stand_in.connected

            def isEmergencyStopped(self) -> bool:
                return stand_in.emergency

            def isProtectiveStopped(self) -> bool:
                return stand_in.stopped

            def reconnect(self) -> bool:
                return True

            def disconnect(self) -> None:
                stand_in.calls.append(("leave",))

        monkeypatch.setitem(
            sys.modules, "rtde_control", types.SimpleNamespace(RTDEControlInterface=RTDEControlInterface)
        )
        monkeypatch.setitem(
            sys.modules, "rtde_receive", types.SimpleNamespace(RTDEReceiveInterface=RTDEReceiveInterface)
        )


def test_a_ur_is_moved_by_servoj_and_stopped_at_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = UrStandIn()
    arm.install(monkeypatch)
    C = ur_scene()
    bot = ry.BotOp(C, driver=UrDriver(C, "192.168.0.3"))  # virtual time: the stand-in follows at once
    assert arm.calls == [("receive", "192.168.0.3"), ("control", "192.168.0.3")]
    assert bot.get_q() == pytest.approx([0.1] * 6)
    bot.moveTo(np.full(6, 0.3))
    bot.wait(C)
    assert arm.q == pytest.approx([0.3] * 6) and arm.qd == pytest.approx([0.0] * 6, abs=1e-2)
    assert C.getJointState() == pytest.approx([0.3] * 6)
    with pytest.raises(ry.ArgumentError, match="limit is 3.14"):
        bot.move(np.full((1, 6), 3.0), [0.5])
    with pytest.raises(ry.RobotFault, match="stiffness is fixed"):
        bot.floating()
    with pytest.raises(ry.ArgumentError, match="robot has none"):
        bot.gripperMove(0)
    bot.close()
    assert arm.calls[-3:] == [("servoStop", 10.0), ("disconnect",), ("leave",)]


def test_a_protective_stop_of_a_ur_is_reported_and_cleared(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = UrStandIn()
    arm.install(monkeypatch)
    C = ur_scene()
    bot = ry.BotOp(C, driver=UrDriver(C, "ur"))
    bot.moveTo(np.full(6, 0.5))
    bot.sync(C, 0.2)
    arm.stopped, arm.running = True, False
    where = list(arm.q)
    with pytest.raises(ry.RobotFault, match="protective stop"):
        bot.wait(C)
    assert ("servoStop", 10.0) in arm.calls
    with pytest.raises(ry.RobotFault, match="is the stop released"):
        bot.recover()
    arm.stopped = False
    bot.recover()
    bot.sync(C, 0.1)
    assert arm.q == pytest.approx(where, abs=0.05) and bot.getFault() == ""
    arm.emergency = True
    with pytest.raises(ry.RobotFault, match="emergency stop"):
        bot.sync(C)


class FrankaStandIn:
    """Stand-in for panda-python, with an arm that follows at once and a slow hand."""

    def __init__(self) -> None:
        self.q, self.dq, self.errors, self.time = np.array([0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]), np.zeros(7), "", 0.0
        self.stiffness = self.damping = np.zeros(7)
        self.calls: list[str] = []
        self.width = 0.08
        self.may_finish = threading.Event()

    def install(self, monkeypatch: pytest.MonkeyPatch) -> None:
        stand_in = self

        class JointPosition:
            def __init__(self, stiffness: np.ndarray, damping: np.ndarray, filter_coeff: float = 1.0) -> None:
                self.set_stiffness(stiffness)
                self.set_damping(damping)

            def set_control(self, position: np.ndarray, velocity: np.ndarray) -> None:
                assert position.shape == velocity.shape == (7,)
                if stand_in.stiffness.any():
                    stand_in.q, stand_in.dq = position, velocity

            def set_stiffness(self, stiffness: np.ndarray) -> None:
                stand_in.stiffness = stiffness

            def set_damping(self, damping: np.ndarray) -> None:
                stand_in.damping = damping

        class Panda:
            def __init__(self, hostname: str) -> None:
                stand_in.calls.append(f"connect {hostname}")

            def get_state(self) -> types.SimpleNamespace:
                stand_in.time += 0.01
                now = stand_in.time
                return types.SimpleNamespace(
                    q=list(stand_in.q),
                    dq=list(stand_in.dq),
                    tau_J=[1.0] * 7,
                    tau_ext_hat_filtered=[0.25] * 7,
                    current_errors=stand_in.errors,
                    time=types.SimpleNamespace(to_sec=lambda: now),
                )

            def start_controller(self, controller: JointPosition) -> None:
                stand_in.calls.append("start")

            def stop_controller(self) -> None:
                stand_in.calls.append("stop")

            def recover(self) -> None:
                stand_in.errors = ""

        class Gripper:
            def __init__(self, franka_address: str) -> None:
                stand_in.calls.append(f"hand {franka_address}")

            def read_once(self) -> types.SimpleNamespace:
                return types.SimpleNamespace(width=stand_in.width)

            def move(self, width: float, speed: float) -> bool:
                assert stand_in.may_finish.wait(10.0)
                stand_in.width = width
                return True

            def grasp(
                self, width: float, speed: float, force: float, epsilon_inner: float, epsilon_outer: float
            ) -> bool:
                stand_in.calls.append(f"grasp {force:g} N")
                return self.move(0.03, speed)

        module = types.ModuleType("panda_py")
        module.Panda = Panda
        module.libfranka = types.SimpleNamespace(Gripper=Gripper)
        module.controllers = types.SimpleNamespace(JointPosition=JointPosition)
        monkeypatch.setitem(sys.modules, "panda_py", module)


@pytest.fixture
def franka(monkeypatch: pytest.MonkeyPatch) -> FrankaStandIn:
    stand_in = FrankaStandIn()
    stand_in.install(monkeypatch)
    return stand_in


@pytest.fixture
def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def test_a_franka_follows_and_reports_its_torques(franka: FrankaStandIn, panda: ry.Config) -> None:
    bot = ry.BotOp(panda, driver=PandaDriver(panda, "franka"))
    assert franka.calls == ["connect franka", "hand franka", "start"]
    q = bot.get_q() + 0.2 * np.eye(7)[0]
    bot.moveTo(q)
    bot.wait(panda)
    assert franka.q == pytest.approx(q) and panda.getJointState() == pytest.approx(q)
    assert bot.get_tauExternal() == pytest.approx([0.25] * 7)
    bot.setCompliance(np.eye(7)[:2], 0.75)
    bot.sync(panda)
    assert franka.stiffness == pytest.approx([150, 150, 600, 600, 250, 150, 50])
    bot.floating(0.5)
    bot.sync(panda)
    assert not franka.stiffness.any() and franka.damping == pytest.approx([25, 25, 25, 10, 10, 10, 5])
    bot.hold()
    bot.sync(panda)
    assert franka.stiffness == pytest.approx([600, 600, 600, 600, 250, 150, 50])
    bot.close()
    assert franka.calls[-1] == "stop"


def test_a_franka_s_hand_moves_while_the_arm_does(franka: FrankaStandIn, panda: ry.Config) -> None:
    bot = ry.BotOp(panda, driver=PandaDriver(panda, "franka"))
    bot.gripperClose(ry.ArgWord._left, force=30.0)
    bot.sync(panda)
    assert not bot.gripperDone(0) and bot.getGripperPos(0) == pytest.approx(0.08)
    franka.may_finish.set()
    end = time.monotonic() + 10.0
    while not bot.gripperDone(0) and time.monotonic() < end:
        time.sleep(0.01)
    assert bot.getGripperPos(0) == pytest.approx(0.03) and "grasp 30 N" in franka.calls
    bot.close()


def test_a_reflex_of_a_franka_is_reported_and_cleared(franka: FrankaStandIn, panda: ry.Config) -> None:
    bot = ry.BotOp(panda, driver=PandaDriver(panda, "franka", hand=False))
    franka.errors = "[cartesian_reflex]"
    with pytest.raises(ry.RobotFault, match="cartesian_reflex"):
        bot.wait(panda)
    with pytest.raises(ry.RobotFault, match="cartesian_reflex"):
        bot.moveTo(bot.get_q())
    bot.recover()
    bot.moveTo(bot.get_q() + 0.05)
    bot.wait(panda)
    assert franka.calls.count("start") == 2


class OwnRobot(ry.RobotDriver):
    """A driver in Python, whose robot follows its commands exactly."""

    def __init__(self, config: ry.Config) -> None:
        super().__init__()
        self._info = ry.RobotInfo.of(config, "mine")
        self.q = config.getJointState()
        self.time = 0.0
        self.error: BaseException | None = None
        self.said: list[str] = []

    def info(self) -> ry.RobotInfo:
        return self._info

    def read(self) -> ry.RobotState:
        if self.error:
            raise self.error
        self.time += 0.01
        return ry.RobotState(self.time, self.q, np.zeros(len(self.q)))

    def write(self, command: ry.RobotCommand) -> None:
        self.q = command.q

    def stop(self, reason: str) -> None:
        self.said.append(reason)


def test_a_driver_that_is_written_in_python_moves_a_robot(panda: ry.Config) -> None:
    robot = OwnRobot(panda)
    bot = ry.BotOp(panda, driver=robot)
    bot.move([bot.get_q() + 0.1], [1.0])
    bot.wait(panda)
    assert robot.q == pytest.approx(bot.get_qHome() + 0.1)


class SlowHand(OwnRobot):
    """A robot with a gripper, whose state takes a while to come."""

    def info(self) -> ry.RobotInfo:
        self._info.grippers = [ry.GripperInfo("hand", 0.0, 0.08, 0.1, 70.0)]
        return self._info

    def read(self) -> ry.RobotState:
        time.sleep(0.002)  # other threads of Python run meanwhile
        state = super().read()
        return ry.RobotState(state.time, state.q, state.velocity, grippers=[ry.GripperState(0.08, True)])

    def moveGripper(self, command: ry.GripperCommand) -> None:
        pass


def test_grippers_of_a_robot_in_real_time_are_told_while_its_driver_reads(panda: ry.Config) -> None:
    bot = ry.BotOp(panda, driver=SlowHand(panda), realtime=True)
    for _ in range(50):
        with pytest.warns(ry.KinegraphWarning, match="a width of 0.2 m is beyond the opening of gripper 'hand'"):
            bot.gripperMove(0, 0.2)
        bot.gripperCloseGrasp(0, "l_gripper")
    bot.close()


def test_what_a_driver_raises_stops_the_robot_and_is_reported(panda: ry.Config) -> None:
    robot = OwnRobot(panda)
    bot = ry.BotOp(panda, driver=robot)
    robot.error = OSError("the cable is out")
    with pytest.raises(ry.RobotFault, match=r"the driver's read\(\) raised OSError: the cable is out"):
        bot.sync(panda)
    assert len(robot.said) == 1 and "cable" in robot.said[0]
    robot.error = None
    bot.recover()
    bot.sync(panda)
    robot.error = KeyboardInterrupt()  # Ctrl-C is not a fault
    with pytest.raises(KeyboardInterrupt):
        bot.sync(panda)
    robot.error = None
    assert bot.getMode() == ry.LoopMode.hold and bot.getFault() == ""


def test_a_driver_without_its_methods_says_which(panda: ry.Config) -> None:
    class Half(ry.RobotDriver):
        def info(self) -> ry.RobotInfo:
            return ry.RobotInfo.of(panda, "half")

    with pytest.raises(ry.Error, match="read"):
        ry.BotOp(panda, driver=Half())

    class Wrong(OwnRobot):
        def read(self):  # type: ignore[no-untyped-def]
            return "here"

    with pytest.raises(ry.RobotFault, match=r"read\(\) returned an object of a wrong type"):
        ry.BotOp(panda, driver=Wrong(panda))


def test_a_driver_in_python_runs_in_real_time_beside_the_script(panda: ry.Config) -> None:
    robot = OwnRobot(panda)
    bot = ry.BotOp(panda, True, driver=robot)
    bot.moveTo(bot.get_q() + 0.01, timeCost=100.0)
    end = time.monotonic() + 20.0
    while bot.getTimeToEnd() > 0.0 and time.monotonic() < end:
        pass  # the thread still gets the interpreter
    assert robot.q == pytest.approx(bot.get_qHome() + 0.01)
    bot.close()
    with pytest.raises(ry.RobotFault, match="closed"):
        bot.get_q()


def test_a_recorded_robot_returns_its_states_and_records_its_commands(panda: ry.Config) -> None:
    info = ry.RobotInfo.of(panda, "tape")
    q = panda.getJointState()
    tape = ry.RecordedDriver(info, [ry.RobotState(0.01 * i, q + 0.001 * i, np.zeros(7)) for i in range(5)])
    bot = ry.BotOp(panda, driver=tape)
    bot.sync(panda, 0.03)
    assert bot.get_q() == pytest.approx(q + 0.003)
    assert len(tape.commands()) == 3 and tape.commands()[0].q == pytest.approx(q) and tape.commands()[0].isStiff()
    with pytest.raises(ry.ArgumentError, match="velocity has 3 numbers; expected 7"):
        ry.RobotInfo("odd", info.joints, velocity=[1.0, 2.0, 3.0])


def test_a_function_can_be_watched_while_a_driver_in_python_runs_in_real_time(panda: ry.Config) -> None:
    class Paced(OwnRobot):
        """Is often in its calls, so that its thread and the script want the interpreter at the same time."""

        def read(self) -> ry.RobotState:
            time.sleep(0.005)
            return super().read()

    bot = ry.BotOp(panda, True, driver=Paced(panda))
    calls: list[float] = []
    for _ in range(20):
        bot.watch(0.0, calls.append)  # took the lock of the robot's thread with the interpreter's: both waited forever
        time.sleep(0.002)
    bot.sync(panda, 0.1)
    assert len(calls) >= 20
    bot.close()


@pytest.mark.parametrize(
    ("driver", "package"),
    [
        (FrankaDriver, "pylibfranka"),
        (PandaDriver, "panda_py"),
        (TrossenDriver, "trossen_arm"),
        (UrDriver, "rtde_receive"),
    ],
)
def test_a_driver_names_the_joints_that_it_expects_and_the_package_that_it_needs(
    driver: Any, package: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    five = ry.Config()
    five.addFile(ry.raiPath("so101/so101.g"))
    expected = (
        rf"{driver.__name__}: q of the scene has 5 joints \(shoulder_pan, .*\); expected the (six|seven) of the arm"
    )
    with pytest.raises(ry.ArgumentError, match=expected):
        driver(five, "host")
    monkeypatch.setitem(sys.modules, package, None)
    arm = ry.Config()
    arm.addFile(ry.raiPath("panda/panda.g" if driver in (FrankaDriver, PandaDriver) else "ur5e/ur5e.g"))
    with pytest.raises(ry.RobotFault, match=rf"the package {package} is not installed: pip install 'kinegraph\[\w+\]'"):
        ry.BotOp(arm, True, driver=driver(arm, "host"))


def test_environments_name_the_package_that_they_need(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    for module in ("gym", "task_env"):
        monkeypatch.delitem(sys.modules, f"kinegraph.{module}", raising=False)
        with pytest.raises(ModuleNotFoundError, match=rf"kinegraph.{module} needs the package gymnasium: pip install"):
            importlib.import_module(f"kinegraph.{module}")
