"""Methods of BotOp by their earlier names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._core import BotOp
from ..errors import NotFound

if TYPE_CHECKING:  # numpy.typing takes half a millisecond
    from numpy.typing import ArrayLike, NDArray

_hold = BotOp.hold


def hold(self: BotOp, floating: bool = False, damping: bool = True) -> None:
    """Stops at once and holds the position stiffly, also with a robot in compliant mode; or lets the robot float.

    Args:
        floating: Let the robot float, like floating().
        damping: With floating: use the robot's full damping; otherwise none.
    Raises:
        RobotFault: floating is set, but the robot is always stiff.
    """
    if floating:
        self.floating(1.0 if damping else 0.0)
    else:
        _hold(self)


def gripperOpen(self: BotOp, id: int, width: float = 0.075, speed: float = 0.2) -> None:
    """Opens a gripper, like gripperMove.

    Args:
        id: Index of the gripper: 0, 1, ... or ArgWord._left, ArgWord._right.
        width: Width of the opening, m.
        speed: Speed of the opening, m/s.
    Raises:
        ArgumentError: There is no such gripper, or a number is out of range.
    """
    self.gripperMove(id, width, speed)


def getCameraFxypxy(self: BotOp, sensorName: str) -> NDArray[Any]:
    """Returns fx, fy, cx, cy of a camera in pixels, like getCameraFxycxy.

    Args:
        sensorName: A frame with camera attributes.
    Returns:
        Shape (4,).
    Raises:
        FrameNotFound: There is no such frame.
    """
    return self.getCameraFxycxy(sensorName)


def cheat_setFramePose(self: BotOp, name: str, pose: ArrayLike) -> None:
    """Sets the pose of a frame in the simulated world, like setFramePose.

    Args:
        name: Name of the frame.
        pose: (7,) x y z in m, qw qx qy qz.
    Raises:
        FrameNotFound: There is no such frame.
        ArgumentError: The pose is invalid.
    """
    self.setFramePose(name, pose)


def setControllerWriteData(self: BotOp, _n: int) -> None:
    """Starts to write a row per period to the file z.control.dat, like recordTo.

    Args:
        _n: 0 ends the recording.
    Raises:
        FileError: The file cannot be written.
    """
    self.recordTo("z.control.dat" if _n > 0 else "")


def sound(self: BotOp, noteRelToC: int = 0, a: float = 0.5, decay: float = 0.0007) -> None:
    """Does nothing: there is no sound, like in the reference without an audio device.

    Args:
        noteRelToC, a, decay: Not used.
    """


def launch_camera(self: BotOp, sensor: str) -> None:
    """Checks that a camera exists; cameras need not be launched.

    Args:
        sensor: A frame.
    Raises:
        FrameNotFound: There is no such frame.
    """
    self.getCameraFxycxy(sensor)


def _refused(name: str) -> Any:
    def launch(self: BotOp, *arguments: Any) -> None:
        raise NotFound(
            f"BotOp.{name}: pass a driver of the hardware to BotOp(C, True, driver=...); see kinegraph.robots"
        )

    launch.__name__ = name
    launch.__doc__ = """Always raises NotFound: pass drivers of hardware to BotOp(C, True, driver=...).

    Args:
        arguments: Not used.
    Raises:
        NotFound: Always.
    """
    return launch


METHODS = [hold, gripperOpen, getCameraFxypxy, cheat_setFramePose, setControllerWriteData, sound, launch_camera]
METHODS += [
    _refused(f"launch_{what}")
    for what in ("simulation", "robots", "franka", "trossen", "baslers", "arucos", "arucoObjTracker")
]
