"""Any robot of LeRobot: SO-101, Koch, OpenArm and others, those of its plugins included."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
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
from ..errors import ArgumentError, NotFound

LATE = 0.2  # s: a robot that answers later is stopped
SETTLED = 0.3  # s without motion of a gripper: an object or its end stops it


class LeRobotDriver(RobotDriver):
    """A robot of LeRobot: an object with get_observation() and send_action(). Untried on hardware.

    The robot reports and takes positions named `MOTOR.pos`, in degrees or radians. BotOp keeps the limits of position,
    velocity and acceleration. An answer that is late, lacks a joint or is not finite stops the robot at its last
    position.
    """

    def __init__(
        self,
        config: Config,
        robot: Any,
        motors: Mapping[str, str] | None = None,
        *,
        units: str = "degrees",
        signs: Mapping[str, float] | None = None,
        offsets: Mapping[str, float] | None = None,
        acceleration: float = 10.0,
        gripper: str | None = None,
        opening: tuple[float, float] = (0.0, 0.08),
        gripper_range: tuple[float, float] = (0.0, 100.0),
    ):
        """Stores the robot; connect() connects to it, unless it is connected already.

        Args:
            config: A scene whose q has the joints of the arm.
            robot: A robot of LeRobot, made without cameras: their images would delay the loop.
            motors: Names of the motors by joint; by default those of the joints.
            units: "degrees" or "radians".
            signs: -1 for joints that turn the other way than their motor; others 1.
            offsets: Joint value at the motor's zero, rad.
            acceleration: Limit of all joints, rad/s^2.
            gripper: Name of the motor of the gripper, if there is one.
            opening: Widths (m) of the closed and of the open gripper.
            gripper_range: Positions of the gripper's motor, closed and open.
        Raises:
            NotFound: The robot lacks a motor, or `motors`, `signs` or `offsets` name something that is no joint.
            ArgumentError: An argument is invalid, or the robot does not use degrees.
        """
        super().__init__()
        info = RobotInfo.of(config, str(getattr(robot, "name", type(robot).__name__)))
        if units not in ("degrees", "radians"):
            raise ArgumentError(f"LeRobotDriver: units is '{units}'; expected 'degrees' or 'radians'")
        if units == "degrees" and getattr(getattr(robot, "config", None), "use_degrees", True) is False:
            raise ArgumentError(
                f"LeRobotDriver: the robot '{info.name}' reports positions from -100 to 100; make it with use_degrees=True"
            )
        if not (0 < acceleration < math.inf):
            raise ArgumentError(f"LeRobotDriver: acceleration is {acceleration}; expected a number above 0, in rad/s^2")
        for name, given in (("motors", motors), ("signs", signs), ("offsets", offsets)):
            for joint in given or {}:
                if joint not in info.joints:
                    raise NotFound(
                        f"LeRobotDriver: {name} has '{joint}', which is no joint of the scene: {', '.join(info.joints)}"
                    )
        self._motors = [(motors or {}).get(joint, joint) for joint in info.joints]
        unit = math.pi / 180 if units == "degrees" else 1.0
        self._scale = unit * np.array([(signs or {}).get(joint, 1.0) for joint in info.joints])
        self._offset = np.array([(offsets or {}).get(joint, 0.0) for joint in info.joints], float)
        if not (np.isfinite(self._offset).all() and (np.abs(np.abs(self._scale) - unit) < 1e-12).all()):
            raise ArgumentError("LeRobotDriver: expected signs of 1 or -1, and finite offsets in rad")
        known = [str(name).removesuffix(".pos") for name in getattr(robot, "action_features", {})]
        for motor in [*self._motors, *([gripper] if gripper else [])]:
            if known and motor not in known:
                raise NotFound(
                    f"LeRobotDriver: the robot '{info.name}' has no motor '{motor}'; it has {', '.join(known)}"
                )
        info.acceleration = np.full(len(info.joints), acceleration)
        if gripper:
            if not 0 <= opening[0] < opening[1] or gripper_range[0] == gripper_range[1]:
                raise ArgumentError(
                    f"LeRobotDriver: opening is {opening}, gripper_range {gripper_range}; expected two widths in m, the "
                    "smaller one first, and two different positions"
                )
            info.grippers = [GripperInfo(gripper, opening[0], opening[1], 0.3, math.inf)]
        self._info, self._robot, self._gripper = info, robot, gripper
        self._opening, self._range = opening, gripper_range
        self._q: np.ndarray | None = None
        self._velocity = np.zeros(len(info.joints))
        self._time = 0.0
        self._width = self._goal = self._command = opening[1]
        self._speed, self._moved = 0.1, 0.0

    def info(self) -> RobotInfo:
        """Returns the joints of the scene with their limits, and the gripper."""
        return self._info

    def connect(self) -> None:
        """Connects to the robot, and reads its state."""
        if not self._robot.is_connected:
            self._robot.connect()
        self.read()
        self._goal = self._command = self._width

    def disconnect(self) -> None:
        """Disconnects; LeRobot's robots release their motors then."""
        if self._robot.is_connected:
            self._robot.disconnect()

    def read(self) -> RobotState:
        """Returns the state of the robot. Velocities are differences of positions."""
        began = time.monotonic()
        observation = self._robot.get_observation()
        now = time.monotonic()
        error = (
            "" if now - began <= LATE else f"the robot answered after {now - began:.2f} s; expected at most {LATE} s"
        )
        names = [*self._motors, *([self._gripper] if self._gripper else [])]
        missing = [f"{name}.pos" for name in names if f"{name}.pos" not in observation]
        if missing:
            error = f"the observation lacks '{missing[0]}'; it has {', '.join(map(str, observation))}"
            return RobotState(now, self._resting(), self._velocity, grippers=self._grippers(), error=error)
        q = self._scale * np.array([float(observation[f"{motor}.pos"]) for motor in self._motors]) + self._offset
        if self._q is not None and now > self._time:
            self._velocity = (q - self._q) / (now - self._time)
        if np.isfinite(q).all():
            self._q = q
        self._time = now
        if self._gripper:
            share = (float(observation[f"{self._gripper}.pos"]) - self._range[0]) / (self._range[1] - self._range[0])
            width = self._opening[0] + share * (self._opening[1] - self._opening[0])
            if abs(width - self._width) > 1e-4:
                self._moved = now
            self._width = width
        return RobotState(now, q, self._velocity, grippers=self._grippers(), error=error)

    def _resting(self) -> np.ndarray:
        return np.zeros(len(self._motors)) if self._q is None else self._q

    def _grippers(self) -> list[GripperState]:
        if not self._gripper:
            return []
        arrived = self._command == self._goal and (
            abs(self._width - self._goal) < 2e-3 or time.monotonic() - self._moved > SETTLED
        )
        return [GripperState(self._width, arrived)]

    def _send(self, q: np.ndarray) -> None:
        values = (q - self._offset) / self._scale
        action = {f"{motor}.pos": float(value) for motor, value in zip(self._motors, values, strict=True)}
        if self._gripper:
            share = (self._command - self._opening[0]) / (self._opening[1] - self._opening[0])
            action[f"{self._gripper}.pos"] = float(self._range[0] + share * (self._range[1] - self._range[0]))
        self._robot.send_action(action)

    def write(self, command: RobotCommand) -> None:
        """Sends the positions of the joints, and the gripper's next position on its way.

        Args:
            command: The target.
        """
        step = self._speed * command.period
        self._command += min(max(self._goal - self._command, -step), step)
        self._send(command.q)

    def stop(self, reason: str) -> None:
        """Holds the robot at its last known position.

        Args:
            reason: Cause of the stop.
        """
        if self._q is not None:
            self._send(self._q)

    def recover(self) -> None:
        """Connects again if the connection is lost."""
        if not self._robot.is_connected:
            self._robot.connect()

    def moveGripper(self, command: GripperCommand) -> None:
        """Moves the gripper. Does not wait. The force is that of the motor's settings.

        Args:
            command: A GripperCommand.
        Raises:
            RuntimeError: There is no gripper.
        """
        if not self._gripper:
            raise RuntimeError("LeRobotDriver: the robot has no gripper; pass gripper=")
        low, high = self._opening
        self._goal = low if command.grasp else min(max(command.width, low), high)  # an object stops a grasp
        self._speed, self._moved = command.speed, time.monotonic()
