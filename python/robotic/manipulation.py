"""Problems of manipulation in a few calls; results speak the reference's rule of what is feasible."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import kinegraph

from .results import NLP_Solver, SolverReturn


class KOMO_ManipulationHelper(kinegraph.KOMO_ManipulationHelper):
    """As kinegraph.KOMO_ManipulationHelper; `ret.feasible` is by the reference's rule. Calls of its `komo` (addObjective,
    getPath ...) can be made on the helper, too, as its latest scripts do."""

    _solver = NLP_Solver

    if not TYPE_CHECKING:  # else any name would do

        def __getattr__(self, name: str) -> Any:
            if not name.startswith("_") and self.komo is not None and hasattr(self.komo, name):
                return getattr(self.komo, name)
            hint = "" if self.komo is not None else "; there is no problem yet; call one of the setups first"
            raise AttributeError(f"KOMO_ManipulationHelper has no '{name}'{hint}")


class LGP_Tool(kinegraph.LGP_Tool):
    """As kinegraph.LGP_Tool; waypoints are feasible by the reference's rule."""

    def __init__(
        self, C: kinegraph.Config, tamp: kinegraph.LGP_TAMP_Abstraction, translator: object = None, *, threads: int = 1
    ) -> None:
        """Makes a tool; nothing is searched yet.

        Args:
            C: The scene.
            tamp: What is asked for plans, and for what their actions ask.
            translator: Of older scripts; the abstraction does its work.
            threads: How many solve at the same time.
        Raises:
            ArgumentError: threads is less than one.
        """
        super().__init__(C, tamp, translator, threads=threads, results=SolverReturn)


ManipulationModelling = KOMO_ManipulationHelper  # as scripts of earlier years call it
