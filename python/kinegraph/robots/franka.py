"""Franka's FR3 with its hand, through Franka's pylibfranka (`pip install kinegraph[franka]`)."""

from __future__ import annotations

import math
import threading
from typing import Any

import numpy as np

from .._core import Config, GripperCommand, RobotCommand, RobotDriver, RobotInfo, RobotState
from ..packages import needed
from .arm_joints import armInfo
from .hand import Hand, handInfo
from .setpoints import Limits, Setpoints

# Limits of the FR3 in Franka's manual.
VELOCITY = [2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26]  # rad/s
ACCELERATION = [10.0] * 7  # rad/s^2
JERK = [5000.0] * 7  # rad/s^3


class FrankaDriver(RobotDriver):
    """An FR3 with its hand. Tested with the simulator franky-sim, untried on hardware.

    A thread of this process sends a joint position every ms: quintic polynomials through the setpoints of BotOp. It
    keeps Franka's limits of velocity, acceleration and jerk, and stops smoothly if setpoints stay away or would exceed
    them. A real arm needs Linux with real-time priorities; a busy process misses cycles, and the arm then stops by a
    reflex.
    """

    def __init__(self, config: Config, host: str, hand: bool = True, realtime: bool = True):
        """Stores the address of an arm; connect() connects to it.

        Args:
            config: A scene whose q has the arm's seven joints.
            host: Address of the arm.
            hand: True if the arm has Franka's hand.
            realtime: False runs without real-time priority, as for a simulator.
        Raises:
            ArgumentError: The scene has another number of joints.
        """
        super().__init__()
        info = armInfo("FrankaDriver", config, "FR3", 7)
        info.acceleration = 0.8 * np.array(ACCELERATION)  # the rest is for the polynomials between setpoints
        info.velocity = np.minimum(info.velocity, VELOCITY)
        if hand:
            info.grippers = [handInfo()]
        self._info, self._host, self._has_hand, self._realtime = info, host, hand, realtime
        self._robot: Any = None
        self._franka: Any = None
        self._hand: Hand | None = None
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._state: Any = None
        self._setpoints: Setpoints | None = None
        self._ending = False
        self._error = ""
        self.cycles = 0  # cycles so far
        self.late_cycles = 0  # cycles of which the arm reports that more than 1 ms has passed

    def info(self) -> RobotInfo:
        """Returns the joints of the scene with the narrower limits of scene and arm, and the hand."""
        return self._info

    def connect(self) -> None:
        """Connects to the arm and its hand, and holds the arm.

        Raises:
            RuntimeError: The arm does not answer, or has the protocol of another version; the message names both.
        """
        pylibfranka = self._franka = needed("pylibfranka", "franka")
        priority = pylibfranka.RealtimeConfig
        try:
            self._robot = pylibfranka.Robot(self._host, priority.kEnforce if self._realtime else priority.kIgnore)
            if self._has_hand:
                self._hand = Hand(pylibfranka.Gripper(self._host))
        except Exception as error:
            raise RuntimeError(f"no connection to an FR3 at {self._host} with pylibfranka: {error}") from None
        self._start()

    def _start(self) -> None:
        self._state = self._robot.read_once()
        self._setpoints = Setpoints(list(self._state.q_d), Limits(VELOCITY, ACCELERATION, JERK))
        self._error, self._ending = "", False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        """Sends a position every ms."""
        positions = self._franka.JointPositions
        try:
            control = self._robot.start_joint_position_control(self._franka.ControllerMode.JointImpedance)
            while True:
                state, passed = control.readOnce()
                dt = passed.to_sec()
                with self._lock:
                    self._state = state
                    self.cycles += 1
                    self.late_cycles += dt > 0.0015
                    assert self._setpoints is not None
                    q = list(self._setpoints.advance(dt))
                    resting = not any(self._setpoints.velocity)
                    ending = self._ending and resting
                command = positions(q)
                command.motion_finished = ending
                control.writeOnce(command)
                if ending:
                    return
        except Exception as error:
            with self._lock:
                self._error = str(error)

    def _end(self) -> None:
        """Brings the arm to rest and ends the thread."""
        thread, self._thread = self._thread, None
        if thread is None:
            return
        with self._lock:
            self._ending = True
            if self._setpoints is not None:
                self._setpoints.brake()
        thread.join(timeout=5.0)

    def disconnect(self) -> None:
        """Brings the arm to rest, and disconnects."""
        self._end()
        if self._hand is not None:
            self._hand.close()
        self._robot = self._hand = None

    def read(self) -> RobotState:
        """Returns the state of arm and hand, and errors: reflexes, lost connections, exceeded limits."""
        with self._lock:
            state, error = self._state, self._error or (self._setpoints.fault if self._setpoints else "")
        grippers = []
        if self._hand is not None:
            gripper, problem = self._hand.state()
            grippers, error = [gripper], error or problem
        return RobotState(
            state.time.to_sec(),
            np.array(state.q),
            np.array(state.dq),
            np.array(state.tau_J),
            np.array(state.tau_ext_hat_filtered),
            grippers=grippers,
            error=error or (str(state.current_errors) if state.current_errors else ""),
        )

    def write(self, command: RobotCommand) -> None:
        """Passes a setpoint to the thread.

        Args:
            command: The target.
        """
        q, velocity, acceleration = command.q.tolist(), command.velocity.tolist(), command.acceleration.tolist()
        if not all(map(math.isfinite, [*q, *velocity])):
            raise RuntimeError("a setpoint is not finite")
        with self._lock:
            if self._setpoints is not None:
                self._setpoints.aim(q, velocity, acceleration, command.period)

    def stop(self, reason: str) -> None:
        """Brings the arm to rest within its limits, and holds it.

        Args:
            reason: Cause of the stop.
        """
        with self._lock:
            if self._setpoints is not None:
                self._setpoints.brake(reason)

    def recover(self) -> None:
        """Clears errors, and holds the arm."""
        self._end()
        self._robot.automatic_error_recovery()
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
            raise RuntimeError("FrankaDriver: the arm has no hand")
        self._hand.command(command)
