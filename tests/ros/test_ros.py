"""RosBridge and RosDriver against nodes of rclpy. `make test-ros` runs these tests."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

rclpy = pytest.importorskip("rclpy", reason="needs ROS 2; make test-ros installs its wheels")

from action_msgs.msg import GoalStatus  # noqa: E402
from builtin_interfaces.msg import Duration  # noqa: E402
from control_msgs.action import FollowJointTrajectory  # noqa: E402
from control_msgs.msg import JointTolerance  # noqa: E402
from rclpy.action import ActionClient  # noqa: E402
from rclpy.qos import DurabilityPolicy, QoSProfile  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402
from std_msgs.msg import Float64MultiArray, String  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint  # noqa: E402

import kinegraph as ry  # noqa: E402
from kinegraph.ros import RosBridge, RosDriver, throughPoints  # noqa: E402
from kinegraph.ros.node import RunningNode  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of packages of ROS
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture(autouse=True)
def only_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


class Client:
    """A node of its own that sees the robot, as RViz or MoveIt do."""

    def __init__(self) -> None:
        self._running = RunningNode("client", 2)
        node = self.node = self._running.node
        self.states: list[JointState] = []
        self.descriptions: list[str] = []
        self.transforms: dict[str, tuple[str, Any]] = {}
        node.create_subscription(JointState, "/joint_states", self.states.append, 100)
        node.create_subscription(String, "/robot_description", lambda m: self.descriptions.append(m.data), LATCHED)
        node.create_subscription(TFMessage, "/tf_static", self._onTransforms, LATCHED)
        node.create_subscription(TFMessage, "/tf", self._onTransforms, 100)
        self.topic = node.create_publisher(JointTrajectory, "/joint_trajectory_controller/joint_trajectory", 1)
        self.action = ActionClient(node, FollowJointTrajectory, "/joint_trajectory_controller/follow_joint_trajectory")
        self.feedbacks: list[Any] = []
        self._running.start()
        assert self.action.wait_for_server(20.0)
        self.wait(lambda: self.states)

    def _onTransforms(self, message: TFMessage) -> None:
        for transform in message.transforms:
            self.transforms[transform.child_frame_id] = transform.header.frame_id, transform.transform

    def wait(self, condition: Any, seconds: float = 20.0) -> Any:
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, "nothing happened"
            time.sleep(0.01)
        return condition()

    def send(self, trajectory: JointTrajectory, **fields: Any) -> Any:
        goal = FollowJointTrajectory.Goal(trajectory=trajectory, **fields)
        future = self.action.send_goal_async(goal, feedback_callback=self.feedbacks.append)
        self.wait(future.done)
        assert future.result().accepted
        return future.result()

    def result(self, handle: Any) -> tuple[int, int, str]:
        future = handle.get_result_async()
        self.wait(future.done, 40.0)
        result = future.result()
        return result.status, result.result.error_code, result.result.error_string

    def close(self) -> None:
        self._running.close()


@pytest.fixture
def robot() -> Iterator[tuple[ry.Config, ry.BotOp, Client]]:
    C = scene()
    bot = ry.BotOp(C, driver=ry.KinematicDriver(C), realtime=True)
    with RosBridge(bot) as _:
        client = Client()
        yield C, bot, client
        client.close()
    bot.close()


def trajectory(names: list[str], times: Any, q: Any, velocity: Any = None) -> JointTrajectory:
    points = []
    for row, t in enumerate(times):
        point = JointTrajectoryPoint(positions=[float(x) for x in q[row]])
        point.time_from_start = Duration(sec=int(t), nanosec=round(t % 1 * 1e9))
        if velocity is not None:
            point.velocities = [float(x) for x in velocity[row]]
        points.append(point)
    return JointTrajectory(joint_names=names, points=points)


def move(bot: ry.BotOp, C: ry.Config, by: float, seconds: float) -> JointTrajectory:
    """Smooth points with velocities, joints in reverse order."""
    q, u = bot.get_q(), np.linspace(0, 1, 21)[1:]
    share = 10 * u**3 - 15 * u**4 + 6 * u**5
    rate = (30 * u**2 - 60 * u**3 + 30 * u**4) / seconds
    names = C.getJointNames()[::-1]
    rows = q + by * share[:, None] * np.eye(7)[0]
    return trajectory(names, u * seconds, rows[:, ::-1], (by * rate[:, None] * np.eye(7)[0])[:, ::-1])


def test_others_see_the_robot(robot: tuple[ry.Config, ry.BotOp, Client]) -> None:
    C, bot, client = robot
    assert list(client.states[-1].name) == C.getJointNames()
    np.testing.assert_allclose(client.states[-1].position, bot.get_q())
    assert "<robot" in client.wait(lambda: client.descriptions)[0]
    client.wait(lambda: {"l_gripper", "l_panda_joint7_link", "table"} <= set(client.transforms))
    pose, at = np.eye(4), "l_gripper"
    while at != "world":
        at, transform = client.transforms[at]
        t, r = transform.translation, transform.rotation
        step = np.eye(4)
        step[:3, :3], step[:3, 3] = ry.Quaternion([r.w, r.x, r.y, r.z]).getMatrix(), [t.x, t.y, t.z]
        pose = step @ pose
    np.testing.assert_allclose(pose, C.getFrame("l_gripper").getTransform(), atol=1e-9)


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
        self.silent = threading.Event()
        node.create_subscription(Float64MultiArray, "/forward_position_controller/commands", self._onCommand, 1)
        self._states = node.create_publisher(JointState, "/joint_states", 10)
        node.create_timer(0.004, self._publish)
        self._running.start()

    def _onCommand(self, message: Float64MultiArray) -> None:
        self.q, self.commands = np.array(message.data), self.commands + 1

    def _publish(self) -> None:
        if not self.silent.is_set():
            message = JointState(name=["other", *self._names[::-1]], position=[0.0, *self.q[::-1].tolist()])
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
