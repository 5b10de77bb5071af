"""The gripper controllers of a RosBridge."""

from __future__ import annotations

import math
from typing import Any

from .._core import JT, Config, Frame
from ..errors import Error
from ..recording.links import Links
from .node import needed
from .robot import Closed, Robot

TOLERANCE = 2e-3  # m of the opening
STILL, STUCK = 1e-5, 0.1  # m of the opening per state; s without more motion: an object stops the fingers


class Finger:
    """The joint of a gripper: its position, as ROS has it, and the opening."""

    def __init__(self, world: Config, links: Links, name: str, widths: tuple[float, float], width: float):
        """Finds the joint.

        Args:
            world: The scene.
            links: Its links.
            name: Name of the gripper.
            widths: Smallest and largest opening, m.
            width: The present opening, m.
        """
        self.joint, self._scale, self._offset = name, 1.0, 0.0  # a scene without fingers: the opening
        for joint in links.fingers:
            frame = world.getFrame(joint)
            attributes = frame.getAttributes()
            if "mimic" in attributes or (joint != name and _head(frame.getParent()) != _head(world.getFrame(name))):
                continue
            limits = attributes.get("limits", [])
            if len(limits) < 2 or not limits[0] < limits[1]:
                continue
            scale = (widths[1] - widths[0]) / (limits[1] - limits[0])
            q = float(frame.getJointState()[0])
            ends = [(scale, widths[0] - scale * limits[0]), (-scale, widths[1] + scale * limits[0])]
            self.joint = joint
            self._scale, self._offset = min(ends, key=lambda end: abs(end[0] * q + end[1] - width))
            break

    def width(self, position: float) -> float:
        """Returns the opening at a position of the joint, m."""
        return self._scale * position + self._offset

    def position(self, width: float) -> float:
        """Returns the position of the joint for an opening."""
        return (width - self._offset) / self._scale


def _head(frame: Frame | None) -> str:
    """Returns the name of the joint that moves a frame."""
    while frame is not None and frame.getJointType() in (JT.none, JT.rigid):
        frame = frame.getParent()
    return "" if frame is None else frame.name


class GripperController:
    """Executes the actions GripperCommand and ParallelGripperCommand with one gripper.

    Positions are those of the finger's joint. A position at the closed end closes with force and holds what is between
    the fingers; the goal succeeds as `stalled`.
    """

    def __init__(self, node: Any, robot: Robot, gripper: int, finger: Finger, names: tuple[str, str], group: Any):
        """Creates the actions.

        Args:
            node: The node.
            robot: The robot.
            gripper: Number of the gripper.
            finger: Its joint.
            names: Names of the controllers of the two actions.
            group: A callback group that runs callbacks at the same time.
        """
        actions, action = needed("control_msgs.action"), needed("rclpy.action")
        self._node, self._robot, self._gripper, self._finger = node, robot, gripper, finger
        self._info, self._number = robot.grippers[gripper], 0
        self._state = needed("sensor_msgs.msg").JointState
        kinds = [(names[0], getattr(actions, "GripperCommand", None), self._execute)]
        kinds += [(names[1], getattr(actions, "ParallelGripperCommand", None), self._executeParallel)]
        self._servers = [
            action.ActionServer(
                node,
                kind,
                f"/{name}/gripper_cmd",
                execute,
                cancel_callback=lambda handle: action.CancelResponse.ACCEPT,
                callback_group=group,
            )
            for name, kind, execute in kinds
            if kind is not None  # older distributions lack one
        ]
        self._single: Any = kinds[0][1]
        self._parallel: Any = kinds[1][1]

    def close(self) -> None:
        """Ends goals."""
        self._number += 1

    def _execute(self, handle: Any) -> Any:
        command = handle.request.command

        def fill(message: Any, width: float, stalled: bool, reached: bool) -> Any:
            message.position, message.stalled, message.reached_goal = self._finger.position(width), stalled, reached
            return message

        types = self._single.Result, self._single.Feedback
        return self._run(handle, command.position, command.max_effort, 0.0, types, fill)

    def _executeParallel(self, handle: Any) -> Any:
        command, types = handle.request.command, (self._parallel.Result, self._parallel.Feedback)

        def fill(message: Any, width: float, stalled: bool, reached: bool) -> Any:
            message.state = self._state(name=[self._finger.joint], position=[self._finger.position(width)])
            if isinstance(message, self._parallel.Result):
                message.stalled, message.reached_goal = stalled, reached
            return message

        position = command.position[0] if len(command.position) == 1 else math.nan
        if list(command.name) not in ([], [self._finger.joint]):
            self._refuse(f"the joint is {', '.join(command.name)}; expected {self._finger.joint}")
            position = math.nan
        effort = command.effort[0] if len(command.effort) else 0.0
        speed = command.velocity[0] if len(command.velocity) else 0.0
        return self._run(handle, position, effort, abs(speed), types, fill)

    def _refuse(self, reason: str) -> None:
        self._node.get_logger().error(f"goal of gripper '{self._info.name}' refused: {reason}")

    def _run(self, handle: Any, position: float, effort: float, speed: float, types: tuple[Any, Any], fill: Any) -> Any:
        """Executes a goal.

        Args:
            handle: The goal.
            position: Position of the joint, rad or m.
            effort: Force, N; 0: the gripper's.
            speed: Speed of the joint, m/s or rad/s; 0: the gripper's.
            types: Types of result and feedback.
            fill: Writes opening, stalled and reached into a message.
        """
        result, feedback = types[0](), types[1]()
        self._number += 1
        number = self._number
        try:
            if not (math.isfinite(position) and math.isfinite(effort) and math.isfinite(speed)):
                self._refuse(f"position {position}, effort {effort}, speed {speed}; expected one finite position")
                handle.abort()
                return result
            goal = min(max(self._finger.width(position), self._info.min_width), self._info.max_width)
            speed = abs(self._finger.width(speed) - self._finger.width(0.0)) or self._info.max_speed
            self._robot.call(self._command, goal, effort, speed)
            width, stalled, reached = self._wait(handle, number, goal, lambda *seen: fill(feedback, *seen))
            fill(result, width, stalled, reached)
            if handle.is_cancel_requested and not (stalled or reached):
                handle.canceled()
            elif stalled or reached:
                handle.succeed()
            else:
                handle.abort()
        except (Closed, Error) as error:
            self._refuse(str(error) or "the bridge was closed")
            handle.abort()
        return result

    def _command(self, goal: float, effort: float, speed: float) -> None:
        bot, info = self._robot.bot, self._info
        if goal <= info.min_width + TOLERANCE:
            force = effort if effort > 0 else info.max_force
            bot.gripperClose(self._gripper, force=force, width=goal, speed=speed)
        else:
            bot.gripperMove(self._gripper, goal, speed)

    def _wait(self, handle: Any, number: int, goal: float, feedback: Any) -> tuple[float, bool, bool]:
        """Waits for the end; returns opening, stalled, reached."""
        last, still_since = math.inf, math.inf
        while True:
            state = self._robot.next()
            width = state.widths[self._gripper]
            reached = abs(width - goal) <= TOLERANCE
            if abs(width - last) > STILL:
                last, still_since = width, state.time
            stalled = not reached and state.time - still_since > STUCK
            handle.publish_feedback(feedback(width, stalled, reached))
            if reached or stalled or self._number != number or state.fault:
                return width, stalled and not state.fault, reached
            if handle.is_cancel_requested:
                self._robot.call(self._robot.bot.gripperMove, self._gripper, width, self._info.max_speed)
                return width, False, False
