"""Simulated robots without limits, as in the reference: its simulation neither slows down nor stops a robot."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import kinegraph


class BotOp(kinegraph.BotOp):
    """Like kinegraph.BotOp, but a simulated robot keeps the times of motions, and an obstacle does not stop it.

    A motion beyond the robot's limits, and a joint that lags behind its command, give a warning instead of an error.
    """

    def __init__(self, C: kinegraph.Config, useRealRobot: bool = False, *args: Any, **kwargs: Any) -> None:
        is_blocked = bool(kinegraph.params_get().get("bot/blockRealRobot", False))
        self._simulated = is_blocked or not (useRealRobot or len(args) > 1 or kwargs.get("driver") is not None)
        super().__init__(C, useRealRobot, *args, **{"strict": not self._simulated, **kwargs})

    def move(self, path: ArrayLike, times: ArrayLike, overwrite: bool = False, overwriteCtrlTime: float = -1.0) -> None:
        """Moves along a path, as kinegraph.BotOp.move; in simulation also beyond the robot's limits.

        Args:
            path, times, overwrite, overwriteCtrlTime: As in kinegraph.BotOp.move.
        Raises:
            ArgumentError: A real robot would exceed a limit; a size is wrong.
        """
        try:
            super().move(path, times, overwrite, overwriteCtrlTime)
        except kinegraph.ArgumentError as error:
            is_too_fast = "take at least" in str(error) or "take longer" in str(error)
            if not (self._simulated and is_too_fast):
                raise
            warnings.warn(
                f"{error}; the simulated robot moves in the given time, and its limits are not kept from now on",
                kinegraph.KinegraphWarning,
                stacklevel=2,
            )
            self.setLimits(velocity=np.inf, acceleration=np.inf, effort=np.inf)
            super().move(path, times, overwrite, overwriteCtrlTime)

    def sync(self, C: kinegraph.Config, waitTime: float = 0.1, viewMsg: str = "") -> int:
        """Shows the scene and waits, as kinegraph.BotOp.sync; a negative time does not wait.

        Args:
            C, waitTime, viewMsg: As in kinegraph.BotOp.sync.
        Returns:
            The key that was pressed, or 0.
        Raises:
            RobotFault: A real robot was stopped.
        """
        key = super().sync(C, max(0.0, waitTime), viewMsg)
        self._warn()
        return key

    def wait(self, C: kinegraph.Config, *args: Any, **kwargs: Any) -> int:
        """Waits for the end of the motion or for a key, as kinegraph.BotOp.wait.

        Args:
            C, args, kwargs: As in kinegraph.BotOp.wait.
        Returns:
            The key that was pressed, or 0.
        Raises:
            RobotFault: A real robot was stopped.
        """
        key = super().wait(C, *args, **kwargs)
        self._warn()
        return key

    def _warn(self) -> None:
        if warning := self.takeWarning():
            warnings.warn(f"BotOp: {warning}", kinegraph.KinegraphWarning, stacklevel=3)
