"""The names of the reference that other work will build, and those that Kinegraph calls otherwise."""

from __future__ import annotations

import kinegraph

from .pending import pending

_PATHS = "KOMO finds paths (komo.solveFromMany from several starts), and C.checkMotion says where one collides"
_PLANS = "Skeleton and KOMO solve a plan whose symbols are given"

SRRT_PathFinder = pending("SRRT_PathFinder", _PATHS)
LGP_Tool = pending("LGP_Tool", _PLANS)
LGP_TAMP_Abstraction = pending("LGP_TAMP_Abstraction", _PLANS)
default_LGP_TAMP_Abstraction = pending("default_LGP_TAMP_Abstraction", _PLANS)
default_TAMP_Provider = pending("default_TAMP_Provider", _PLANS)
default_Logic2KOMO_Translator = pending("default_Logic2KOMO_Translator", _PLANS)
KOMO_Objective = pending("KOMO_Objective", "komo.addObjective adds one, komo.report() tells of each")
KOMO_ManipulationHelper = pending(
    "KOMO_ManipulationHelper", "KOMO with addModeSwitch and addObjective states the same problems; see docs/motion.md"
)
MujocoLoader = pending("MujocoLoader", "C.addFile('scene.xml') reads MJCF files")


class arg:
    """The words of named problems, as earlier years wrote them."""

    left = kinegraph.ArgWord._left
    right = kinegraph.ArgWord._right
    sequence = kinegraph.ArgWord._sequence
    path = kinegraph.ArgWord._path
