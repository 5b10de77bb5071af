"""The names of the reference that other work will build, and those that Kinegraph calls otherwise."""

from __future__ import annotations

import kinegraph

from .pending import pending

_PATHS = "KOMO finds paths (komo.solveFromMany from several starts), and C.checkMotion says where one collides"

SRRT_PathFinder = pending("SRRT_PathFinder", _PATHS)
KOMO_Objective = pending("KOMO_Objective", "komo.addObjective adds one, komo.report() tells of each")
MujocoLoader = pending("MujocoLoader", "C.addFile('scene.xml') reads MJCF files")


class arg:
    """The words of named problems, as earlier years wrote them."""

    left = kinegraph.ArgWord._left
    right = kinegraph.ArgWord._right
    sequence = kinegraph.ArgWord._sequence
    path = kinegraph.ArgWord._path
