"""Robots that go on where a motion is too fast for them, as the reference's simulation does, which knows no limits."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import kinegraph

_TRIES = 12  # those of velocity and acceleration say how much longer; those of effort do not
_LONGER = 1.3


class BotOp(kinegraph.BotOp):
    """As kinegraph.BotOp. Where a motion would be too fast, a simulated robot takes longer, and a warning says so."""

    def __init__(self, C: kinegraph.Config, useRealRobot: bool = False, *args: Any, **kwargs: Any) -> None:
        super().__init__(C, useRealRobot, *args, **kwargs)
        is_blocked = bool(kinegraph.params_get().get("bot/blockRealRobot", False))
        self._simulated = is_blocked or not (useRealRobot or len(args) > 1 or kwargs.get("driver") is not None)

    def move(self, path: ArrayLike, times: ArrayLike, overwrite: bool = False, overwriteCtrlTime: float = -1.0) -> None:
        """Goes along a path, as kinegraph.BotOp.move; in simulation as slowly as the robot's limits ask for.

        Args:
            path, times, overwrite, overwriteCtrlTime: As there.
        Raises:
            ArgumentError: A limit that no more time helps with, or, on a real robot, any.
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
