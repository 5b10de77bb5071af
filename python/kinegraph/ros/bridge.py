"""A robot of Kinegraph looks like one of ros2_control."""

from __future__ import annotations

import array
import math
import re
import threading
import time
from collections.abc import Sequence
from typing import Any

from .._core import BotOp, Config, Trajectory
from ..errors import ArgumentError, RobotFault
from ..recording.links import JointStates, Links
from .grippers import Finger, GripperController
from .node import RunningNode, needed
from .robot import Robot, State
from .sights import Camera, Markers
from .trajectories import TrajectoryController

MARKER_PERIOD = 0.05  # s between two messages of contacts


class RosBridge:
    """Publishes a robot, and executes trajectories of ROS 2 with it.

    It publishes /joint_states, /robot_description, /tf, /tf_static, images and markers. Images, points and contacts are
    published while someone listens. The bridge has the topic CONTROLLER/joint_trajectory and the action
    CONTROLLER/follow_joint_trajectory of a joint_trajectory_controller, and the actions of gripper controllers. A
    trajectory goes exactly through its points, within the limits of the robot, or is refused with the reason. The
    present motion flows into the motion of a new goal if the limits allow, else the robot stops in between.

    The robot runs in real time, as BotOp(C, realtime=True) or a real one does, or, with clock=True, in virtual time.
    """

    def __init__(
        self,
        bot: BotOp,
        *,
        rate: float = 100.0,
        controller: str = "joint_trajectory_controller",
        tf: bool = True,
        cameras: Sequence[str] = (),
        camera_rate: float = 10.0,
        clock: bool = False,
        name: str = "kinegraph",
    ):
        """Starts the node in threads of its own.

        Args:
            bot: The robot.
            rate: Messages of /joint_states and /tf per second, Hz; up to about 500.
            controller: Name of the controller.
            tf: True publishes /tf, /tf_static.
            cameras: Frames of cameras of a simulated robot: NAME/image_raw, image_raw/compressed, camera_info,
                depth/image_rect_raw, points.
            camera_rate: Images per second, Hz.
            clock: The robot has virtual time, which advances while calls wait (bot.sync, bot.wait): publishes it as
                /clock, for nodes with use_sim_time. All stamps are of this time, and goals advance with it.
            name: Name of the node.
        Raises:
            NotFound: A package of ROS 2 is missing.
            ArgumentError: A rate is invalid, the robot has virtual time without `clock`, or a real robot has cameras.
            FrameNotFound: There is no such camera.
        """
        for what, value in (("rate", rate), ("camera_rate", camera_rate)):
            if not 0 < value <= 1000:
                raise ArgumentError(f"RosBridge: {what} is {value}; expected a number above 0 and at most 1000, in Hz")
        if isinstance(cameras, str):
            raise ArgumentError(f"RosBridge: cameras is '{cameras}'; expected a list of names, ['{cameras}']")
        if cameras and not bot.isSimulated():
            raise ArgumentError("RosBridge: cameras are those of a simulation; this robot is real")
        for camera in cameras:
            bot.getCameraFxycxy(camera)  # refuses a wrong name
        sensor, std, qos = needed("sensor_msgs.msg"), needed("std_msgs.msg"), needed("rclpy.qos")
        robot = self._robot = Robot(bot, rate, clock)
        self._running = RunningNode(name, 4)
        node = self._node = self._running.node
        group = needed("rclpy.callback_groups").ReentrantCallbackGroup()
        latched = qos.QoSProfile(depth=1, durability=qos.DurabilityPolicy.TRANSIENT_LOCAL)
        self._time = needed("builtin_interfaces.msg").Time
        self._states = node.create_publisher(sensor.JointState, "/joint_states", 10)
        self._state = sensor.JointState()
        self._joint_states = JointStates(robot.joints)
        world = bot.getWorld()
        self._links = Links(world)
        self._description = node.create_publisher(std.String, "/robot_description", latched)
        self._description.publish(std.String(data=self._links.urdf))
        self._clock: Any = None
        if clock:
            self._clock_type = needed("rosgraph_msgs.msg").Clock
            self._clock = node.create_publisher(self._clock_type, "/clock", 10)
        self._tf: Any = None
        if tf:
            tf2, geometry = needed("tf2_msgs.msg"), needed("geometry_msgs.msg")
            self._transforms, self._geometry = tf2.TFMessage, geometry
            self._tf = node.create_publisher(tf2.TFMessage, "/tf", 100)
            self._static = node.create_publisher(tf2.TFMessage, "/tf_static", latched)
        self._controllers: list[Any] = [TrajectoryController(node, robot, controller, group)]
        for index, info in enumerate(robot.grippers):
            finger = Finger(world, self._links, info.name, (info.min_width, info.max_width), bot.getGripperPos(index))
            prefix = "" if len(robot.grippers) == 1 else re.sub(r"\W", "_", info.name) + "_"
            names = (f"{prefix}gripper_controller", f"{prefix}parallel_gripper_controller")
            self._controllers.append(GripperController(node, robot, index, finger, names, group))
        self._markers: Any = None
        if _exists("visualization_msgs.msg"):
            self._markers = Markers(node, latched, self._now)
        self._cameras = [Camera(node, camera) for camera in cameras]
        self._camera_period, self._next_image, self._next_markers = 1.0 / camera_rate, -math.inf, -math.inf
        self._ended = threading.Event()
        self._camera_thread = threading.Thread(target=self._render, daemon=True)
        self._running.start()
        robot.start(self._publish)
        if self._cameras and not clock:
            self._camera_thread.start()

    def close(self) -> None:
        """Ends the node. The robot finishes its present motion."""
        self._ended.set()
        for controller in self._controllers:
            controller.close()
        self._robot.close()
        if self._camera_thread.is_alive():
            self._camera_thread.join(timeout=2.0)
        self._running.close()

    def __enter__(self) -> RosBridge:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def showPlan(self, motion: Trajectory, frames: str | Sequence[str], rate: float = 50.0) -> None:
        """Publishes the ways of frames along a motion as lines, on /kinegraph/plan. RViz shows them until the next one.

        In virtual time, call it in the thread of the robot.

        Args:
            motion: A plan, or another Trajectory.
            frames: Name of a frame, such as the gripper, or several.
            rate: Points per second of the motion.
        Raises:
            FrameNotFound: There is no such frame.
            NotFound: The package visualization_msgs is missing.
        """
        needed("visualization_msgs.msg")
        names = [frames] if isinstance(frames, str) else list(frames)
        self._markers.plan(motion, self._robot.bot.getWorld(), names, rate)

    def _now(self) -> Any:
        """Returns the stamp of messages."""
        if self._clock is None:
            return self._node.get_clock().now().to_msg()
        return self._stamp(self._last.time)

    def _stamp(self, seconds: float) -> Any:
        nanoseconds = round(seconds * 1e9)
        return self._time(sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)

    def _publish(self, state: State, world: Config) -> None:
        self._last = state
        now = self._now()
        if self._clock is not None:
            self._clock.publish(self._clock_type(clock=now))
        names, q, velocity = self._joint_states.read(state.time, world, self._links, state.q, state.velocity)
        message = self._state
        message.header.stamp, message.name = now, names
        message.position, message.velocity = array.array("d", q.tobytes()), array.array("d", velocity.tobytes())
        self._states.publish(message)
        if self._tf is not None:
            moving, resting = self._links.read(world)
            if resting:
                self._static.publish(self._message(now, resting))
            self._tf.publish(self._message(now, moving))
        if self._markers is not None and state.time >= self._next_markers:
            self._next_markers = state.time + MARKER_PERIOD
            self._markers.contacts(self._robot.bot.getContacts)
        if self._clock is not None and self._cameras and state.time >= self._next_image - 1e-9:
            self._next_image = max(self._next_image, state.time - self._camera_period) + self._camera_period
            for camera in self._cameras:
                camera.publish(world, now)

    def _render(self) -> None:
        """Publishes images in real time, in a thread of its own."""
        due = time.monotonic()
        while not self._ended.is_set():
            try:
                world, now = self._robot.bot.getWorld(), self._now()
            except RobotFault:
                return  # the robot is closed
            for camera in self._cameras:
                camera.publish(world, now)
            due = max(due + self._camera_period, time.monotonic())
            self._ended.wait(due - time.monotonic())

    def _message(self, now: Any, transforms: Any) -> Any:
        message = self._transforms()
        for parent, child, pose in transforms:
            x, y, z, qw, qx, qy, qz = pose.tolist()
            transform = self._geometry.TransformStamped(child_frame_id=child)
            transform.header.stamp, transform.header.frame_id = now, parent
            position, rotation = transform.transform.translation, transform.transform.rotation
            position.x, position.y, position.z = x, y, z
            rotation.w, rotation.x, rotation.y, rotation.z = qw, qx, qy, qz
            message.transforms.append(transform)
        return message


def _exists(module: str) -> bool:
    try:
        needed(module)
    except Exception:
        return False
    return True
