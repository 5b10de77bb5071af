"""Waypoint problems of plans in logic: which beginnings of a plan bodies can carry out, and why others fail."""

from __future__ import annotations

import copy
from functools import partial

import numpy as np

from ._core import KOMO, Config, NLP_Solver, SolverReturn
from .in_order import Stopped, inOrder
from .lgp_abstraction import Action, LGP_TAMP_Abstraction
from .manipulation import KOMO_ManipulationHelper, missed
from .task_domain import planText

_STARTS = 4  # of a waypoint problem before another plan is tried
_NOISE = 0.3


class LgpWaypoints:
    """Solves the waypoint problems of plans, and remembers which could be solved. `komo` and `x` are the last solved one
    and its variables, `solves` counts starts, `causes` says why problems failed, and how often."""

    def __init__(self, C: Config, tamp: LGP_TAMP_Abstraction, solver: type[NLP_Solver], threads: int) -> None:
        self.C, self.tamp, self.solver, self.threads = C, tamp, solver, threads
        self.solves = 0
        self.causes: dict[str, int] = {}
        self.komo: KOMO | None = None
        self.x: np.ndarray | None = None
        self._known: dict[tuple[tuple[str, ...], ...], bool] = {}

    def failing(self, plan: list[Action]) -> int | None:
        """How many of the first actions cannot be carried out together; None if all can."""
        if self._feasible(plan):
            return None
        return next((count for count in range(1, len(plan)) if not self._feasible(plan[:count])), len(plan))

    def _feasible(self, plan: list[Action]) -> bool:
        key = tuple(map(tuple, plan))
        if key not in self._known:
            self._known[key] = self._solve(plan)
        return self._known[key]

    def _solve(self, plan: list[Action]) -> bool:
        komo = self.tamp.setup_sequence(self.C, len(plan))
        self.tamp.add_all(komo, plan, motion=False)
        nlp = komo.nlp()
        rng = np.random.default_rng(0)
        helper = KOMO_ManipulationHelper()
        helper.komo = komo
        x0 = helper.x
        lower, upper = np.asarray(nlp.getBounds())
        bounded = lower < upper
        starts = [x0 + _NOISE * start * rng.standard_normal(len(x0)) for start in range(_STARTS)]
        for x in starts:
            x[bounded] = np.clip(x, lower, upper)[bounded]
        each = [komo if self.threads == 1 else copy.copy(komo) for _ in starts]
        jobs = [partial(solveFrom, one, x, self.solver) for one, x in zip(each, starts, strict=True)]
        for tried, result in inOrder(jobs, self.threads):
            self.solves += 1
            if result.feasible:
                self.komo, self.x = tried, np.array(result.x)
                return True
        said = f"{planText(plan[-1:])}: {missed(tried) or result.message}"
        self.causes[said] = self.causes.get(said, 0) + 1
        return False


def solveFrom(
    komo: KOMO, x: np.ndarray | None, solver: type[NLP_Solver], _stopped: Stopped
) -> tuple[KOMO, SolverReturn]:
    """Solves a problem from a start, or from where it is; a job of inOrder. The KOMO is left at the solution."""
    one = solver(komo.nlp(), verbose=0)
    if x is not None:
        one.setInitialization(x)
    return komo, one.solve(0)
