"""A simulated robot and a planner for LeRobot, found by the name of this distribution."""

from .config_kinegraph import KinegraphPlannerConfig, KinegraphRobotConfig
from .planner import KinegraphPlanner
from .robot import KinegraphRobot

__all__ = ["KinegraphPlanner", "KinegraphPlannerConfig", "KinegraphRobot", "KinegraphRobotConfig"]
