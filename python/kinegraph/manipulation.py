"""Manipulation problems in a few calls."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from ._core import Config, ManipulationHelper, NLP_Solver, RRT_PathFinder, SolverReturn
from .errors import ArgumentError
from .log_messages import emit

_OPTIONS = {"damping": 1e-1, "stopTolerance": 1e-3, "lambdaMax": 100.0, "stopInners": 20, "stopEvals": 200}


class KOMO_ManipulationHelper(ManipulationHelper):
    """Builds manipulation problems in a few calls: a setup, then grasps, placements and motions, then solve.

    komo: the KOMO, None before a setup. ret: the result of the last solve, or None. path: shape (T, n), rad or m, if it
    was feasible, else None.

        m = ry.KOMO_ManipulationHelper()
        m.setup_pick_and_place_waypoints(C, "l_gripper", "box")
        m.grasp_box(1.0, "l_gripper", "box", "l_palm", "x")
        m.place_box(2.0, "box", "table", "l_palm", "z")
        m.solve()
        if m.feasible:
            motion = m.sub_motion(0)
    """

    ret: SolverReturn | None
    path: np.ndarray | None
    _solver: type[NLP_Solver] = NLP_Solver  # robotic has its own
    _finder: type[RRT_PathFinder] = RRT_PathFinder

    def __init__(self, info: str = "") -> None:
        """Makes a helper without a problem.

        Args:
            info: Name of the problem in the output of solve.
        """
        super().__init__()
        self.info = info
        """A name for messages."""
        self.ret = None
        """The SolverReturn of the last solve; None before."""
        self.path = None
        """The path of the last solve, (T, n); None if it is not feasible."""

    _begin = __init__

    @property
    def feasible(self) -> bool:
        """Whether the last solve was feasible."""
        return bool(self.ret is not None and self.ret.feasible)

    def solve(self, verbose: int = 1) -> SolverReturn:
        """Solves the problem from the current path of its KOMO.

        Args:
            verbose: 1: logs the result in a line; more: the lines of the solver, too; 0: nothing.
        Returns:
            The result. The path is in `path` if it is feasible.
        Raises:
            ArgumentError: There is no problem yet.
        """
        komo = self._problem("solve")
        solver = self._solver(komo.nlp(), verbose=max(verbose - 1, 0))
        solver.setOptions(**_OPTIONS)
        self.ret = solver.solve(0, max(verbose - 1, 0))
        self.path = komo.getPath() if self.ret.feasible else None
        if verbose > 0:
            said = "feasible" if self.ret.feasible else "infeasible"
            emit(False, f"  -- {said}: {self.info}{': ' if self.info else ''}{self.ret.message}")
        return self.ret

    def sub_motion(
        self,
        phase: int,
        fixEnd: bool = True,
        homing_scale: float = 1e-2,
        acceleration_scale: float = 1e-1,
        accumulated_collisions: bool = True,
        quaternion_norms: bool = False,
        joint_limits: bool = True,
    ) -> KOMO_ManipulationHelper:
        """Makes the motion problem of one phase of a solved sequence, between its waypoints, with the attachments of
        that time.

        Args:
            phase: 0: to the first waypoint.
            fixEnd: The motion ends exactly at the waypoint; else it is only initialized by interpolation.
            homing_scale: Weight of the distance from home; 0: none.
            acceleration_scale: Weight of accelerations.
            accumulated_collisions: Forbids overlaps in all slices.
            quaternion_norms: Quaternions have norm one.
            joint_limits: Joints stay within their limits.
        Returns:
            A helper with the motion, to which constraints can be added before it is solved.
        Raises:
            ArgumentError: The phase is out of range, or the problem is no sequence.
        """
        C, _, q1 = self._problem("sub_motion").getSubProblem(phase)
        motion = type(self).__new__(type(self))  # constructors of derived classes may take other arguments
        motion.__dict__.update(self.__dict__)
        motion._begin(f"sub_motion {phase}" + (f" of {self.info}" if self.info else ""))
        scales = (homing_scale, acceleration_scale, accumulated_collisions, joint_limits, quaternion_norms)
        if fixEnd:
            motion.setup_point_to_point_motion(C, q1, *scales)
        else:
            motion.setup_motion(C, 1, 50, *scales)
            motion.komo.initWithWaypoints([q1], 1, True, 0.5)
        return motion

    def sub_rrt(self, phase: int, explicitCollisionPairs: list[str] | None = None) -> Any:
        """Makes a path finder for one phase of a solved sequence, between its waypoints.

        Args:
            phase: 0: to the first waypoint.
            explicitCollisionPairs: Pairs of names: only these collide. None or empty: all collidable pairs.
        Returns:
            An RRT_PathFinder with the problem.
        Raises:
            ArgumentError: The phase is out of range, or the problem is no sequence.
        """
        C, q0, q1 = self._problem("sub_rrt").getSubProblem(phase)
        finder = self._finder()
        finder.setProblem(C)
        finder.setStartGoal([q0], [q1])
        if explicitCollisionPairs:
            finder.setExplicitCollisionPairs(explicitCollisionPairs)
        return finder

    def play(self, C: Config, duration: float = 1.0, savePngs: bool = False) -> None:
        """Moves a scene along the path and shows it.

        Args:
            C: The scene; it ends at the last slice.
            duration: Of the whole path, s.
            savePngs: Writes each picture, as C.view_savePng.
        Raises:
            ArgumentError: There is no feasible path.
        """
        if self.path is None:
            raise ArgumentError("play: there is no feasible path; call solve first")
        for t, q in enumerate(self.path):
            C.setJointState(q)
            C.view(False, f"step {t}\n{self.info}")
            if savePngs:
                C.viewer().savePng("z.vid/")
            time.sleep(duration / len(self.path))

    def debug(self, listObjectives: bool = True, plotOverTime: bool = False) -> None:
        """Prints the constraints that do not hold, and the errors of the objectives.

        Args:
            listObjectives: Prints the objectives with their errors, the largest first.
            plotOverTime: Shows the errors over time in a window.
        Raises:
            ArgumentError: There is no problem yet.
        """
        komo = self._problem("debug")
        print(komo.explain())
        if listObjectives:
            errors = [o for o in komo.report(True, True, plotOverTime).values() if isinstance(o, dict) and "name" in o]
            for objective in sorted(errors, key=lambda o: -sum(o.get(k, 0.0) for k in ("sos", "eq", "ineq"))):
                print(
                    {
                        k: v
                        for k, v in objective.items()
                        if k in ("name", "frames", "type", "times", "sos", "eq", "ineq")
                    }
                )

    def _problem(self, call: str) -> Any:
        if self.komo is None:
            raise ArgumentError(f"{call}: there is no problem yet; call one of the setups first")
        return self.komo


ManipulationModelling = KOMO_ManipulationHelper  # as scripts of earlier years call it
