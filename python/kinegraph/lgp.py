"""Logic-geometric programs: a search in logic proposes plans, a motion problem says whether bodies can carry them out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from ._core import FS, KOMO, OT, Config, NLP_Solver, SolverReturn
from .errors import ArgumentError
from .in_order import Stopped, checkThreads, inOrder
from .lgp_abstraction import STEPS, Action, LGP_TAMP_Abstraction
from .lgp_waypoints import LgpWaypoints, solveFrom
from .manipulation import KOMO_ManipulationHelper
from .task_domain import planText

_MOTION_STARTS = 3


class LGP_Tool:
    """Finds plans that bodies can carry out: each plan of the abstraction becomes a waypoint problem. Beginnings that
    fail from all starts are not tried again; effort is counted in solves.

        tamp = ry.default_LGP_TAMP_Abstraction(C, "problem.lgp")
        lgp = ry.LGP_Tool(C, tamp)
        lgp.solve()
        print(lgp.getSolvedPlan())
        lgp.solveFullMotion()
    """

    _solver: type[NLP_Solver] = NLP_Solver  # robotic has its own

    def __init__(self, C: Config, tamp: LGP_TAMP_Abstraction, translator: object = None, *, threads: int = 1) -> None:
        """Makes a tool; nothing is searched yet.

        Args:
            C: The scene.
            tamp: What is asked for plans, and for what their actions ask.
            translator: Of older scripts; the abstraction does its work.
            threads: How many solve at the same time, from other starts, or the motions of other actions. What is found is
                the same, to the bit.
        Raises:
            ArgumentError: threads is less than one.
        """
        self.C, self.tamp = C, tamp
        self.status = "not started"
        self.message = ""
        self._plan: list[Action] | None = None
        self._komo: KOMO | None = None
        self._x: np.ndarray | None = None
        self._threads = checkThreads("LGP_Tool", threads)
        self._waypoints = LgpWaypoints(C, tamp, self._solver, threads)

    @property
    def solves(self) -> int:
        """How many waypoint problems were solved so far."""
        return self._waypoints.solves

    def solve(self, verbose: int = 1, maxSolves: int = 2000) -> bool:
        """Searches until a new plan with feasible waypoints is found. Repeated calls give further plans.

        Args:
            verbose: 1: a line per plan that was tried; 0: nothing.
            maxSolves: Effort: waypoint problems that are solved, at most.
        Returns:
            True if there is one; else `status` is 'proved impossible' (the logic has no plan at all) or 'not found', and
            `message` says why plans failed.
        """
        budget = self.solves + maxSolves
        while self.solves < budget:
            plan = self.tamp.getNewActionSequence()
            if plan is None:
                break
            failed = self._waypoints.failing(plan)
            if verbose > 0:
                print(f"-- {'feasible' if failed is None else 'infeasible'}: {planText(plan)}")
            if failed is None:
                self._plan, self.status, self.message = plan, "solved", ""
                self._komo, self._x = self._waypoints.komo, self._waypoints.x
                return True
            self.tamp.forbidBeginning(plan[:failed])
        self.status = "not found" if self._waypoints.causes or self.solves >= budget else "proved impossible"
        causes = sorted(self._waypoints.causes.items(), key=lambda c: -c[1])
        self.message = "; ".join(f"{cause} ({count} plans)" for cause, count in causes[:5]) or "no plan in logic"
        return False

    def getSolvedPlan(self) -> list[Action]:
        """The plan that was found last.

        Returns:
            A list of actions, each a list of words.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        return self._solved()[0]

    def getSolvedKOMO(self) -> KOMO:
        """The waypoint problem of the plan that was found last, at its solution.

        Returns:
            A KOMO with a slice per action.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        return self._solved()[1]

    def get_piecewiseMotionProblem(self, phase: int, fixEnd: bool = True) -> KOMO:
        """The motion of one action between its waypoints, with attachments as they are then.

        Args:
            phase: 0: the first action.
            fixEnd: It ends exactly at the waypoint.
        Returns:
            A KOMO with 30 slices that starts on the straight way.
        Raises:
            ArgumentError: Nothing was found yet, or there is no such action.
        """
        plan, waypoints = self._solved()
        if not 0 <= phase < len(plan):
            raise ArgumentError(f"get_piecewiseMotionProblem: phase is {phase}; the plan has {len(plan)} actions")
        C, _, q1 = waypoints.getSubProblem(phase)
        helper = KOMO_ManipulationHelper()
        helper.setup_motion(C, 1, STEPS, 1e-2)
        helper.komo.initWithWaypoints([q1], 1, True, 0.5)
        if fixEnd:
            helper.komo.addObjective([1.0], FS.jointState, [], OT.eq, [1e0], q1)
        return helper.komo

    def get_fullMotionProblem(self, initWithWaypoints: bool = True) -> KOMO:
        """The motion over all actions of the plan, 30 slices each.

        Args:
            initWithWaypoints: It starts at the waypoints; else where the scene is.
        Returns:
            A KOMO.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        plan, waypoints = self._solved()
        komo = self.tamp.setup_motion(self.C, len(plan))
        self.tamp.add_all(komo, plan, motion=True)
        if initWithWaypoints and self._x is not None:
            komo.initWithWaypoints(list(waypoints.getPath()), 1, True, 0.0)
            shared = len(self._x) - sum(len(q) for q in waypoints.getPath_qAll())
            x = np.concatenate([self._x[:shared], *komo.getPath_qAll()])
            nlp = komo.nlp()
            if len(x) == nlp.getDimension():
                nlp.evaluate(x)
        return komo

    def solvePiecewiseMotions(self, verbose: int = 1) -> list[SolverReturn]:
        """Solves the motions of all actions, one after the other.

        Args:
            verbose: 1: a line per action; 0: nothing.
        Returns:
            How each ended. The paths are in `paths`, shape (30, n) each, rad or m.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        self.paths, results = [], []
        plan = self._solved()[0]
        pieces = (self.get_piecewiseMotionProblem(phase, True) for phase in range(len(plan)))
        jobs = (partial(solveFrom, komo, None, self._solver) for komo in pieces)
        for action, (komo, result) in zip(plan, inOrder(jobs, self._threads), strict=True):
            results.append(result)
            self.paths.append(komo.getPath())
            if verbose > 0:
                print(f"-- {planText([action])}: {result.message}")
        return results

    def solveFullMotion(self, verbose: int = 1) -> SolverReturn:
        """Solves the motion over all actions, from the waypoints.

        Args:
            verbose: 1: a line says how it ended; 0: nothing.
        Returns:
            How it ended. The path is in `path`, shape (T, n), rad or m.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        for tried in inOrder(self._full_motions(), self._threads):
            if tried[1].feasible:
                break
        self.motion, result = tried
        self.path = self.motion.getPath()
        if verbose > 0:
            print(f"-- full motion: {result.message}")
        return result

    def _full_motions(self) -> Iterator[Callable[[Stopped], tuple[KOMO, SolverReturn]]]:
        """The motion over all actions, from the waypoints, and from near them."""
        rng = np.random.default_rng(0)
        for start in range(_MOTION_STARTS):
            helper = KOMO_ManipulationHelper()
            helper.komo = self.get_fullMotionProblem(True)
            x = helper.x + 0.02 * start * rng.standard_normal(len(helper.x))
            yield partial(solveFrom, helper.komo, x, self._solver)

    def view_solved(self, pause: bool = True) -> int:
        """Shows the waypoints.

        Args:
            pause: Waits for a key.
        Returns:
            The key, or 0.
        Raises:
            ArgumentError: Nothing was found yet.
        """
        return int(self._solved()[1].view(pause, planText(self._solved()[0])) or 0)

    def view_close(self) -> None:
        """Closes the viewer of the waypoints."""
        if self._komo is not None:
            self._komo.view_close()

    def _solved(self) -> tuple[list[Action], KOMO]:
        if self._plan is None or self._komo is None:
            raise ArgumentError("LGP_Tool: no plan was found yet; call solve")
        return self._plan, self._komo
