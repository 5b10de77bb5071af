"""A robot of Kinegraph looks like one of ros2_control."""

from __future__ import annotations

import threading
import time
from typing import Any

import numpy as np

from .._core import BotOp, Trajectory
from ..errors import ArgumentError, Error, RobotFault
from ..recording.links import Links
from .node import RunningNode, needed, seconds
from .points import throughPoints

FEEDBACK = 0.05  # s between feedbacks of a goal
TOLERANCE = 0.01  # rad or m at the goal, if the goal has no tolerance
NEAR = 0.05  # rad or m: a first point without time that is farther from the robot is refused


class _Refused(Exception):
    """A trajectory that is not executed, with the error code of FollowJointTrajectory."""

    def __init__(self, code: int, reason: str):
        super().__init__(reason)
        self.code = code


class RosBridge:
    """Publishes a robot, and executes trajectories of ROS 2 with it.

    It publishes /joint_states, /robot_description, /tf and /tf_static, and has the topic
    CONTROLLER/joint_trajectory and the action CONTROLLER/follow_joint_trajectory of a joint_trajectory_controller.
    A trajectory goes exactly through its points, within the limits of the robot, or is refused with the reason. A
    new goal stops the present one.

    The robot runs in real time: BotOp(C, realtime=True), or a real robot.
    """

    def __init__(
        self,
        bot: BotOp,
        *,
        rate: float = 100.0,
        controller: str = "joint_trajectory_controller",
        tf: bool = True,
        name: str = "kinegraph",
    ):
        """Starts the node in threads of its own.

        Args:
            bot: The robot, in real time.
            rate: Messages of /joint_states and /tf per second, Hz; up to about 500.
            controller: Name of the controller.
            tf: Whether to publish /tf, /tf_static.
            name: Name of the node.
        Raises:
            NotFound: A package of ROS 2 is missing.
            ArgumentError: The rate is invalid.
        """
        if not 0 < rate <= 1000:
            raise ArgumentError(f"RosBridge: rate is {rate}; expected a number above 0 and at most 1000, in Hz")
        sensor, trajectory = needed("sensor_msgs.msg"), needed("trajectory_msgs.msg")
        std, control, action = needed("std_msgs.msg"), needed("control_msgs.action"), needed("rclpy.action")
        self._bot, self._joints = bot, list(bot.getInfo().joints)
        self._action = control.FollowJointTrajectory
        self._point = trajectory.JointTrajectoryPoint
        self._lock = threading.Lock()
        self._goal_number = 0
        self._running = RunningNode(name, 4)
        node = self._node = self._running.node
        groups, qos = needed("rclpy.callback_groups"), needed("rclpy.qos")
        latched = qos.QoSProfile(depth=1, durability=qos.DurabilityPolicy.TRANSIENT_LOCAL)
        self._states = node.create_publisher(sensor.JointState, "/joint_states", 10)
        self._state = sensor.JointState(name=self._joints)
        self._links = Links(bot.getWorld())
        self._description = node.create_publisher(std.String, "/robot_description", latched)
        self._description.publish(std.String(data=self._links.urdf))
        self._tf: Any = None
        if tf:
            tf2, geometry = needed("tf2_msgs.msg"), needed("geometry_msgs.msg")
            self._transforms, self._geometry = tf2.TFMessage, geometry
            self._tf = node.create_publisher(tf2.TFMessage, "/tf", 100)
            self._static = node.create_publisher(tf2.TFMessage, "/tf_static", latched)
        group = groups.ReentrantCallbackGroup()
        topic = f"/{controller.strip('/')}"
        node.create_subscription(
            trajectory.JointTrajectory, f"{topic}/joint_trajectory", self._onTrajectory, 1, callback_group=group
        )
        self._server = action.ActionServer(
            node,
            self._action,
            f"{topic}/follow_joint_trajectory",
            self._execute,
            cancel_callback=lambda handle: action.CancelResponse.ACCEPT,
            callback_group=group,
        )
        node.create_timer(1.0 / rate, self._publish, callback_group=groups.MutuallyExclusiveCallbackGroup())
        self._running.start()

    def close(self) -> None:
        """Ends the node. The robot finishes its present motion."""
        self._goal_number += 1
        self._running.close()

    def __enter__(self) -> RosBridge:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _publish(self) -> None:
        now = self._node.get_clock().now().to_msg()
        try:
            q, velocity, world = self._bot.get_q(), self._bot.get_qDot(), self._bot.getWorld()
        except RobotFault:
            return  # the robot is closed
        self._state.header.stamp = now
        self._state.position, self._state.velocity = q.tolist(), velocity.tolist()
        self._states.publish(self._state)
        if self._tf is not None:
            moving, resting = self._links.read(world)
            if resting:
                self._static.publish(self._message(now, resting))
            self._tf.publish(self._message(now, moving))

    def _message(self, now: Any, transforms: Any) -> Any:
        message = self._transforms()
        for parent, child, (x, y, z, qw, qx, qy, qz) in transforms:
            transform = self._geometry.TransformStamped(child_frame_id=child)
            transform.header.stamp, transform.header.frame_id = now, parent
            position, rotation = transform.transform.translation, transform.transform.rotation
            position.x, position.y, position.z = float(x), float(y), float(z)
            rotation.w, rotation.x, rotation.y, rotation.z = float(qw), float(qx), float(qy), float(qz)
            message.transforms.append(transform)
        return message

    # --- trajectories ---------------------------------------------------------------------------------------------

    def _trajectory(self, message: Any) -> Trajectory:
        """Converts a message; the motion starts at the present reference, at rest."""
        result = self._action.Result
        names = list(message.joint_names)
        if sorted(names) != sorted(self._joints):
            raise _Refused(
                result.INVALID_JOINTS,
                f"the trajectory has the joints {', '.join(names)}; expected {', '.join(self._joints)}",
            )
        order = [names.index(joint) for joint in self._joints]
        times = np.array([seconds(point.time_from_start) for point in message.points])
        columns: dict[str, np.ndarray | None] = {}
        for what in ("positions", "velocities", "accelerations"):
            sizes = {len(getattr(point, what)) for point in message.points}
            if sizes == {len(names)}:
                columns[what] = np.array([getattr(point, what) for point in message.points])[:, order]
            elif sizes == {0} and what != "positions":
                columns[what] = None
            else:
                raise _Refused(
                    result.INVALID_GOAL, f"the points have {sorted(sizes)} {what}; expected {len(names)} each"
                )
        q, velocity, acceleration = columns["positions"], columns["velocities"], columns["accelerations"]
        assert q is not None
        start = self._bot.stepObservation().qref
        if times[0] > 0:
            times = np.append(0.0, times)
            q = np.vstack([start, q])
            velocity, acceleration = (
                None if x is None else np.vstack([np.zeros(len(names)), x]) for x in (velocity, acceleration)
            )
        elif np.abs(q[0] - start).max() <= NEAR:
            q[0] = start
        try:
            return throughPoints(times, q, velocity, acceleration if velocity is not None else None)
        except ArgumentError as error:
            raise _Refused(result.INVALID_GOAL, str(error).removeprefix("throughPoints: ")) from None

    def _start(self, message: Any) -> tuple[int, Trajectory | None]:
        """Stops the present motion and starts a trajectory; returns its number, and it, or None for an empty one."""
        with self._lock:
            self._goal_number += 1
            number = self._goal_number
            try:
                if self._bot.getTimeToEnd() > 0:
                    self._bot.hold()
                    time.sleep(FEEDBACK)
                if not message.points:
                    self._bot.hold()
                    return number, None
                motion = self._trajectory(message)
                self._bot.follow(motion)
                return number, motion
            except RobotFault as error:
                raise _Refused(self._action.Result.INVALID_GOAL, str(error)) from None
            except Error as error:
                raise _Refused(self._action.Result.INVALID_GOAL, str(error)) from None

    def _onTrajectory(self, message: Any) -> None:
        try:
            self._start(message)
        except _Refused as refused:
            self._node.get_logger().error(f"trajectory refused: {refused}")

    def _execute(self, handle: Any) -> Any:
        """Executes a goal of the action."""
        result = self._action.Result()
        try:
            number, motion = self._start(handle.request.trajectory)
            if motion is not None:
                result.error_code, result.error_string = self._follow(handle, number, motion)
        except _Refused as refused:
            result.error_code, result.error_string = refused.code, str(refused)
        if handle.is_cancel_requested:
            handle.canceled()
        elif result.error_code != self._action.Result.SUCCESSFUL:
            handle.abort()
        else:
            handle.succeed()
        return result

    def _follow(self, handle: Any, number: int, motion: Trajectory) -> tuple[int, str]:
        """Waits for the end of a motion; returns the error code and its text."""
        bot, codes = self._bot, self._action.Result
        limits = {tolerance.name: tolerance.position for tolerance in handle.request.path_tolerance}
        goal_limits = {tolerance.name: tolerance.position for tolerance in handle.request.goal_tolerance}
        goal, late = motion.eval(motion.duration)[0], None
        while True:
            if self._goal_number != number:
                return codes.INVALID_GOAL, "a new goal has replaced this one"
            if handle.is_cancel_requested:
                bot.hold()
                return codes.SUCCESSFUL, "canceled; the robot holds"
            fault = bot.getFault()
            if fault:
                return codes.PATH_TOLERANCE_VIOLATED, fault
            observation = bot.stepObservation()
            self._feedback(handle, observation)
            error = np.abs(observation.qpos - observation.qref)
            for joint, off in zip(self._joints, error, strict=True):
                if 0 < limits.get(joint, 0.0) < off:
                    bot.hold()
                    return codes.PATH_TOLERANCE_VIOLATED, f"joint '{joint}' is {off:.3g} from its path; the robot holds"
            if bot.getTimeToEnd() <= 0:
                late = late or time.monotonic() + max(seconds(handle.request.goal_time_tolerance), 0.5)
                apart = np.abs(observation.qpos - goal)
                allowed = [goal_limits.get(joint, 0.0) or TOLERANCE for joint in self._joints]
                if (apart <= allowed).all():
                    return codes.SUCCESSFUL, ""
                if time.monotonic() > late:
                    worst = int(np.argmax(apart - allowed))
                    return (
                        codes.GOAL_TOLERANCE_VIOLATED,
                        f"joint '{self._joints[worst]}' is {apart[worst]:.3g} from the goal; the tolerance is "
                        f"{allowed[worst]:g}",
                    )
            time.sleep(min(FEEDBACK, max(bot.getTimeToEnd(), 0.005)))

    def _feedback(self, handle: Any, observation: Any) -> None:
        feedback = self._action.Feedback(joint_names=self._joints)
        feedback.header.stamp = self._node.get_clock().now().to_msg()
        feedback.actual = self._point(positions=observation.qpos.tolist(), velocities=observation.qvel.tolist())
        feedback.desired = self._point(positions=observation.qref.tolist(), velocities=observation.qvel_ref.tolist())
        feedback.error = self._point(positions=(observation.qref - observation.qpos).tolist())
        handle.publish_feedback(feedback)
