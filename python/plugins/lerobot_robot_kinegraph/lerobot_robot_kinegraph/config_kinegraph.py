"""Settings of the robot and of the planner."""

from dataclasses import dataclass, field

from lerobot.cameras import CameraConfig
from lerobot.robots import RobotConfig
from lerobot.teleoperators import TeleoperatorConfig


@RobotConfig.register_subclass("kinegraph")
@dataclass
class KinegraphRobotConfig(RobotConfig):
    """A simulated robot.

    Attributes:
        scene: A scene file, a name of `raiPath`, or `module:function`, a function that makes a Config.
        views: Frames of cameras of the scene.
        width, height: Size of their images, pixels.
        look_ahead: Time in which an action is reached, s; about two frames.
        cameras: Not used; LeRobot expects it.
    """

    scene: str = "scenarios/pandaSingle.g"
    views: list[str] = field(default_factory=list)
    width: int = 128
    height: int = 128
    look_ahead: float = 0.1
    cameras: dict[str, CameraConfig] = field(default_factory=dict)


@TeleoperatorConfig.register_subclass("kinegraph_planner")
@dataclass
class KinegraphPlannerConfig(TeleoperatorConfig):
    """A planner that moves the connected robot `kinegraph`.

    Attributes:
        goal: The goal of planTask: "(on tray box)".
        seed: Seed of the plan.
    """

    goal: str = ""
    seed: int = 0
