"""The joint_trajectory_controller of a RosBridge."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from .._core import Trajectory
from ..errors import ArgumentError, Error
from .node import needed, seconds
from .points import throughPoints
from .robot import Closed, Robot, State

FEEDBACK = 0.05  # s of control time between feedbacks of a goal
TOLERANCE = 0.01  # rad or m at the goal, if the goal has no tolerance
NEAR = 0.05  # rad or m: a first point without time that is farther from the robot is refused
SETTLE = 0.5  # s after the end of a motion for the robot to arrive, if the goal has no tolerance of time
LEAD = 3  # control periods from the arrival of a goal to its start, if the robot moves

Columns = tuple[np.ndarray, np.ndarray, np.ndarray | None, np.ndarray | None]


class Refused(Exception):
    """A trajectory that is not executed, with the error code of FollowJointTrajectory."""

    def __init__(self, code: int, reason: str):
        super().__init__(reason)
        self.code = code


class TrajectoryController:
    """Executes JointTrajectory messages and goals of FollowJointTrajectory."""

    def __init__(self, node: Any, robot: Robot, controller: str, group: Any):
        """Creates the topic and the action.

        Args:
            node: The node.
            robot: The robot.
            controller: Name of the controller.
            group: A callback group that runs callbacks at the same time.
        """
        messages, action = needed("trajectory_msgs.msg"), needed("rclpy.action")
        self._node, self._robot = node, robot
        self._action = needed("control_msgs.action").FollowJointTrajectory
        self._point = messages.JointTrajectoryPoint
        self._lock = threading.Lock()
        self._number = 0  # of the last goal
        self._present: tuple[float, Trajectory] | None = None  # start and motion of the last goal
        topic = f"/{controller.strip('/')}"
        node.create_subscription(
            messages.JointTrajectory, f"{topic}/joint_trajectory", self._onTrajectory, 1, callback_group=group
        )
        self._server = action.ActionServer(
            node,
            self._action,
            f"{topic}/follow_joint_trajectory",
            self._execute,
            cancel_callback=lambda handle: action.CancelResponse.ACCEPT,
            callback_group=group,
        )

    def close(self) -> None:
        """Ends goals; the robot finishes its present motion."""
        self._number += 1

    # --- messages -------------------------------------------------------------------------------------------------

    def _read(self, message: Any) -> Columns:
        """Checks a message and returns times, q, velocities and accelerations in the order of the robot."""
        joints, codes = self._robot.joints, self._action.Result
        names = list(message.joint_names)
        if sorted(names) != sorted(joints):
            raise Refused(
                codes.INVALID_JOINTS,
                f"the trajectory has the joints {', '.join(names)}; expected {', '.join(joints)}",
            )
        order = [names.index(joint) for joint in joints]
        times = np.array([seconds(point.time_from_start) for point in message.points])
        columns: dict[str, np.ndarray | None] = {}
        for what in ("positions", "velocities", "accelerations"):
            sizes = {len(getattr(point, what)) for point in message.points}
            if sizes == {len(names)}:
                columns[what] = np.array([getattr(point, what) for point in message.points])[:, order]
            elif sizes == {0} and what != "positions":
                columns[what] = None
            else:
                raise Refused(codes.INVALID_GOAL, f"the points have {sorted(sizes)} {what}; expected {len(names)} each")
        q, velocity, acceleration = columns["positions"], columns["velocities"], columns["accelerations"]
        assert q is not None
        if not all(np.isfinite(x).all() for x in (q, velocity, acceleration) if x is not None):
            raise Refused(codes.INVALID_GOAL, "a number is not finite")
        if (np.diff(times) <= 0).any() or times[0] < 0:
            raise Refused(codes.INVALID_GOAL, "times do not increase from 0")
        if velocity is not None and np.abs(velocity[-1]).max() > 1e-3:
            worst = int(np.argmax(np.abs(velocity[-1])))
            raise Refused(
                codes.INVALID_GOAL,
                f"the velocity of joint '{joints[worst]}' at the last point is {velocity[-1, worst]:.3g}; expected 0",
            )
        return times, q, velocity, acceleration

    def _sinceStamp(self, message: Any, columns: Columns) -> tuple[float, Columns]:
        """Returns the time until a trajectory begins, s, and its points after the present time."""
        stamp = seconds(message.header.stamp)
        if stamp == 0:
            return 0.0, columns
        state = self._robot.observe()
        now = state.time if self._robot.is_virtual else self._node.get_clock().now().nanoseconds * 1e-9
        times, *values = columns
        if stamp >= now:
            return stamp - now, columns
        times = times + (stamp - now)
        keep = times > 0
        if not keep.any():
            raise Refused(
                self._action.Result.OLD_HEADER_TIMESTAMP, f"the trajectory ended {-times[-1]:.3g} s ago, by its stamp"
            )
        q, velocity, acceleration = (None if x is None else x[keep] for x in values)
        assert q is not None
        return 0.0, (times[keep], q, velocity, acceleration)

    def _motion(self, columns: Columns, start: np.ndarray) -> Trajectory:
        """Returns the motion from a state, (3, n): q, velocity, acceleration."""
        times, q, velocity, acceleration = columns
        moving = np.abs(start[1:]).max() > 0
        if times[0] > 0:
            times = np.append(0.0, times)
            q = np.vstack([start[0], q])
            velocity = None if velocity is None else np.vstack([start[1], velocity])
            acceleration = None if acceleration is None else np.vstack([start[2], acceleration])
        elif np.abs(q[0] - start[0]).max() <= NEAR and not moving:
            q = np.vstack([start[0], q[1:]])
        if len(times) < 2:
            raise Refused(self._action.Result.INVALID_GOAL, "the trajectory has a single point at time 0")
        try:
            return throughPoints(
                times,
                q,
                velocity,
                acceleration if velocity is not None else None,
                start_velocity=start[1] if velocity is None else None,
            )
        except ArgumentError as error:
            raise Refused(self._action.Result.INVALID_GOAL, str(error).removeprefix("throughPoints: ")) from None

    # --- motions --------------------------------------------------------------------------------------------------

    def _follow(self, message: Any, columns: Columns) -> Trajectory | None:
        """Starts a trajectory, from the present motion if there is one; None if that is not possible."""
        bot, state = self._robot.bot, self._robot.observe()
        wait, columns = self._sinceStamp(message, columns)
        start = np.zeros((3, len(state.q)))
        start[0] = state.reference
        begin = state.time + wait
        moving = state.to_end > 0 or np.abs(state.reference_velocity).max() > 0
        if moving:
            if self._present is None or wait > 0:
                return None
            since, present = self._present
            if np.abs(present.eval(state.time - since)[0] - state.reference).max() > 1e-6:
                return None  # another motion has replaced it
            begin = state.time + (0.0 if self._robot.is_virtual else LEAD / bot.getInfo().rate)
            start[:] = present.eval(begin - since)
        motion = self._motion(columns, start)
        try:
            if begin > state.time or moving:
                bot.follow(motion, overwrite=True, start_time=begin)
            else:
                bot.follow(motion, overwrite=True)
                begin = self._beginOf(motion)
        except Error as error:
            if moving:
                return None
            raise Refused(self._action.Result.INVALID_GOAL, str(error).removeprefix("BotOp::follow: ")) from None
        self._present = begin, motion
        return motion

    def _beginOf(self, motion: Trajectory) -> float:
        """Returns the control time at which the present motion began, s."""
        bot = self._robot.bot
        while True:
            now, to_end = bot.stepObservation().ctrlTime, bot.getTimeToEnd()
            if bot.stepObservation().ctrlTime == now:
                return now + to_end - motion.duration

    def _start(self, message: Any) -> tuple[int, Trajectory | None]:
        """Starts a trajectory; returns its number, and it, or None for an empty one.

        The present motion flows into it if limits allow; else the robot comes to rest first.
        """
        columns = self._read(message) if message.points else None
        with self._lock:
            self._number += 1
            number, call = self._number, self._robot.call
            if columns is None:
                self._present = None
                call(self._robot.bot.hold)
                return number, None
            motion = call(self._follow, message, columns)
            if motion is None:
                self._present = None
                call(self._robot.bot.hold)
                while np.abs(self._robot.next().reference_velocity).max() > 0:
                    pass
                motion = call(self._follow, message, columns)
            return number, motion

    def _onTrajectory(self, message: Any) -> None:
        try:
            self._start(message)
        except (Refused, Error) as error:
            self._node.get_logger().error(f"trajectory refused: {error}")
        except Closed:
            pass

    def _execute(self, handle: Any) -> Any:
        """Executes a goal of the action."""
        result = self._action.Result()
        try:
            number, motion = self._start(handle.request.trajectory)
            if motion is not None:
                result.error_code, result.error_string = self._wait(handle, number, motion)
        except Refused as refused:
            result.error_code, result.error_string = refused.code, str(refused)
        except Error as error:
            result.error_code, result.error_string = result.INVALID_GOAL, str(error)
        except Closed:
            result.error_code, result.error_string = result.INVALID_GOAL, "the bridge was closed"
        if handle.is_cancel_requested:
            handle.canceled()
        elif result.error_code != self._action.Result.SUCCESSFUL:
            handle.abort()
        else:
            handle.succeed()
        return result

    def _wait(self, handle: Any, number: int, motion: Trajectory) -> tuple[int, str]:
        """Waits for the end of a motion; returns the error code and its text."""
        robot, codes, joints = self._robot, self._action.Result, self._robot.joints
        limits = {tolerance.name: tolerance.position for tolerance in handle.request.path_tolerance}
        goal_limits = {tolerance.name: tolerance.position for tolerance in handle.request.goal_tolerance}
        goal = motion.eval(motion.duration)[0]
        settle = max(seconds(handle.request.goal_time_tolerance), SETTLE)
        next_feedback, late = -np.inf, None
        while True:
            state = robot.next()
            if self._number != number:
                return codes.INVALID_GOAL, "a new goal has replaced this one"
            if handle.is_cancel_requested:
                self._hold()
                return codes.SUCCESSFUL, "canceled; the robot holds"
            if state.fault:
                return codes.PATH_TOLERANCE_VIOLATED, state.fault
            if state.time >= next_feedback:
                next_feedback = state.time + FEEDBACK
                self._feedback(handle, state)
            for joint, off in zip(joints, np.abs(state.q - state.reference), strict=True):
                if 0 < limits.get(joint, 0.0) < off:
                    self._hold()
                    return codes.PATH_TOLERANCE_VIOLATED, f"joint '{joint}' is {off:.3g} from its path; the robot holds"
            if state.to_end <= 0:
                late = late or state.time + settle
                apart = np.abs(state.q - goal)
                allowed = [goal_limits.get(joint, 0.0) or TOLERANCE for joint in joints]
                if (apart <= allowed).all():
                    return codes.SUCCESSFUL, ""
                if state.time > late:
                    worst = int(np.argmax(apart - allowed))
                    return (
                        codes.GOAL_TOLERANCE_VIOLATED,
                        f"joint '{joints[worst]}' is {apart[worst]:.3g} from the goal; the tolerance is "
                        f"{allowed[worst]:g}",
                    )

    def _hold(self) -> None:
        self._present = None
        self._robot.call(self._robot.bot.hold)

    def _feedback(self, handle: Any, state: State) -> None:
        feedback = self._action.Feedback(joint_names=self._robot.joints)
        feedback.header.stamp = self._node.get_clock().now().to_msg()
        feedback.actual = self._point(positions=state.q.tolist(), velocities=state.velocity.tolist())
        feedback.desired = self._point(positions=state.reference.tolist(), velocities=state.reference_velocity.tolist())
        feedback.error = self._point(positions=(state.reference - state.q).tolist())
        handle.publish_feedback(feedback)
