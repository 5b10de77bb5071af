"""Drivers of robots that are there, for BotOp(C, True, driver=...).

They were tried against stand-ins that speak the same calls, and *not* on hardware: stand beside the emergency stop.
What they need from the vendors' packages is imported when they connect.
"""

from .franka import FrankaDriver
from .ur import UrDriver

__all__ = ["FrankaDriver", "UrDriver"]
