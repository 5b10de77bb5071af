"""Simulated robots that slow down motions beyond their limits; the reference's simulation has no limits."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import kinegraph

_TRIES = 12  # messages about velocity and acceleration give the factor; those about effort do not
_LONGER = 1.3


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
        slower, said = 1.0, ""
        for tried in range(_TRIES):
            try:
                super().move(path, np.multiply(times, slower), overwrite, overwriteCtrlTime)
                break
            except kinegraph.ArgumentError as error:
                least = re.search(r"take (?:at least ([\d.e+]+) times as long|longer)", str(error))
                if not (self._simulated and least) or tried == _TRIES - 1:
                    raise
                slower *= 1.001 * float(least[1]) if least[1] else _LONGER
                said = said or str(error)
        if said:
            warnings.warn(f"{said}; it takes {slower:.3g} times as long", kinegraph.KinegraphWarning, stacklevel=2)
