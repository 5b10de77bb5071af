"""Simulated robots that slow down motions beyond their limits; the reference's simulation has no limits."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import kinegraph

_ATTEMPTS = 12  # messages about velocity and acceleration give the factor; those about effort do not
_FACTOR = 1.3


class BotOp(kinegraph.BotOp):
    """Like kinegraph.BotOp, but a simulated robot slows down a motion beyond its limits, with a warning."""

    def __init__(self, C: kinegraph.Config, useRealRobot: bool = False, *args: Any, **kwargs: Any) -> None:
        super().__init__(C, useRealRobot, *args, **kwargs)
        is_blocked = bool(kinegraph.params_get().get("bot/blockRealRobot", False))
        self._simulated = is_blocked or not (useRealRobot or len(args) > 1 or kwargs.get("driver") is not None)

    def move(self, path: ArrayLike, times: ArrayLike, overwrite: bool = False, overwriteCtrlTime: float = -1.0) -> None:
        """Moves along a path, as kinegraph.BotOp.move; in simulation as slowly as the robot's limits require.

        Args:
            path, times, overwrite, overwriteCtrlTime: As in kinegraph.BotOp.move.
        Raises:
            ArgumentError: The motion violates a limit; in simulation only if no slower motion satisfies it.
        """
        slower, text = 1.0, ""
        for attempt in range(_ATTEMPTS):
            try:
                super().move(path, np.multiply(times, slower), overwrite, overwriteCtrlTime)
                break
            except kinegraph.ArgumentError as error:
                match = re.search(r"take (?:at least ([\d.e+]+) times as long|longer)", str(error))
                if not (self._simulated and match) or attempt == _ATTEMPTS - 1:
                    raise
                slower *= 1.001 * float(match[1]) if match[1] else _FACTOR
                text = text or str(error)
        if text:
            warnings.warn(f"{text}; it takes {slower:.3g} times as long", kinegraph.KinegraphWarning, stacklevel=2)
