"""Waypoints of a sequence of actions: its variants are tried, each from several starts, until one is feasible."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from ._core import KOMO, Config, NLP_Solver
from .in_order import Stopped, inOrder
from .manipulation import missed
from .task_actions import TaskRule, allVariants
from .task_domain import planText
from .task_waypoints import Action, TaskWaypoints

_STARTS = 3  # of a waypoint problem, for each choice of variants
_CHOICES = 6  # of variants, at most


@dataclass
class Failure:
    """Why there are no waypoints, or no motion, and the scene at the waypoint that failed."""

    why: str
    ghost: Config | None


class TaskAttempts:
    """Finds waypoints, and counts the evaluations that it takes. Variants are tried by threads; the first in order that is
    feasible counts, whatever the number of threads."""

    def __init__(self, rules: dict[str, TaskRule], seed: int, threads: int, is_late: Callable[[], bool]) -> None:
        self.rules, self.seed, self.threads, self.is_late = rules, seed, threads, is_late
        self.evaluations = 0

    def find(self, C: Config, actions: list[Action], seed: int) -> TaskWaypoints | Failure:
        """Waypoints that satisfy all that the actions ask, or why there are none.

        Args:
            C: The scene.
            actions: Their words.
            seed: Other waypoints for each; 0: placements and grasps begin where nothing is drawn.
        """
        failure: Failure | None = None
        for found, evaluations in inOrder(self._jobs(C, actions, seed), self.threads):
            self.evaluations += evaluations
            if isinstance(found, TaskWaypoints):
                return found
            failure = failure or found
            if self.is_late():
                break
        return failure or Failure(f"{planText(actions[-1:])}: the hand cannot hold it", None)

    def _jobs(
        self, C: Config, actions: list[Action], seed: int
    ) -> Iterator[Callable[[Stopped], tuple[TaskWaypoints | Failure, int]]]:
        for index, variants in enumerate(itertools.islice(allVariants(C, actions, self.rules), _CHOICES)):
            yield partial(self._attempt, C.copy(), actions, variants, [self.seed, seed, len(actions), index])

    def _attempt(
        self, C: Config, actions: list[Action], variants: list[str], seed: list[int], stopped: Stopped
    ) -> tuple[TaskWaypoints | Failure, int]:
        """One choice of variants, from several starts; and how many evaluations that took."""
        waypoints = TaskWaypoints(C, actions, variants, self.rules)
        solver = NLP_Solver(waypoints.komo.nlp(), verbose=0)
        rng = np.random.default_rng(seed)
        failure: Failure | None = None
        evaluations = 0
        for start in range(_STARTS):
            first = start == 0  # the others go farther
            solver.setInitialization(waypoints.start(None if first and seed[1] == 0 else rng, not first))
            result = solver.solve(0)
            evaluations += result.evals
            if result.feasible:
                return waypoints, evaluations
            if failure is None:
                ghost = waypoints.komo.getConfiguration(len(actions) - 1)
                failure = Failure(_cause(waypoints.komo, actions), ghost)
            if stopped() or self.is_late():
                break
        assert failure is not None, "there is at least one start"
        return failure, evaluations


def _cause(komo: KOMO, actions: list[Action]) -> str:
    return f"{planText(actions[-1:])}: {missed(komo) or 'the waypoints miss what the actions ask'}"
