"""Methods of BotOp by their earlier names."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike, NDArray

from .._core import BotOp
from ..errors import NotFound

_hold = BotOp.hold


def hold(self: BotOp, floating: bool = False, damping: bool = True) -> None:
    """Comes to rest at once and stays, stiff; or lets go. Makes a compliant robot stiff again.

    Args:
        floating: Let go instead, as floating().
        damping: If floating: with all of the robot's damping, else with none.
    Raises:
        RobotFault: floating, and the robot is always stiff.
    """
    if floating:
        self.floating(1.0 if damping else 0.0)
    else:
        _hold(self)


def gripperOpen(self: BotOp, id: int, width: float = 0.075, speed: float = 0.2) -> None:
    """Opens a gripper, as gripperMove.

    Args:
        id: Which one: 0, 1, ... or ArgWord._left, ArgWord._right.
        width: Of the opening, m.
        speed: Of the width, m/s.
    Raises:
        ArgumentError: There is no such gripper, or a number makes no sense.
    """
    self.gripperMove(id, width, speed)


def getCameraFxypxy(self: BotOp, sensorName: str) -> NDArray[Any]:
    """fx, fy, cx, cy of a camera in pixels, as getCameraFxycxy.

    Args:
        sensorName: A frame; its attributes say which camera it is.
    Returns:
        Shape (4,).
    Raises:
        FrameNotFound: There is no such frame.
    """
    return self.getCameraFxycxy(sensorName)


def cheat_setFramePose(self: BotOp, name: str, pose: ArrayLike) -> None:
    """Puts a thing of the simulated world somewhere, as setFramePose.

    Args:
        name: Its name.
        pose: (7,) x y z in m, qw qx qy qz.
    Raises:
        FrameNotFound: There is no such frame.
        ArgumentError: It is no pose.
    """
    self.setFramePose(name, pose)


def setControllerWriteData(self: BotOp, _n: int) -> None:
    """Writes a row per period into the file z.control.dat from now on, as recordTo.

    Args:
        _n: 0 writes none from now on.
    Raises:
        FileError: The file cannot be written.
    """
    self.recordTo("z.control.dat" if _n > 0 else "")


def sound(self: BotOp, noteRelToC: int = 0, a: float = 0.5, decay: float = 0.0007) -> None:
    """Nothing: there is no sound, as there is none in the reference without an audio device.

    Args:
        noteRelToC, a, decay: Without meaning.
    """


def launch_camera(self: BotOp, sensor: str) -> None:
    """Looks whether there is such a camera; they need no launching.

    Args:
        sensor: A frame.
    Raises:
        FrameNotFound: There is no such frame.
    """
    self.getCameraFxycxy(sensor)


def _refused(name: str) -> Any:
    def launch(self: BotOp, *arguments: Any) -> None:
        raise NotFound(
            f"BotOp.{name}: give a driver of the hardware to BotOp(C, True, driver=...); see kinegraph.robots"
        )

    launch.__name__ = name
    launch.__doc__ = """Refused: drivers of hardware are given to BotOp(C, True, driver=...).

    Args:
        arguments: Without meaning.
    Raises:
        NotFound: Always.
    """
    return launch


METHODS = [hold, gripperOpen, getCameraFxypxy, cheat_setFramePose, setControllerWriteData, sound, launch_camera]
METHODS += [
    _refused(f"launch_{what}")
    for what in ("simulation", "robots", "franka", "trossen", "baslers", "arucos", "arucoObjTracker")
]
