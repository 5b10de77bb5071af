"""Gripper actions of RosBridge, and grippers of RosDriver, against nodes of rclpy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2; make test-ros installs its wheels")

from action_msgs.msg import GoalStatus
from control_msgs.action import GripperCommand, ParallelGripperCommand
from rclpy.action import ActionClient
from ros_client import Client, scene
from sensor_msgs.msg import JointState

import kinegraph as ry
from kinegraph.ros import RosBridge, RosDriver, RosGripper

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of packages of ROS
FINGER = "l_panda_finger_joint1"


@pytest.fixture(autouse=True)
def only_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


class Hand:
    """Sends goals to both actions of a hand."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self.feedbacks: list[Any] = []
        self._single = ActionClient(client.node, GripperCommand, "/gripper_controller/gripper_cmd")
        self._parallel = ActionClient(client.node, ParallelGripperCommand, "/parallel_gripper_controller/gripper_cmd")

    def send(self, position: float, effort: float = 0.0) -> Any:
        goal = GripperCommand.Goal()
        goal.command.position, goal.command.max_effort = position, effort
        return self._client.goal(self._single, goal, self.feedbacks.append)

    def sendParallel(self, *, names: list[str], positions: list[float], **fields: list[float]) -> Any:
        goal = ParallelGripperCommand.Goal(command=JointState(name=names, position=positions, **fields))
        return self._client.goal(self._parallel, goal)

    def result(self, handle: Any) -> tuple[int, Any]:
        future = handle.get_result_async()
        self._client.wait(future.done)
        return future.result().status, future.result().result


@pytest.fixture
def empty() -> Iterator[tuple[ry.BotOp, Client, Hand]]:
    C = scene()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C), realtime=True)
    with RosBridge(bot):
        client = Client()
        yield bot, client, Hand(client)
        client.close()
    bot.close()


def test_a_hand_moves_to_positions_of_its_joint(empty: tuple[ry.BotOp, Client, Hand]) -> None:
    bot, client, hand = empty
    status, result = hand.result(hand.send(0.015))
    assert (status, result.reached_goal, result.stalled) == (GoalStatus.STATUS_SUCCEEDED, True, False)
    assert result.position == pytest.approx(0.015, abs=1e-3)  # of one finger
    assert bot.getGripperPos(0) == pytest.approx(0.03, abs=2e-3)  # between both
    client.wait(lambda: abs(client.states[-1].position[7] - 0.015) < 1e-3)
    assert client.states[-1].name[7] == FINGER and hand.feedbacks
    slow = {"velocity": [0.01]}
    status, result = hand.result(hand.sendParallel(names=[FINGER], positions=[0.025], **slow))
    assert (status, result.reached_goal) == (GoalStatus.STATUS_SUCCEEDED, True)
    assert list(result.state.name) == [FINGER]
    assert result.state.position[0] == pytest.approx(0.025, abs=1e-3)


def test_goals_beyond_the_ends_are_clipped_and_wrong_ones_refused(empty: tuple[ry.BotOp, Client, Hand]) -> None:
    bot, _, hand = empty
    assert hand.result(hand.send(0.3))[1].position == pytest.approx(0.04, abs=1e-3)
    for wrong in (
        hand.send(float("nan")),
        hand.sendParallel(names=["another"], positions=[0.0]),
        hand.sendParallel(names=[], positions=[]),
    ):
        status, result = hand.result(wrong)
        assert status == GoalStatus.STATUS_ABORTED and not result.reached_goal
    assert bot.getGripperPos(0) == pytest.approx(0.08, abs=2e-3)


def test_a_new_goal_replaces_and_cancel_holds(empty: tuple[ry.BotOp, Client, Hand]) -> None:
    bot, client, hand = empty
    slow = {"velocity": [0.01]}
    first = hand.sendParallel(names=[FINGER], positions=[0.005], **slow)
    client.wait(lambda: bot.getGripperPos(0) < 0.07)
    future = first.cancel_goal_async()
    client.wait(future.done)
    assert hand.result(first)[0] == GoalStatus.STATUS_CANCELED
    held = bot.getGripperPos(0)
    assert 0.02 < held < 0.071
    hand.sendParallel(names=[FINGER], positions=[0.005], **slow)
    third = hand.send(0.04)
    assert hand.result(third)[1].reached_goal


def test_a_hand_closes_on_a_thing() -> None:
    C = scene()
    C.setJointState([0.0, 0.2, 0.0, -2.2, 0.0, 2.4, 0.8])
    top = C.getFrame("table").getPosition()[2] + 0.5 * C.getFrame("table").getSize()[2]
    at = C.getFrame("l_gripper").getPosition()
    height = at[2] - top + 0.02  # a post on the table, 4 cm wide, between the fingers
    post = C.addFrame("post").setShape(ry.ST.box, [0.04, 0.04, height]).setMass(0.3).setContact(1)
    rotation = C.getFrame("l_gripper").getRotationMatrix()
    yaw = np.arctan2(rotation[1, 0], rotation[0, 0])
    post.setPosition([at[0], at[1], top + 0.5 * height]).setQuaternion([np.cos(yaw / 2), 0, 0, np.sin(yaw / 2)])
    bot = ry.BotOp(C, realtime=True)
    with RosBridge(bot):
        client = Client()
        hand = Hand(client)
        status, result = hand.result(hand.send(0.0, effort=20.0))
        assert (status, result.stalled, result.reached_goal) == (GoalStatus.STATUS_SUCCEEDED, True, False)
        assert result.position == pytest.approx(0.02, abs=4e-3)
        client.close()
    bot.close()


def test_a_gripper_of_ros2_control_is_driven(empty: tuple[ry.BotOp, Client, Hand]) -> None:
    bot, _, _ = empty
    C = scene()
    other = ry.BotOp(C, True, driver=RosDriver(C, timeout=20.0, gripper=RosGripper(FINGER)))
    assert other.getGripperPos(0) == pytest.approx(0.08, abs=2e-3)
    other.gripperMove(0, 0.03)
    assert not other.gripperDone(0)
    other.wait(C, forTimeToEnd=False, forGripper=True)
    assert bot.getGripperPos(0) == pytest.approx(0.03, abs=2e-3)
    assert other.getGripperPos(0) == pytest.approx(0.03, abs=2e-3)
    other.gripperClose(0)
    other.wait(C, forTimeToEnd=False, forGripper=True)
    assert bot.getGripperPos(0) == pytest.approx(0.0, abs=2e-3)
    other.close()
    with pytest.raises(ry.RobotFault, match="there is no action /claw/gripper_cmd of type GripperCommand"):
        ry.BotOp(C, True, driver=RosDriver(C, timeout=15.0, gripper=RosGripper(FINGER, controller="claw")))
    with pytest.raises(ry.ArgumentError, match="closed=0.04, open=0.04"):
        RosDriver(C, gripper=RosGripper(FINGER, closed=0.04))
