"""Problems of manipulation in a few calls; results speak the reference's rule of what is feasible."""

from __future__ import annotations

import kinegraph

from .results import NLP_Solver


class KOMO_ManipulationHelper(kinegraph.KOMO_ManipulationHelper):
    """As kinegraph.KOMO_ManipulationHelper; `ret.feasible` is by the reference's rule."""

    _solver = NLP_Solver


class LGP_Tool(kinegraph.LGP_Tool):
    """As kinegraph.LGP_Tool; waypoints are feasible by the reference's rule."""

    _solver = NLP_Solver


ManipulationModelling = KOMO_ManipulationHelper  # as scripts of earlier years call it
