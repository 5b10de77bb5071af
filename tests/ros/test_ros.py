"""RosBridge and RosDriver against nodes of rclpy. `make test-ros` runs these tests."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import numpy as np
import pytest

rclpy = pytest.importorskip("rclpy", reason="needs ROS 2; make test-ros installs its wheels")

from action_msgs.msg import GoalStatus  # noqa: E402
from control_msgs.msg import JointTolerance  # noqa: E402
from ros_client import Client, move, scene, trajectory  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402
from std_msgs.msg import Float64MultiArray  # noqa: E402
from trajectory_msgs.msg import JointTrajectory  # noqa: E402

import kinegraph as ry  # noqa: E402
from kinegraph.ros import RosBridge, RosDriver, jointTrajectory, throughPoints  # noqa: E402
from kinegraph.ros.node import RunningNode  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of packages of ROS


@pytest.fixture(autouse=True)
def only_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


@pytest.fixture
def robot() -> Iterator[tuple[ry.Config, ry.BotOp, Client]]:
    C = scene()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C), realtime=True)
    with RosBridge(bot) as _:
        client = Client()
        yield C, bot, client
        client.close()
    bot.close()


def test_others_see_the_robot(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    fingers = ["l_panda_finger_joint1", "l_panda_finger_joint2"]
    assert list(client.states[-1].name) == [*C.getJointNames(), *fingers]
    np.testing.assert_allclose(client.states[-1].position, [*bot.get_q(), 0.04, 0.04])
    assert "<robot" in client.wait(lambda: client.descriptions)[0]
    client.wait(lambda: {"l_gripper", "l_panda_joint7_link", "table"} <= set(client.transforms))
    np.testing.assert_allclose(client.pose("l_gripper"), C.getFrame("l_gripper").getTransform(), atol=1e-9)


def test_a_goal_is_reached_with_feedback(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    goal = bot.get_q() + 0.3 * np.eye(7)[0]
    assert client.result(client.send(move(bot, C, 0.3, 1.5))) == (GoalStatus.STATUS_SUCCEEDED, 0, "")
    np.testing.assert_allclose(bot.get_q(), goal, atol=1e-9)
    assert len(client.feedbacks) > 5
    seen = [message.feedback.actual.positions[0] for message in client.feedbacks]
    assert np.all(np.diff(seen) >= -1e-9) and seen[-1] - seen[0] > 0.2


def test_goals_that_are_too_fast_or_of_another_robot_are_refused(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    q = bot.get_q()
    status, code, text = client.result(client.send(move(bot, C, 1.0, 0.2)))
    assert (status, code) == (GoalStatus.STATUS_ABORTED, -1)
    assert "l_panda_joint1" in text and "velocity" in text and "limit" in text
    status, code, text = client.result(client.send(trajectory(["a", "b"], [1.0], [[0.0, 0.0]])))
    assert (status, code) == (GoalStatus.STATUS_ABORTED, -2)
    assert "the trajectory has the joints a, b; expected l_panda_joint1" in text
    wrong = trajectory(C.getJointNames(), [1.0, 0.5], [q, q])
    assert client.result(client.send(wrong))[2] == "times do not increase from 0"
    short = trajectory(C.getJointNames(), [1.0], [q[:3]])
    assert "the points have [3] positions; expected 7 each" in client.result(client.send(short))[2]
    nan = trajectory(C.getJointNames(), [1.0], [q * np.nan])
    assert client.result(client.send(nan))[2] == "a number is not finite"
    fast = trajectory(C.getJointNames(), [1.0], [q], [0.1 * np.eye(7)[3]])
    assert "the velocity of joint 'l_panda_joint4' at the last point is 0.1" in client.result(client.send(fast))[2]
    old = trajectory(C.getJointNames(), [1.0], [q])
    old.header.stamp.sec = 1000
    assert client.result(client.send(old))[1] == -3
    np.testing.assert_array_equal(bot.get_q(), q)


def test_a_goal_is_canceled_and_replaced(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    start = bot.get_q()[0]
    handle = client.send(move(bot, C, 0.5, 4.0))
    client.wait(lambda: bot.get_q()[0] > start + 0.01)
    future = handle.cancel_goal_async()
    client.wait(future.done)
    assert client.result(handle)[0] == GoalStatus.STATUS_CANCELED
    time.sleep(0.3)
    rest = bot.get_q()
    time.sleep(0.2)
    np.testing.assert_allclose(bot.get_q(), rest, atol=1e-9)
    assert rest[0] < start + 0.45
    first = client.send(move(bot, C, -0.2, 4.0))
    client.wait(lambda: client.feedbacks and bot.get_q()[0] < rest[0] - 0.005)
    second = client.send(move(bot, C, 0.2, 2.0))
    assert client.result(first) == (GoalStatus.STATUS_ABORTED, -1, "a new goal has replaced this one")
    assert client.result(second)[0] == GoalStatus.STATUS_SUCCEEDED


def test_a_goal_flows_into_the_next_one(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    start = bot.get_q()
    first = client.send(trajectory(C.getJointNames(), [4.0], [start + 0.8 * np.eye(7)[0]]))
    client.wait(lambda: bot.get_q()[0] > start[0] + 0.1)
    began = len(client.states)
    goal = start + 0.6 * np.eye(7)[0] + 0.2 * np.eye(7)[3]
    second = client.send(trajectory(C.getJointNames(), [3.0], [goal]))
    client.wait(lambda: bot.get_q()[0] > start[0] + 0.4)
    speeds = [state.velocity[0] for state in client.states[began:]]
    assert min(speeds) > 0.05, "the robot has stopped in between"
    assert client.result(first)[1:] == (-1, "a new goal has replaced this one")
    assert client.result(second) == (GoalStatus.STATUS_SUCCEEDED, 0, "")
    np.testing.assert_allclose(bot.get_q(), goal, atol=1e-9)
    third = client.send(trajectory(C.getJointNames(), [4.0], [start]))
    client.wait(lambda: bot.get_q()[0] < start[0] + 0.5)
    wrong = client.send(trajectory(C.getJointNames(), [1.0], [goal * np.nan]))
    assert client.result(wrong)[2] == "a number is not finite"
    assert client.result(third)[0] == GoalStatus.STATUS_SUCCEEDED  # an invalid goal leaves the present one alone


def test_a_turn_beyond_the_limits_stops_first(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    start = bot.get_q()
    client.send(trajectory(C.getJointNames(), [1.5], [start + np.eye(7)[0]]))
    client.wait(lambda: bot.get_qDot()[0] > 0.9)
    q = bot.get_q() + 0.3 * np.eye(7)[0]
    back = trajectory(C.getJointNames(), [0.02, 1.5], [q, q], np.zeros((2, 7)))
    status, code, text = client.result(client.send(back))
    assert (status, code) == (GoalStatus.STATUS_ABORTED, -1) and "l_panda_joint1" in text and "limit" in text
    assert np.abs(bot.get_qDot()).max() < 1e-9


def test_a_stamp_delays_the_start(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    start = bot.get_q()
    later = move(bot, C, 0.2, 1.0)
    stamp = client.node.get_clock().now().nanoseconds + 10**9
    later.header.stamp.sec, later.header.stamp.nanosec = stamp // 10**9, stamp % 10**9
    handle = client.send(later)
    assert client.result(handle)[0] == GoalStatus.STATUS_SUCCEEDED
    first = next(state for state in client.states if abs(state.position[0] - start[0]) > 1e-6)
    began = first.header.stamp.sec * 10**9 + first.header.stamp.nanosec
    assert 0.0 < 1e-9 * (began - stamp) < 0.15


def test_plans_become_messages(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    plan = ry.planMotion(C, bot.get_q() + np.array([0.3, 0, 0.2, 0, 0, 0, 0.5]))
    assert client.result(client.send(jointTrajectory(plan, C.getJointNames()))) == (GoalStatus.STATUS_SUCCEEDED, 0, "")
    np.testing.assert_allclose(bot.get_q(), plan.path[-1], atol=1e-9)
    with pytest.raises(ry.ArgumentError, match="there are 2 names of joints; expected 7"):
        jointTrajectory(plan, ["a", "b"])


def test_the_topic_moves_and_an_empty_trajectory_holds(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    start = bot.get_q()[0]
    client.topic.publish(move(bot, C, 0.5, 4.0))
    client.wait(lambda: bot.get_q()[0] > start + 0.01)
    client.topic.publish(JointTrajectory())
    client.wait(lambda: bot.getTimeToEnd() <= 0)
    assert bot.get_q()[0] < start + 0.45


class Lagging(ry.RobotDriver):
    """A robot that is 50 ms late."""

    def __init__(self, C: ry.Config) -> None:
        super().__init__()
        self._info, self.q, self.goal = ry.RobotInfo.of(C, "late"), C.getJointState(), C.getJointState()

    def info(self) -> ry.RobotInfo:
        return self._info

    def read(self) -> ry.RobotState:
        velocity = (self.goal - self.q) / 0.05
        self.q = self.q + 0.01 * velocity
        return ry.RobotState(time.monotonic(), self.q, velocity)

    def write(self, command: ry.RobotCommand) -> None:
        self.goal = command.q

    def stop(self, reason: str) -> None:
        self.goal = self.q


def test_a_path_tolerance_stops_the_robot() -> None:
    C = scene()
    bot = ry.BotOp(C, True, driver=Lagging(C))
    with RosBridge(bot):
        client = Client()
        tolerance = [JointTolerance(name="l_panda_joint1", position=5e-3)]
        status, code, text = client.result(client.send(move(bot, C, 0.5, 1.5), path_tolerance=tolerance))
        assert (status, code) == (GoalStatus.STATUS_ABORTED, -4)
        assert "joint 'l_panda_joint1' is" in text and "from its path; the robot holds" in text
        client.close()
    bot.close()


class Controller:
    """A forward_position_controller and joint_state_broadcaster, with joints in reverse order and another's joint."""

    def __init__(self, names: list[str], q: np.ndarray) -> None:
        self._running = RunningNode("controller_manager", 2)
        node = self._node = self._running.node
        self.q, self._names = np.array(q), names
        self.commands = 0
        self.silent, self.broken = threading.Event(), threading.Event()
        node.create_subscription(Float64MultiArray, "/forward_position_controller/commands", self._onCommand, 1)
        self._states = node.create_publisher(JointState, "/joint_states", 10)
        node.create_timer(0.004, self._publish)
        self._running.start()

    def _onCommand(self, message: Float64MultiArray) -> None:
        self.q, self.commands = np.array(message.data), self.commands + 1

    def _publish(self) -> None:
        if not self.silent.is_set():
            q = self.q * np.nan if self.broken.is_set() else self.q
            message = JointState(name=["other", *self._names[::-1]], position=[0.0, *q[::-1].tolist()])
            message.header.stamp = self._node.get_clock().now().to_msg()
            self._states.publish(message)

    def close(self) -> None:
        self._running.close()


def test_a_robot_of_ros2_control_is_driven_and_stops_if_its_states_end() -> None:
    C = scene()
    names = [name.removeprefix("l_") for name in C.getJointNames()]
    controller = Controller(names, C.getJointState())
    bot = ry.BotOp(C, True, driver=RosDriver(C, names=dict(zip(C.getJointNames(), names, strict=True)), timeout=20.0))
    goal = bot.get_q() + 0.2 * np.eye(7)[2]
    bot.moveTo(goal)
    bot.wait(C)
    bot.sync(C, 0.3)
    np.testing.assert_allclose(controller.q, goal, atol=1e-6)
    assert controller.commands > 20
    controller.silent.set()
    with pytest.raises(ry.RobotFault, match="clock has stood still"):
        bot.sync(C, 1.0)
    bot.close()
    controller.close()


def test_states_that_are_not_numbers_hold_a_robot_of_ros2_control() -> None:
    C = scene()
    controller = Controller(C.getJointNames(), C.getJointState())
    bot = ry.BotOp(C, True, driver=RosDriver(C, timeout=20.0))
    bot.moveTo(bot.get_q() + 0.5)
    bot.sync(C, 0.5)
    controller.broken.set()
    with pytest.raises(ry.RobotFault, match="not finite|nan"):
        bot.sync(C, 5.0)
    time.sleep(0.2)
    held = controller.q.copy()
    assert np.isfinite(held).all()
    time.sleep(0.3)
    np.testing.assert_array_equal(controller.q, held)
    bot.close()
    controller.close()


def test_the_states_of_another_robot_are_named() -> None:
    C = scene()
    controller = Controller(["joint_a", "joint_b"], np.zeros(2))
    with pytest.raises(ry.RobotFault, match="states there have the joints other, joint_b, joint_a"):
        ry.BotOp(C, True, driver=RosDriver(C, timeout=8.0))
    controller.close()


def test_a_driver_without_states_says_so() -> None:
    C = scene()
    with pytest.raises(
        ry.RobotFault, match="no state on /joint_states has the joints l_panda_joint1.*nothing was received"
    ):
        ry.BotOp(C, True, driver=RosDriver(C, timeout=0.5))


def test_trajectories_go_through_their_points() -> None:
    rng = np.random.default_rng(0)
    t = np.append(0.0, np.cumsum(rng.uniform(0.1, 0.6, 6)))
    q, v, a = rng.normal(size=(3, 7, 3))
    for given in ((q,), (q, v), (q, v, a)):
        motion = throughPoints(t, *given)
        for found, expected in zip(motion.eval(t), given, strict=False):
            np.testing.assert_allclose(found, expected, atol=1e-12)
    middle = throughPoints(t, q, v).eval(0.5 * (t[0] + t[1]))[0]  # Hermite's formula at half time
    np.testing.assert_allclose(middle, 0.5 * (q[0] + q[1]) + (t[1] - t[0]) / 8 * (v[0] - v[1]), atol=1e-12)
