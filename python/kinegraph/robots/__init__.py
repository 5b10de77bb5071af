"""Drivers of real robots, for BotOp(C, True, driver=...).

The drivers are tested against stand-ins for the vendors' packages, and *not* on hardware: keep the emergency stop at
hand. They import the vendors' packages when they connect.
"""

from .franka import FrankaDriver
from .lerobot import LeRobotDriver
from .panda import PandaDriver
from .tool_control import ToolControl
from .trossen import TrossenDriver
from .ur import UrDriver

__all__ = ["FrankaDriver", "LeRobotDriver", "PandaDriver", "ToolControl", "TrossenDriver", "UrDriver"]
