"""A robot of ros2_control as a RobotDriver."""

from __future__ import annotations

import math
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._core import (
    Config,
    GripperCommand,
    GripperInfo,
    GripperState,
    RobotCommand,
    RobotDriver,
    RobotInfo,
    RobotState,
)
from ..errors import ArgumentError
from .node import RunningNode, needed, seconds


@dataclass(frozen=True)
class RosGripper:
    """A gripper with a GripperActionController (action CONTROLLER/gripper_cmd, GripperCommand).

    Attributes:
        joint: Name of the finger's joint in ROS.
        closed, open: Its positions, rad or m.
        width: The opening at `open`, m; at `closed` it is 0.
        controller: Name of the controller.
        speed: Rate of the opening, m/s, for estimates of time.
        force: Largest force, N, sent as max_effort.
    """

    joint: str
    closed: float = 0.0
    open: float = 0.04
    width: float = 0.08
    controller: str = "gripper_controller"
    speed: float = 0.1
    force: float = 70.0


class RosDriver(RobotDriver):
    """Drives a robot by a forward_position_controller of ros2_control, with the states of a joint_state_broadcaster.

    The time of a state is its stamp: if states stay away for .1 s, BotOp stops the robot. Untried on hardware.
    """

    def __init__(
        self,
        config: Config,
        *,
        names: Mapping[str, str] | None = None,
        controller: str = "forward_position_controller",
        states: str = "/joint_states",
        timeout: float = 5.0,
        acceleration: float = 10.0,
        gripper: RosGripper | None = None,
    ):
        """Stores the names; connect() starts a node.

        Args:
            config: A scene whose q has the joints of the robot, in the controller's order.
            names: Names in ROS of joints that have other names in the scene.
            controller: Name of the controller.
            states: Topic of JointState.
            timeout: Longest wait for the first state, s.
            acceleration: Limit of all joints, rad/s^2.
            gripper: The gripper, if there is one.
        Raises:
            ArgumentError: The positions or the width of the gripper are invalid.
        """
        super().__init__()
        self._info = RobotInfo.of(config, "ROS 2")
        self._info.acceleration = np.full(len(self._info.joints), acceleration)
        self._names = [(names or {}).get(joint, joint) for joint in self._info.joints]
        self._controller, self._topic, self._timeout = controller.strip("/"), states, timeout
        self._lock = threading.Lock()
        self._arrived = threading.Event()
        self._state: tuple[float, np.ndarray, np.ndarray, np.ndarray] | None = None
        self._seen: list[str] = []
        self._running: RunningNode | None = None
        self._gripper, self._hand = gripper, math.nan  # position of its joint
        self._goal: tuple[float, bool] = (math.nan, True)  # goal of the gripper, and whether it has ended
        if gripper is not None:
            if gripper.closed == gripper.open or not gripper.width > 0:
                raise ArgumentError(
                    f"RosDriver: the gripper has closed={gripper.closed}, open={gripper.open}, width={gripper.width}; "
                    "expected two positions and a width above 0"
                )
            self._info.grippers = [GripperInfo(gripper.joint, 0.0, gripper.width, gripper.speed, gripper.force)]

    def info(self) -> RobotInfo:
        """Returns the joints of the scene with their limits."""
        return self._info

    def connect(self) -> None:
        """Starts a node and waits for a state with all joints.

        Raises:
            NotFound: A package of ROS 2 is missing.
            RuntimeError: No state has all joints.
        """
        sensor, std = needed("sensor_msgs.msg"), needed("std_msgs.msg")
        self._running = RunningNode("kinegraph_driver", 2)
        node = self._running.node
        self._message = std.Float64MultiArray
        self._commands = node.create_publisher(std.Float64MultiArray, f"/{self._controller}/commands", 1)
        node.create_subscription(sensor.JointState, self._topic, self._onState, 1)
        if self._gripper is not None:
            control, action = needed("control_msgs.action"), needed("rclpy.action")
            self._hand_goal = control.GripperCommand.Goal
            self._hand_action = action.ActionClient(
                node, control.GripperCommand, f"/{self._gripper.controller.strip('/')}/gripper_cmd"
            )
        self._running.start()
        if not self._arrived.wait(self._timeout):
            self.disconnect()
            seen = (
                f"states there have the joints {', '.join(self._seen)}" if self._seen else "nothing was received there"
            )
            names = [*self._names, *([self._gripper.joint] if self._gripper else [])]
            raise RuntimeError(f"no state on {self._topic} has the joints {', '.join(names)}; {seen}")
        if self._gripper is not None and not self._hand_action.wait_for_server(self._timeout):
            self.disconnect()
            raise RuntimeError(f"there is no action /{self._gripper.controller}/gripper_cmd of type GripperCommand")

    def disconnect(self) -> None:
        """Ends the node."""
        running, self._running = self._running, None
        if running is not None:
            running.close()

    def _onState(self, message: Any) -> None:
        at = {name: index for index, name in enumerate(message.name)}
        self._seen = list(message.name)
        if not all(name in at for name in self._names):
            return
        gripper = self._gripper
        if gripper is not None and gripper.joint in at and len(message.position) == len(at):
            self._hand = float(message.position[at[gripper.joint]])
        if gripper is not None and math.isnan(self._hand):
            return  # states of the hand may come in messages of their own
        rows = [at[name] for name in self._names]

        def pick(values: Any) -> np.ndarray:
            return np.array(values)[rows] if len(values) == len(at) else np.zeros(0)

        q, velocity, effort = pick(message.position), pick(message.velocity), pick(message.effort)
        if len(q):
            with self._lock:
                self._state = seconds(message.header.stamp), q, velocity if len(velocity) else np.zeros(len(q)), effort
            self._arrived.set()

    def read(self) -> RobotState:
        """Returns the latest state."""
        with self._lock:
            assert self._state is not None
            state = RobotState(*self._state)
        gripper = self._gripper
        if gripper is not None:
            share = (self._hand - gripper.closed) / (gripper.open - gripper.closed)
            state.grippers = [GripperState(gripper.width * share, self._goal[1])]
        return state

    def write(self, command: RobotCommand) -> None:
        """Publishes the positions.

        Args:
            command: The target.
        """
        self._commands.publish(self._message(data=command.q.tolist()))

    def stop(self, reason: str) -> None:
        """Publishes the latest position as the command.

        Args:
            reason: Cause of the stop.
        """
        with self._lock:
            q = None if self._state is None else self._state[1]
        if q is not None and np.isfinite(q).all():
            self._commands.publish(self._message(data=q.tolist()))

    def moveGripper(self, command: GripperCommand) -> None:
        """Sends a goal to the gripper's controller. Does not wait.

        Args:
            command: A GripperCommand.
        Raises:
            RuntimeError: There is no gripper.
        """
        gripper = self._gripper
        if gripper is None:
            raise RuntimeError("RosDriver: the robot has no gripper; pass gripper=RosGripper(...)")
        share = 0.0 if command.grasp else command.width / gripper.width
        position = gripper.closed + share * (gripper.open - gripper.closed)
        goal = self._hand_goal()
        goal.command.position, goal.command.max_effort = float(position), float(command.force)
        this = self._goal = (position, False)

        def end(result: Any) -> None:
            if self._goal is this:  # no later goal has replaced it
                self._goal = (position, True)

        def accepted(future: Any) -> None:
            handle = future.result()
            if handle is None or not handle.accepted:
                end(None)
            else:
                handle.get_result_async().add_done_callback(end)

        self._hand_action.send_goal_async(goal).add_done_callback(accepted)

    def recover(self) -> None:
        """Does nothing: controllers of ros2_control are recovered by their manager."""
