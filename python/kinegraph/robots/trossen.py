"""WidowX AI arms of Trossen Robotics, through their trossen-arm (`pip install kinegraph[trossen]`)."""

from __future__ import annotations

import math
import time
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
from ..packages import needed
from .arm_joints import armInfo

JOINTS = 6
SETTLED = 0.3  # s without motion of the gripper: an object or its end stops it
LEAD = 1.5  # control periods after which the arm reaches a setpoint, so that it never waits for the next one


class TrossenDriver(RobotDriver):
    """A WidowX AI arm with its gripper. Tested with Trossen's simulator trossen-arm-sim, untried on hardware.

    The limits of position, velocity and effort are the narrower ones of the scene and of the arm. The arm has position
    control; its stiffness is fixed.
    """

    def __init__(
        self,
        config: Config,
        host: str,
        model: str = "wxai_v0",
        end_effector: str = "wxai_v0_follower",
        *,
        acceleration: float = 10.0,
        connect_timeout: float = 20.0,
    ):
        """Stores the address of an arm; connect() connects to it.

        Args:
            config: A scene whose q has the six joints of the arm, base first. The joint of the gripper is not active.
            host: Address of the arm.
            model: Name of the model, as in trossen_arm.Model.
            end_effector: Name of the end effector, as in trossen_arm.StandardEndEffector.
            acceleration: Limit of all joints, rad/s^2.
            connect_timeout: Longest time of the connection, s.
        Raises:
            ArgumentError: The scene has another number of joints, or a number is invalid.
        """
        super().__init__()
        info = armInfo("TrossenDriver", config, "Trossen", JOINTS)
        if not 0 < acceleration < math.inf:
            raise ArgumentError(f"TrossenDriver: acceleration is {acceleration}; expected a number above 0, in rad/s^2")
        info.acceleration = np.full(JOINTS, acceleration)
        info.grippers = [GripperInfo("gripper", 0.0, 0.088, 0.2, 400.0)]
        self._info, self._host, self._timeout = info, host, connect_timeout
        self._model, self._end_effector = model, end_effector
        self._arm: Any = None
        self._modes: Any = None
        self._width = self._goal = 0.0
        self._moved = 0.0

    def info(self) -> RobotInfo:
        """Returns the joints of the scene with the limits of scene and arm, and the gripper."""
        return self._info

    def connect(self) -> None:
        """Connects to the arm, reads its limits, and holds it.

        Raises:
            ArgumentError: There is no such model or end effector.
            RuntimeError: The arm does not answer, or has another number of joints.
        """
        trossen_arm = needed("trossen_arm", "trossen")
        model = _named(trossen_arm.Model, self._model, "model")
        end_effector = _named(trossen_arm.StandardEndEffector, self._end_effector, "end_effector")
        arm = trossen_arm.TrossenArmDriver()
        arm.configure(model, end_effector, self._host, False, self._timeout)
        try:
            self._begin(arm, trossen_arm.Mode)
        except BaseException:
            arm.cleanup()
            raise

    def _begin(self, arm: Any, modes: Any) -> None:
        limits = arm.get_joint_limits()
        if len(limits) != JOINTS + 1:
            raise RuntimeError(f"the arm has {len(limits)} joints; expected {JOINTS} and the gripper")
        of_arm, info = limits[:JOINTS], self._info
        info.lower = np.maximum(info.lower, [limit.position_min for limit in of_arm])
        info.upper = np.minimum(info.upper, [limit.position_max for limit in of_arm])
        info.velocity = np.minimum(info.velocity, [limit.velocity_max for limit in of_arm])
        info.effort = np.minimum(info.effort, [limit.effort_max for limit in of_arm])
        info.grippers = [GripperInfo("gripper", 0.0, 2.0 * limits[JOINTS].position_max, 0.2, limits[JOINTS].effort_max)]
        arm.set_all_modes(modes.position)
        self._arm, self._modes = arm, modes
        self.read()
        self._goal = self._width

    def disconnect(self) -> None:
        """Ends position control and disconnects. The arm then sinks: support it, or move it home first."""
        arm, self._arm = self._arm, None
        if arm is not None:
            arm.set_all_modes(self._modes.idle)
            arm.cleanup()

    def read(self) -> RobotState:
        """Returns the state of arm and gripper, and errors of the controller."""
        output = self._arm.get_robot_output()
        arm, width = output.joint.arm, 2.0 * float(output.joint.gripper.position)
        now = time.monotonic()
        if abs(width - self._width) > 1e-4:
            self._moved = now
        self._width = width
        done = abs(width - self._goal) < 2e-3 or now - self._moved > SETTLED
        error = str(self._arm.get_error_information())
        return RobotState(
            float(output.header.timestamp) * 1e-6,
            np.array(arm.positions),
            np.array(arm.velocities),
            np.array(arm.efforts),
            np.array(arm.external_efforts),
            grippers=[GripperState(width, done)],
            error="" if "no error" in error.lower() else error,
        )

    def write(self, command: RobotCommand) -> None:
        """Sends a setpoint with its velocity.

        Args:
            command: The target.
        """
        ahead = (LEAD - 1.0) * command.period  # the setpoint is that of a later time, which the velocity predicts
        q = command.q + ahead * command.velocity
        self._arm.set_arm_positions(q.tolist(), LEAD * command.period, False, command.velocity.tolist())

    def stop(self, reason: str) -> None:
        """Holds the arm at its place.

        Args:
            reason: Cause of the stop.
        """
        self._arm.set_arm_positions(list(self._arm.get_arm_positions()), 0.0, False)

    def recover(self) -> None:
        """Clears errors of the controller, and holds the arm."""
        self._arm.clear_error()
        self._arm.set_all_modes(self._modes.position)

    def moveGripper(self, command: GripperCommand) -> None:
        """Moves the gripper. Does not wait. A grasp closes with the controller's force until an object blocks it.

        Args:
            command: A GripperCommand.
        """
        self._goal = 0.0 if command.grasp else command.width
        self._moved = time.monotonic()
        seconds = abs(self._goal - self._width) / command.speed
        self._arm.set_gripper_position(self._goal / 2.0, max(seconds, 0.05), False)


def _named(group: Any, name: str, argument: str) -> Any:
    known = [known for known in dir(group) if not known.startswith("_") and known not in ("name", "value")]
    if name not in known:
        raise ArgumentError(f"TrossenDriver: {argument} is '{name}'; expected one of {', '.join(known)}")
    return getattr(group, name)
