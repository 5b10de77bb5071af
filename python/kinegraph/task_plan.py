"""What planTask answers: a plan with its timed motion, or why there is none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._core import BotOp, Config, TaskExecution, executeTask, failedConfiguration, showTask, taskFrames, treeText
from .errors import ArgumentError

Action = list[str]


@dataclass
class Branch:
    """A sequence of actions that was tried, and why it was given up; '' where it was not. ghost: the scene at the waypoint
    that it failed at, as near to what the last action asks as was found."""

    actions: list[Action]
    why: str
    ghost: Config | None = None


@dataclass
class TaskPlan:
    """What planTask found, or why it found nothing.

    status: 'solved', 'proved impossible' (no motion can do it; says why) or 'not found' (within the effort).
    actions: each a list of words. waypoints: q after each action, shape (K, n). path: shape (T, n), rad or m, at `times`,
    shape (T,), s; between two rows the motion is straight. `segments[i]` are the rows of action i; the motion is at rest
    where one begins. limits: velocities and accelerations that it keeps, shape (2, n). causes: why branches were given
    up, the most frequent first. tree: all branches.
    start: what holds at first. scenes: the scene of each action, with what is held attached.
    """

    status: str
    message: str
    actions: list[Action] = field(default_factory=list)
    waypoints: np.ndarray | None = None
    path: np.ndarray | None = None
    times: np.ndarray | None = None
    limits: np.ndarray | None = None
    segments: list[slice] = field(default_factory=list)
    causes: list[tuple[str, int]] = field(default_factory=list)
    tree: list[Branch] = field(default_factory=list)
    violations: list[str] = field(default_factory=list)
    evaluations: int = 0
    expansions: int = 0
    attachments: list[tuple[str, str]] = field(default_factory=list)
    scenes: list[Config] = field(default_factory=list)
    goal: list[str] = field(default_factory=list)
    start: list[str] = field(default_factory=list)
    again: Callable[[Config], TaskPlan] | None = None

    @property
    def feasible(self) -> bool:
        """Whether there is a plan whose motion passed the checker."""
        return self.status == "solved"

    @property
    def duration(self) -> float:
        """Of the motion, s, without the time that grippers take; 0 without a motion."""
        return 0.0 if self.times is None or len(self.times) == 0 else float(self.times[-1])

    def __str__(self) -> str:
        lines = [f"{self.status}: {self.message}"]
        lines += [f"  {i + 1}. ({' '.join(action)})" for i, action in enumerate(self.actions)]
        lines += [f"  {count} x {cause}" for cause, count in self.causes[:8]]
        return "\n".join(lines)

    def at(self, t: float) -> np.ndarray:
        """Where the motion is.

        Args:
            t: s, held within 0 and duration.
        Returns:
            Joint values, shape (n,), rad or m.
        Raises:
            ArgumentError: There is no motion.
        """
        path, times = self._motion("at")
        return np.array([np.interp(t, times, column) for column in path.T])

    def why(self) -> str:
        """Why there is no plan, or what stood in the way of others: causes, the most frequent first.

        Returns:
            A line per cause.
        """
        return "\n".join(f"{cause} ({count} branches)" for cause, count in self.causes) or self.message

    def searchTree(self) -> str:
        """What was tried, as a tree: branches with common beginnings, and why each was given up.

        Returns:
            A line per action.
        """
        return treeText([(branch.actions, branch.why) for branch in self.tree])

    def view(self, C: Config, pause: bool = True) -> int:
        """Shows a plan: its motion; or, where there is none, the tree of the search and a red ghost of what the farthest
        branch failed at.

        Args:
            C: The scene that was planned in; it ends as it was.
            pause: Waits for a key.
        Returns:
            The key, or 0.
        Raises:
            ArgumentError: There is neither a motion nor a waypoint that failed; the message says what was proved.
        """
        if self.path is not None:
            before = C.getFrameState()
            self.play(C)
            key = C.view(pause, str(self))
            C.setFrameState(before)
            return int(key or 0)
        return int(failedConfiguration(self, C).view(pause, f"{self.message}\n{self.searchTree()}") or 0)

    def play(self, C: Config, pause: bool = False) -> None:
        """Shows the motion of each action in the viewer, with what is held moving along.

        Args:
            C: A scene whose viewer shows it; it ends as after the plan.
            pause: Waits for a key before each action.
        Raises:
            ArgumentError: There is no motion.
        """
        path, _ = self._motion("play")
        for action, rows, scene in zip(self.actions, self.segments, self.scenes, strict=True):
            if pause:
                C.view(True, f"({' '.join(action)})")
            for q in path[rows]:
                showTask(C, scene, q)
                C.view(False, f"({' '.join(action)})")

    def frames(self, C: Config, rate: float = 25.0) -> np.ndarray:
        """Where all frames are at equal steps of time, for saveFilm(file, C, plan.frames(C), plan.duration).

        Args:
            C: The scene that was planned in; it is not changed.
            rate: Steps per second.
        Returns:
            Poses, shape (T, frames, 7).
        Raises:
            ArgumentError: There is no motion.
        """
        self._motion("frames")
        return taskFrames(self, C, rate)

    def execute(self, bot: Any) -> TaskExecution:
        """Moves a robot along the plan, action by action: grippers take and release, and after each motion it is looked at
        whether what is held is in the hand, and whether all else is where the plan has it.

        Args:
            bot: A BotOp whose world is the scene of the plan. What is moved needs a mass there.
        Returns:
            How far it came, and why it stopped; `C` is the scene as it was then, for repair.
        Raises:
            ArgumentError: There is no motion, `bot` is no BotOp, or the robot cannot begin it.
            RobotFault: The robot was stopped.
        """
        if not isinstance(bot, BotOp):
            made = "; make one by BotOp(C)" if isinstance(bot, Config) else ""
            raise ArgumentError(f"execute: expected a BotOp, got {type(bot).__name__}{made}")
        return executeTask(self, bot)

    def repair(self, C: Config) -> TaskPlan:
        """Plans what is left to do after an execution stopped: to the same goal, from a scene as it is now.

        Args:
            C: The scene as it is: that of the execution, or as it was seen. What is held hangs below the hand, what stands
                on something below that.
        Returns:
            A TaskPlan; not finding one is no error.
        Raises:
            ArgumentError: The plan was not made by planTask.
        """
        if self.again is None:
            raise ArgumentError("repair: this plan was not made by planTask, and has no goal to go on to")
        return self.again(C)

    def _motion(self, call: str) -> tuple[np.ndarray, np.ndarray]:
        if self.path is None or self.times is None:
            raise ArgumentError(f"{call}: there is no motion; {self.message}")
        return self.path, self.times


TaskPlan.__init__.__doc__ = "Initialize self: planTask does."
