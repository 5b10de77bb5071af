"""The driver of LeRobot's robots, against a stand-in with their interface."""

from __future__ import annotations

import time
import types
from typing import Any

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.robots import LeRobotDriver

MOTORS = ["shoulder_pan", "shoulder_lift", "elbow_flex"]


class StandIn:
    """Has the interface of lerobot.robots.Robot; its motors turn toward their goals, in degrees, at a limited speed."""

    name = "stand_in"

    def __init__(self, use_degrees: bool = True) -> None:
        self.config = types.SimpleNamespace(use_degrees=use_degrees)
        self.is_connected = False
        self.position = dict.fromkeys([*MOTORS, "gripper"], 0.0)
        self.goal = dict(self.position)
        self.then = time.monotonic()
        self.delay = 0.0
        self.blocked = 0.0  # the gripper does not close further
        self.lost = ""
        self.actions: list[dict[str, float]] = []

    @property
    def action_features(self) -> dict[str, type]:
        return {f"{motor}.pos": float for motor in self.position}

    def connect(self, calibrate: bool = True) -> None:
        self.is_connected = True

    def disconnect(self) -> None:
        self.is_connected = False

    def get_observation(self) -> dict[str, Any]:
        assert self.is_connected
        time.sleep(self.delay)
        now = time.monotonic()
        for motor, goal in self.goal.items():
            most = 2000.0 * (now - self.then)
            self.position[motor] += min(max(goal - self.position[motor], -most), most)
        self.position["gripper"] = max(self.position["gripper"], self.blocked)
        self.then = now
        found: dict[str, Any] = {f"{motor}.pos": value for motor, value in self.position.items()}
        found["camera"] = np.zeros((4, 4, 3), np.uint8)
        found.pop(self.lost, None)
        return found

    def send_action(self, action: dict[str, Any]) -> dict[str, Any]:
        assert set(action) <= set(self.action_features) and all(type(value) is float for value in action.values())
        self.actions.append(action)
        self.goal.update({name.removesuffix(".pos"): value for name, value in action.items()})
        return action


def arm() -> ry.Config:
    C = ry.Config()
    C.addFrame("base")
    for above, joint in zip(["base", *MOTORS], MOTORS, strict=False):
        C.addFrame(joint, above, "joint: hingeY, limits: [-2 2], ctrl_limits: [3 -1 -1]")
    return C


@pytest.fixture
def robot() -> StandIn:
    return StandIn()


def test_a_robot_of_lerobot_follows_in_its_own_units(robot: StandIn) -> None:
    C = arm()
    driver = LeRobotDriver(C, robot, signs={"elbow_flex": -1}, offsets={"shoulder_lift": 0.5})
    bot = ry.BotOp(C, True, driver=driver)
    np.testing.assert_allclose(bot.get_q(), [0.0, 0.5, 0.0])
    bot.moveTo(np.array([0.3, 0.7, -0.2]))
    bot.wait(C)
    bot.sync(C, 0.1)
    np.testing.assert_allclose(bot.get_q(), [0.3, 0.7, -0.2], atol=1e-3)
    np.testing.assert_allclose([robot.position[m] for m in MOTORS], np.degrees([0.3, 0.2, 0.2]), atol=0.05)
    pan = np.radians([action["shoulder_pan.pos"] for action in robot.actions])
    assert np.abs(np.diff(pan)).max() < 3 * 0.02  # within the limit of velocity, even if a period is skipped
    assert "gripper.pos" not in robot.actions[0]
    bot.close()
    assert not robot.is_connected


def test_motors_have_their_own_names_and_radians(robot: StandIn) -> None:
    C = ry.Config()
    C.addFrame("base")
    C.addFrame("yaw", "base", "joint: hingeZ, ctrl_limits: [3 -1 -1]")
    robot.connect()
    bot = ry.BotOp(C, True, driver=LeRobotDriver(C, robot, {"yaw": "shoulder_pan"}, units="radians"))
    bot.moveTo([0.2])
    bot.wait(C)
    bot.sync(C, 0.1)
    assert robot.position["shoulder_pan"] == pytest.approx(0.2, abs=1e-3)
    bot.close()


def test_the_gripper_opens_and_stops_at_an_object(robot: StandIn) -> None:
    C = arm()
    driver = LeRobotDriver(C, robot, gripper="gripper", opening=(0.0, 0.1))
    bot = ry.BotOp(C, True, driver=driver)
    bot.gripperMove(0, 0.08)
    assert not bot.gripperDone(0)
    bot.wait(C, forTimeToEnd=False, forGripper=True)
    assert robot.position["gripper"] == pytest.approx(80, abs=2) and bot.getGripperPos(0) == pytest.approx(
        0.08, abs=2e-3
    )
    steps = np.diff([action["gripper.pos"] for action in robot.actions])
    assert steps.max() < 25  # moves at its speed
    robot.blocked = 40.0
    bot.gripperClose(0)
    bot.wait(C, forTimeToEnd=False, forGripper=True)
    assert bot.getGripperPos(0) == pytest.approx(0.04, abs=1e-3)
    assert robot.goal["gripper"] < 40  # it presses
    bot.close()


def fault(robot: StandIn, bot: ry.BotOp, C: ry.Config) -> str:
    with pytest.raises(ry.RobotFault) as raised:
        bot.wait(C)
    bot.close()
    return str(raised.value)


def moving(robot: StandIn) -> tuple[ry.Config, ry.BotOp]:
    C = arm()
    bot = ry.BotOp(C, True, driver=LeRobotDriver(C, robot))
    bot.moveTo(np.array([1.0, 0.0, 0.0]))
    bot.sync(C, 0.2)
    return C, bot


def test_a_late_answer_stops_the_robot_where_it_is(robot: StandIn) -> None:
    C, bot = moving(robot)
    robot.delay = 0.3
    assert "the robot answered after 0.3" in fault(robot, bot, C)
    assert abs(robot.goal["shoulder_pan"] - robot.position["shoulder_pan"]) < 1.0
    assert 0 < robot.goal["shoulder_pan"] < np.degrees(1.0)


def test_states_that_are_not_numbers_stop_the_robot_at_its_last_position(robot: StandIn) -> None:
    C, bot = moving(robot)
    robot.position["elbow_flex"] = robot.goal["elbow_flex"] = float("nan")
    assert "finite" in fault(robot, bot, C)
    assert all(np.isfinite(value) for value in robot.actions[-1].values())


def test_a_missing_joint_stops_the_robot_and_is_named(robot: StandIn) -> None:
    C, bot = moving(robot)
    robot.lost = "elbow_flex.pos"
    assert "the observation lacks 'elbow_flex.pos'; it has shoulder_pan.pos, shoulder_lift.pos" in fault(robot, bot, C)


def test_a_lost_connection_stops_the_robot(robot: StandIn) -> None:
    C, bot = moving(robot)
    robot.is_connected = False
    with pytest.raises(ry.RobotFault, match=r"read\(\) raised AssertionError"):
        bot.wait(C)
    bot.recover()
    bot.sync(C, 0.1)
    assert bot.getFault() == ""
    bot.close()


def test_motions_beyond_the_limits_are_refused(robot: StandIn) -> None:
    C = arm()
    bot = ry.BotOp(C, True, driver=LeRobotDriver(C, robot, acceleration=5.0))
    with pytest.raises(ry.ArgumentError, match="limit is 3"):
        bot.move([[1.5, 0.0, 0.0]], [0.4])
    with pytest.raises(ry.ArgumentError, match="limit is 5"):
        bot.move([[0.5, 0.0, 0.0]], [0.7])
    bot.close()


def test_wrong_arguments_are_refused(robot: StandIn) -> None:
    C = arm()
    with pytest.raises(ry.ArgumentError, match="from -100 to 100; make it with use_degrees=True"):
        LeRobotDriver(C, StandIn(use_degrees=False))
    with pytest.raises(ry.NotFound, match="no motor 'elbow'; it has shoulder_pan, shoulder_lift, elbow_flex, gripper"):
        LeRobotDriver(C, robot, {"elbow_flex": "elbow"})
    with pytest.raises(ry.NotFound, match="signs has 'wrist', which is no joint of the scene: shoulder_pan"):
        LeRobotDriver(C, robot, signs={"wrist": -1})
    with pytest.raises(ry.ArgumentError, match="units is 'grad'"):
        LeRobotDriver(C, robot, units="grad")
    with pytest.raises(ry.ArgumentError, match="signs of 1 or -1"):
        LeRobotDriver(C, robot, signs={"elbow_flex": 2})
    with pytest.raises(ry.ArgumentError, match="acceleration is 0"):
        LeRobotDriver(C, robot, acceleration=0)
    with pytest.raises(ry.ArgumentError, match="opening is"):
        LeRobotDriver(C, robot, gripper="gripper", opening=(0.1, 0.0))
