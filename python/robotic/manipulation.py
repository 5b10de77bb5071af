"""Problems of manipulation in a few calls; results speak the reference's rule of what is feasible."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import kinegraph

from .results import NLP_Solver


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

    _solver = NLP_Solver


ManipulationModelling = KOMO_ManipulationHelper  # as scripts of earlier years call it
