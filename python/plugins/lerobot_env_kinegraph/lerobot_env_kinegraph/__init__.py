"""Tasks of Kinegraph as environments for the evaluation of LeRobot's policies."""

import importlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import gymnasium
from lerobot.configs.types import FeatureType, PolicyFeature
from lerobot.envs.configs import EnvConfig

import kinegraph as ry
from kinegraph.task_env import TaskEnv

__all__ = ["KinegraphEnv", "make_env"]
ID = "lerobot_env_kinegraph/Task-v0"


def makeTask(scene: str, goal: str, **settings: Any) -> TaskEnv:
    """Makes the environment of a scene: a file, a name of raiPath, or module:function of a random generator."""
    if ":" in scene and not Path(scene).exists():
        module, function = scene.split(":")
        return TaskEnv(getattr(importlib.import_module(module), function), goal, **settings)
    C = ry.Config()
    C.addFile(scene if Path(scene).exists() else ry.raiPath(scene))
    return TaskEnv(C, goal, **settings)


gymnasium.register(ID, entry_point=makeTask)


@EnvConfig.register_subclass("kinegraph")
@dataclass
class KinegraphEnv(EnvConfig):
    """A task.

    Attributes:
        scene: A scene file, a name of `raiPath`, or `module:function`, a function of a random generator.
        goal: The goal: "(on tray box)".
        cameras: Frames of the cameras.
        size: Height and width of images, pixels.
        episode_length: Frames after which an episode ends.
    """

    task: str | None = "Task-v0"
    fps: int = 20
    scene: str = "scenarios/pandaSingle.g"
    goal: str = ""
    cameras: list[str] = field(default_factory=list)
    size: int = 128
    episode_length: int = 400

    def __post_init__(self) -> None:
        env = makeTask(self.scene, self.goal, **self.gym_kwargs_of_task)
        n = len(env.names)
        env.close()
        self.features = {
            "action": PolicyFeature(FeatureType.ACTION, (n,)),
            "agent_pos": PolicyFeature(FeatureType.STATE, (n,)),
        }
        self.features_map = {"action": "action", "agent_pos": "observation.state"}
        for camera in self.cameras:
            key = f"pixels/{camera}"
            self.features[key] = PolicyFeature(FeatureType.VISUAL, (self.size, self.size, 3))
            self.features_map[key] = f"observation.images.{camera}"

    @property
    def package_name(self) -> str:
        return "lerobot_env_kinegraph"

    @property
    def gym_id(self) -> str:
        return ID

    @property
    def gym_kwargs_of_task(self) -> dict[str, Any]:
        """The arguments of TaskEnv."""
        return {
            "cameras": self.cameras,
            "size": self.size,
            "fps": self.fps,
            "max_episode_steps": self.episode_length,
        }

    @property
    def gym_kwargs(self) -> dict[str, Any]:
        return {"scene": self.scene, "goal": self.goal, **self.gym_kwargs_of_task}


def make_env(n_envs: int = 1, use_async_envs: bool = False, cfg: KinegraphEnv | None = None) -> Any:
    """Makes a vector of environments, as LeRobot's hub asks for.

    Args:
        n_envs: Number of environments.
        use_async_envs: Whether each one has a process of its own.
        cfg: The task.
    Returns:
        {suite: {task number: vector environment}}
    """
    if cfg is None:
        raise ValueError("make_env: there is no task; expected cfg=KinegraphEnv(scene=..., goal=...)")
    from lerobot.envs.factory import make_env as make

    return make(cfg, n_envs=n_envs, use_async_envs=use_async_envs)
