"""The joints of a scene that a driver moves."""

from __future__ import annotations

from .._core import Config, RobotInfo
from ..errors import ArgumentError

_COUNTS = {6: "six", 7: "seven"}


def armInfo(driver: str, config: Config, name: str, count: int) -> RobotInfo:
    """Returns the joints of a scene with their limits.

    Args:
        driver: The class that asks.
        config: The scene.
        name: Name of the robot.
        count: Number of joints of the arm.
    Raises:
        ArgumentError: The scene has another number of joints.
    """
    info = RobotInfo.of(config, name)
    if len(info.joints) != count:
        raise ArgumentError(
            f"{driver}: q of the scene has {len(info.joints)} joints ({', '.join(info.joints)}); expected the "
            f"{_COUNTS[count]} of the arm; C.selectJoints makes the others inactive"
        )
    return info
