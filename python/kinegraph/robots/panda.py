"""Franka's Panda with its hand, through panda-python (`pip install kinegraph[panda]`)."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._core import (
    Config,
    GripperCommand,
    RobotCommand,
    RobotDriver,
    RobotInfo,
    RobotState,
)
from ..packages import needed
from .arm_joints import armInfo
from .hand import Hand, handInfo

STIFFNESS = np.array([600.0, 600.0, 600.0, 600.0, 250.0, 150.0, 50.0])  # N m/rad, defaults of panda-python
DAMPING = np.array([50.0, 50.0, 50.0, 20.0, 20.0, 20.0, 10.0])  # N m s/rad
ACCELERATION = np.array([15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0])  # rad/s^2, from Franka's manual


class PandaDriver(RobotDriver):
    """A Panda with its hand. Untried on hardware. An FR3 has another protocol; its driver is FrankaDriver.

    The loop of 1 kHz runs in panda-python's thread; this driver passes it setpoints. Its controller has one stiffness
    per joint, so that setCompliance uses the diagonal of the compliance only.
    """

    def __init__(self, config: Config, host: str, hand: bool = True):
        """Stores the address of an arm; connect() connects to it.

        Args:
            config: A scene whose q has the arm's seven joints.
            host: Address of the arm.
            hand: True if the arm has Franka's hand.
        Raises:
            ArgumentError: The scene has another number of joints.
        """
        super().__init__()
        info = armInfo("PandaDriver", config, "Franka", 7)
        info.compliant = True
        info.acceleration = ACCELERATION
        if hand:
            info.grippers = [handInfo()]
        self._info, self._host, self._has_hand = info, host, hand
        self._panda: Any = None
        self._controller: Any = None
        self._hand: Hand | None = None
        self._share = np.ones(7)

    def info(self) -> RobotInfo:
        """Returns the joints of the scene with their limits, and the hand."""
        return self._info

    def connect(self) -> None:
        """Connects to the arm and its hand, and holds the arm."""
        self._panda = needed("panda_py", "panda").Panda(self._host)
        if self._has_hand:
            from panda_py import libfranka

            self._hand = Hand(libfranka.Gripper(self._host))
        self._start()

    def _start(self) -> None:
        from panda_py import controllers

        self._controller = controllers.JointPosition(STIFFNESS, DAMPING)
        self._share = np.ones(7)
        state = self._panda.get_state()
        self._controller.set_control(np.array(state.q), np.zeros(7))
        self._panda.start_controller(self._controller)

    def disconnect(self) -> None:
        """Stops the controller, and disconnects."""
        if self._hand is not None:
            self._hand.close()
        if self._panda is not None:
            self._panda.stop_controller()
        self._panda = self._controller = self._hand = None

    def read(self) -> RobotState:
        """Returns the state of arm and hand: positions, torques, and errors."""
        arm = self._panda.get_state()
        error = str(arm.current_errors) if arm.current_errors else ""
        grippers = []
        if self._hand is not None:
            state, problem = self._hand.state()
            grippers, error = [state], error or problem
        time = arm.time.to_sec()
        return RobotState(time, arm.q, arm.dq, arm.tau_J, arm.tau_ext_hat_filtered, grippers, error)

    def write(self, command: RobotCommand) -> None:
        """Passes a setpoint to the controller.

        Args:
            command: The target.
        """
        share = np.ones(7) if command.isStiff() else np.clip(np.diag(command.stiffness), 0.0, 1.0)
        if not np.array_equal(share, self._share):
            self._share = share
            damping = np.sqrt(share) if share.any() else np.full(7, command.damping)
            self._controller.set_stiffness(STIFFNESS * share)
            self._controller.set_damping(DAMPING * damping)
        self._controller.set_control(command.q, command.velocity)

    def stop(self, reason: str) -> None:
        """Stops the controller; the arm's brakes hold it.

        Args:
            reason: Cause of the stop.
        """
        self._panda.stop_controller()

    def recover(self) -> None:
        """Clears errors, and holds the arm."""
        self._panda.recover()
        if self._hand is not None:
            self._hand.clear()
        self._start()

    def moveGripper(self, command: GripperCommand) -> None:
        """Moves the hand. Does not wait.

        Args:
            command: A GripperCommand.
        Raises:
            RuntimeError: There is no hand.
        """
        if self._hand is None:
            raise RuntimeError("PandaDriver: the arm has no hand")
        self._hand.command(command)
