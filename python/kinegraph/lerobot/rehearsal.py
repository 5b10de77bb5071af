"""The commands of a planned task, frame by frame."""

from __future__ import annotations

import contextlib

import numpy as np

from .. import _core
from .._core import BotOp, Config
from ..errors import Error


def literals(goal: str) -> list[list[str]]:
    """Splits a goal, such as "(on tray box)", into the words of its literals."""
    return [part.split() for part in goal.replace("(", " ").split(")") if part.strip()]


def sentence(goal: str) -> str:
    """Returns a goal as a sentence."""
    texts = [f"put {p[2]} on {p[1]}" if p[0] == "on" and len(p) == 3 else " ".join(p) for p in literals(goal)]
    return " and ".join(texts)


def stateNames(bot: BotOp) -> list[str]:
    """Returns the names of the entries of a state: joints, then hands."""
    info = bot.getInfo()
    return [f"{name}.pos" for name in [*info.joints, *(gripper.name for gripper in info.grippers)]]


def stateOf(bot: BotOp) -> tuple[np.ndarray, np.ndarray]:
    """Returns the state and the command of a robot: joint values (rad or m), then openings of hands (m)."""
    seen, hands = bot.stepObservation(), range(len(bot.getInfo().grippers))
    return (
        np.concatenate([seen.qpos, [bot.getGripperPos(i) for i in hands]]),
        np.concatenate([seen.qref, [bot.getGripperTarget(i) for i in hands]]),
    )


def rehearse(config: Config, goal: str, fps: int = 20, seed: int = 0) -> np.ndarray:
    """Plans a task, executes the plan in a simulation, and returns the commands.

    Args:
        config: The scene, which is not changed.
        goal: The goal of planTask: "(on tray box)".
        fps: Commands per second.
        seed: Seed of the plan.
    Returns:
        The command at each frame, (T, n): joint values (rad or m), then openings of hands (m).
    Raises:
        Error: There is no plan, or its execution fails.
    """
    plan = _core.planTask(config, goal, seed=seed, threads=1)
    if not plan.feasible:
        raise Error(f"rehearse: {plan.message}")
    bot, rows = BotOp(config.copy()), []
    bot.watch(1 / fps, lambda _: rows.append(stateOf(bot)[1]))
    with contextlib.closing(bot):
        run = plan.execute(bot, threads=1)
    if not run.feasible:
        raise Error(f"rehearse: {run.message}")
    return np.array(rows)
