"""A node of rclpy that sees and moves the robot, as RViz or MoveIt do."""

from __future__ import annotations

import threading
import time
from typing import Any

import numpy as np
import pytest

pytest.importorskip("rclpy", reason="needs ROS 2; make test-ros installs its wheels")

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

import kinegraph as ry
from kinegraph.ros.node import RunningNode

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


class Client:
    """A node of its own that sees the robot, as RViz or MoveIt do."""

    def __init__(self, started: threading.Event | None = None) -> None:
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
        if started is not None:
            started.set()
        self.wait(lambda: self.states)

    def _onTransforms(self, message: TFMessage) -> None:
        for transform in message.transforms:
            self.transforms[transform.child_frame_id] = transform.header.frame_id, transform.transform

    def pose(self, frame: str) -> np.ndarray:
        """Returns the transform of a frame in the world, from /tf and /tf_static, (4, 4)."""
        pose, at = np.eye(4), frame
        while at != "world":
            at, transform = self.transforms[at]
            t, r = transform.translation, transform.rotation
            step = np.eye(4)
            step[:3, :3], step[:3, 3] = ry.Quaternion([r.w, r.x, r.y, r.z]).getMatrix(), [t.x, t.y, t.z]
            pose = step @ pose
        return pose

    def wait(self, condition: Any, seconds: float = 20.0) -> Any:
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, "nothing happened"
            time.sleep(0.01)
        return condition()

    def send(self, trajectory: JointTrajectory, **fields: Any) -> Any:
        goal = FollowJointTrajectory.Goal(trajectory=trajectory, **fields)
        return self.goal(self.action, goal, self.feedbacks.append)

    def goal(self, action: ActionClient, goal: Any, feedback: Any = None) -> Any:
        """Sends a goal of any action and returns its handle."""
        assert action.wait_for_server(20.0)
        future = action.send_goal_async(goal, feedback_callback=feedback)
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
