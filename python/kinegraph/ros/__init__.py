"""ROS 2: a robot of Kinegraph as one of ros2_control, and a robot of ros2_control as a RobotDriver.

rclpy comes with an installed ROS 2 (`source /opt/ros/DISTRO/setup.bash`); this package imports it on first use.
"""

from .bridge import RosBridge
from .driver import RosDriver, RosGripper
from .points import jointTrajectory, throughPoints

__all__ = ["RosBridge", "RosDriver", "RosGripper", "jointTrajectory", "throughPoints"]
