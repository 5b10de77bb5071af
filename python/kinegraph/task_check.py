"""An independent judge of plans: it knows the scene, the actions and the motion, and nothing of how they were found."""

from ._core import checkTaskPlan, cornersOf

__all__ = ["checkTaskPlan", "cornersOf"]
