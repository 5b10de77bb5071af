"""Names of the reference without an implementation here."""

from __future__ import annotations

from .pending import pending

_PATHS = "KOMO finds paths (komo.solveFromMany from several starts), and C.checkMotion reports collisions"

SRRT_PathFinder = pending("SRRT_PathFinder", _PATHS)
KOMO_Objective = pending("KOMO_Objective", "komo.addObjective adds one, komo.report() describes each")
CtrlSet = pending("CtrlSet", "DiffIk(C) controls a robot by objectives; DiffIk.step(dt) is one period")
CtrlSolver = pending("CtrlSolver", "DiffIk(C) controls a robot by objectives; DiffIk.step(dt) is one period")
ImpType = pending("ImpType", "Simulation.applyForce pushes objects, setSimulateDepthNoise disturbs depth images")
