"""Manipulation problems in a few calls, with feasibility by the reference's rule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import kinegraph

from .path_finder import RRT_PathFinder
from .results import NLP_Solver, SolverReturn


class KOMO_ManipulationHelper(kinegraph.KOMO_ManipulationHelper):
    """Like kinegraph.KOMO_ManipulationHelper, but `ret.feasible` follows the reference's rule.

    Methods of its `komo` (addObjective, getPath ...) can be called on the helper, too, as in the reference's latest
    scripts.
    """

    _solver = NLP_Solver
    _finder = RRT_PathFinder

    def __init__(self, info: str = "") -> None:
        """Makes a helper whose `komo` is empty; a setup replaces it, or scripts set it up.

        Args:
            info: Name of the problem in the output of solve.
        """
        super().__init__(info)
        self.komo = kinegraph.KOMO()

    if not TYPE_CHECKING:  # otherwise type checkers accept any name

        def __getattr__(self, name: str) -> Any:
            if not name.startswith("_") and self.komo is not None and hasattr(self.komo, name):
                return getattr(self.komo, name)
            hint = "" if self.komo is not None else "; there is no problem yet; call one of the setups first"
            raise AttributeError(f"KOMO_ManipulationHelper has no '{name}'{hint}")


class LGP_Tool(kinegraph.LGP_Tool):
    """Like kinegraph.LGP_Tool, but feasibility of waypoints follows the reference's rule."""

    def __init__(
        self, C: kinegraph.Config, tamp: kinegraph.LGP_TAMP_Abstraction, translator: object = None, *, threads: int = 1
    ) -> None:
        """Creates a tool without starting a search.

        Args:
            C: The scene.
            tamp: Provides plans, and the requirements of their actions.
            translator: Not used; accepted for older scripts, since `tamp` does its work.
            threads: Number of threads that solve in parallel.
        Raises:
            ArgumentError: threads is less than one.
        """
        super().__init__(C, tamp, translator, threads=threads, results=SolverReturn)


ManipulationModelling = KOMO_ManipulationHelper  # its name in older scripts
