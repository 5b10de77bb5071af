"""From a goal to a motion: which object, with which hand, how grasped, where put down, along which path."""

from ._core import planTask, planTasks

__all__ = ["planTask", "planTasks"]
