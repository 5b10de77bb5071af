"""A scene, a motion in it, and its recording."""

from pathlib import Path
from typing import Any

import numpy as np

import kinegraph as ry

ARM = "scenarios/pandaSingle.g"


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath(ARM))
    box = C.addFrame("box", "table").setRelativePosition([0.2, 0.25, 0.09])
    box.setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004]).setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    return C


def wave(bot: ry.BotOp, C: ry.Config) -> None:
    """Moves the first joint and the fingers."""
    bot.moveTo(np.add(bot.get_q(), [0.2, 0, 0, 0, 0, 0, 0]))
    bot.gripperMove(0, 0.03)
    bot.wait(C)


def recorded(path: Path, **settings: Any) -> tuple[ry.Config, ry.BotOp]:
    C = scene()
    bot = ry.BotOp(C)
    bot.recordTo(path, **settings)
    wave(bot, C)
    bot.recordTo("")
    return C, bot
