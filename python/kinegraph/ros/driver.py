"""A robot of ros2_control as a RobotDriver."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

import numpy as np

from .._core import Config, RobotCommand, RobotDriver, RobotInfo, RobotState
from .node import RunningNode, needed, seconds


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
    ):
        """Stores the names; connect() starts a node.

        Args:
            config: A scene whose q has the joints of the robot, in the controller's order.
            names: Names in ROS of joints that have other names in the scene.
            controller: Name of the controller.
            states: Topic of JointState.
            timeout: Longest wait for the first state, s.
            acceleration: Limit of all joints, rad/s^2.
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
        self._running.start()
        if not self._arrived.wait(self._timeout):
            self.disconnect()
            seen = (
                f"states there have the joints {', '.join(self._seen)}" if self._seen else "nothing was received there"
            )
            raise RuntimeError(f"no state on {self._topic} has the joints {', '.join(self._names)}; {seen}")

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
            return RobotState(*self._state)

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

    def recover(self) -> None:
        """Does nothing: controllers of ros2_control are recovered by their manager."""
