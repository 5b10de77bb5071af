"""The simulated robot."""

import importlib
from pathlib import Path
from typing import Any

import numpy as np
from lerobot.robots import Robot

import kinegraph as ry
from kinegraph.lerobot.rehearsal import stateNames, stateOf

from .config_kinegraph import KinegraphRobotConfig

CLOSED, CHANGE = 2e-3, 1e-3  # m: an opening this near to the smallest one closes the hand; smaller changes are ignored
STRETCHES = (1.0, 2.0, 4.0, 8.0)  # of look_ahead, until the limits of the robot hold


def sceneOf(text: str) -> ry.Config:
    """Makes the scene of a setting: a file, a name of raiPath, or module:function."""
    if ":" in text and not Path(text).exists():
        module, function = text.split(":")
        return getattr(importlib.import_module(module), function)()
    C = ry.Config()
    C.addFile(text if Path(text).exists() else ry.raiPath(text))
    return C


class KinegraphRobot(Robot):
    """A robot that Kinegraph simulates in real time. Positions are rad or m, openings of hands m."""

    config_class = KinegraphRobotConfig
    name = "kinegraph"
    connected: "KinegraphRobot | None" = None  # the robot that a planner moves

    def __init__(self, config: KinegraphRobotConfig):
        super().__init__(config)
        self.config = config
        self.cameras: dict[str, Any] = {}
        self.scene = sceneOf(config.scene)
        for view in config.views:
            self.scene.getFrame(view).setAttributes({"width": float(config.width), "height": float(config.height)})
        self.bot: ry.BotOp | None = None
        names = ry.BotOp(self.scene)
        self._names = stateNames(names)
        names.close()

    @property
    def action_features(self) -> dict[str, type]:
        return dict.fromkeys(self._names, float)

    @property
    def observation_features(self) -> dict[str, Any]:
        return self.action_features | dict.fromkeys(self.config.views, (self.config.height, self.config.width, 3))

    @property
    def is_connected(self) -> bool:
        return self.bot is not None

    @property
    def is_calibrated(self) -> bool:
        return True

    def connect(self, calibrate: bool = True) -> None:
        self.bot = ry.BotOp(self.scene, realtime=True, strict=False)
        self._hands = [self.bot.getGripperPos(i) for i in range(len(self.bot.getInfo().grippers))]
        KinegraphRobot.connected = self

    def calibrate(self) -> None:
        pass

    def configure(self) -> None:
        pass

    def _robot(self) -> ry.BotOp:
        if self.bot is None:
            raise ConnectionError("the robot is not connected")
        return self.bot

    def get_observation(self) -> dict[str, Any]:
        bot = self._robot()
        state = dict(zip(self._names, map(float, stateOf(bot)[0]), strict=True))
        return state | {view: bot.getImage(view) for view in self.config.views}

    def send_action(self, action: dict[str, Any]) -> dict[str, Any]:
        bot = self._robot()
        missing = [name for name in self._names if name not in action]
        if missing:
            raise ValueError(f"the action lacks '{missing[0]}'; it has {', '.join(action)}")
        command = np.array([float(action[name]) for name in self._names])
        if not np.isfinite(command).all():
            raise ValueError(f"the action is not finite: {command}")
        info, n = bot.getInfo(), len(bot.getInfo().joints)
        command[:n] = np.clip(command[:n], info.lower, info.upper)
        for stretch in STRETCHES:
            try:
                bot.move(command[None, :n], [stretch * self.config.look_ahead], True)
                break
            except ry.ArgumentError:
                continue
        for i, width in enumerate(command[n:]):
            if abs(width - self._hands[i]) > CHANGE:
                self._hands[i] = float(width)
                if width < info.grippers[i].min_width + CLOSED:
                    bot.gripperClose(i, width=float(width))
                else:
                    bot.gripperMove(i, float(width))
        return dict(zip(self._names, map(float, command), strict=True))

    def disconnect(self) -> None:
        if self.bot is not None:
            self.bot.close()
            self.bot = None
        if KinegraphRobot.connected is self:
            KinegraphRobot.connected = None
