"""Arms of Universal Robots, through ur-rtde (`pip install kinegraph[ur]`)."""

from __future__ import annotations

from typing import Any

from .._core import Config, RobotCommand, RobotDriver, RobotInfo, RobotState
from ..packages import needed
from .arm_joints import armInfo


class UrDriver(RobotDriver):
    """An arm of Universal Robots with six joints. Untried on hardware.

    servoj moves the arm. Its limits are those of the scene's joints; a UR's controller has its own limits, and stops
    the arm beyond them.
    """

    def __init__(
        self, config: Config, host: str, lookahead: float = 0.05, gain: float = 600.0, deceleration: float = 10.0
    ):
        """Stores the address of an arm; connect() connects to it.

        Args:
            config: A scene whose q has the arm's joints, base first.
            host: Address of the controller.
            lookahead: Smoothing time of servoj, .03 to .2 s.
            gain: Gain of servoj, 100 to 2000.
            deceleration: Deceleration of stops, rad/s^2.
        Raises:
            ArgumentError: The scene has another number of joints.
        """
        super().__init__()
        self._info = armInfo("UrDriver", config, "UR", 6)
        self._host, self._lookahead, self._gain, self._deceleration = host, lookahead, gain, deceleration
        self._control: Any = None
        self._receive: Any = None

    def info(self) -> RobotInfo:
        """Returns the joints of the scene with their limits."""
        return self._info

    def connect(self) -> None:
        """Connects to the controller, and starts its program for commands."""
        self._receive = needed("rtde_receive", "ur").RTDEReceiveInterface(self._host)
        self._control = needed("rtde_control", "ur").RTDEControlInterface(self._host)

    def disconnect(self) -> None:
        """Stops the arm, and disconnects."""
        if self._control is not None:
            self._control.servoStop(self._deceleration)
            self._control.disconnect()
        if self._receive is not None:
            self._receive.disconnect()
        self._control = self._receive = None

    def _error(self) -> str:
        if not self._receive.isConnected():
            return "the connection is lost"
        if self._receive.isEmergencyStopped():
            return "emergency stop"
        if self._receive.isProtectiveStopped():
            return "protective stop"
        return "" if self._control.isProgramRunning() else "the program on the controller is not running"

    def read(self) -> RobotState:
        """Returns the state of the arm and its errors."""
        receive = self._receive
        return RobotState(receive.getTimestamp(), receive.getActualQ(), receive.getActualQd(), error=self._error())

    def write(self, command: RobotCommand) -> None:
        """Moves the arm for one control period.

        Args:
            command: The target.
        Raises:
            RuntimeError: The controller rejects the command.
        """
        q = [float(x) for x in command.q]
        if not self._control.servoJ(q, 0.0, 0.0, command.period, self._lookahead, self._gain):
            raise RuntimeError(self._error() or "the controller rejected servoj")

    def stop(self, reason: str) -> None:
        """Brings the arm to rest.

        Args:
            reason: Cause of the stop.
        """
        self._control.servoStop(self._deceleration)

    def recover(self) -> None:
        """Restarts the program on the controller, after a release of the stop there.

        Raises:
            RuntimeError: The program does not start.
        """
        if not self._receive.isConnected():
            self._receive.reconnect()
        if not self._control.isProgramRunning() and not self._control.reuploadScript():
            raise RuntimeError("the program on the controller does not start; is the stop released?")
