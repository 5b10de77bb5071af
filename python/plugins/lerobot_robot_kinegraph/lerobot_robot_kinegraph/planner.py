"""The planner as a teleoperator."""

import time
from typing import Any

import numpy as np
from lerobot.teleoperators import Teleoperator

from kinegraph.lerobot import rehearse

from .config_kinegraph import KinegraphPlannerConfig
from .robot import KinegraphRobot

FPS = 100  # commands per second of the rehearsal


class KinegraphPlanner(Teleoperator):
    """Demonstrates a task: plans from the state of the connected robot, rehearses the plan, and shows it once."""

    config_class = KinegraphPlannerConfig
    name = "kinegraph_planner"

    def __init__(self, config: KinegraphPlannerConfig):
        super().__init__(config)
        self.config = config
        self._names: list[str] = []
        self._rows = np.zeros((0, 0))
        self._began: float | None = None

    @property
    def action_features(self) -> dict[str, type]:
        robot = KinegraphRobot.connected
        return {} if robot is None else robot.action_features

    @property
    def feedback_features(self) -> dict[str, type]:
        return {}

    @property
    def is_connected(self) -> bool:
        return len(self._rows) > 0

    @property
    def is_calibrated(self) -> bool:
        return True

    def connect(self, calibrate: bool = True) -> None:
        robot = KinegraphRobot.connected
        if robot is None or robot.bot is None:
            raise ConnectionError("kinegraph_planner: connect a robot of type kinegraph first")
        if not self.config.goal:
            raise ValueError('kinegraph_planner: there is no goal; expected --teleop.goal="(on tray box)"')
        self._names = list(robot.action_features)
        self._rows = rehearse(robot.bot.getWorld(), self.config.goal, FPS, self.config.seed)
        self._began = None

    def calibrate(self) -> None:
        pass

    def configure(self) -> None:
        pass

    def get_action(self) -> dict[str, Any]:
        if not self.is_connected:
            raise ConnectionError("the planner is not connected")
        now = time.monotonic()
        self._began = now if self._began is None else self._began
        row = self._rows[min(int((now - self._began) * FPS), len(self._rows) - 1)]
        return dict(zip(self._names, map(float, row), strict=True))

    def send_feedback(self, feedback: dict[str, Any]) -> None:
        pass

    def disconnect(self) -> None:
        self._rows = np.zeros((0, 0))
