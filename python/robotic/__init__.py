"""Runs scripts written for the reference: `from robotic import ry` or `import robotic as ry`.

A thin layer over kinegraph with the same classes and functions under the same names, and these differences:

- `feasible` of a solve follows the reference's rule; see `SolverReturn`.
- A simulated `BotOp` moves beyond its limits and into obstacles, with a warning; `kinegraph.BotOp` is strict.
- `Config.getFrame` returns None for an unknown frame, and a frame with an unknown parent has none, with a warning.
- `SimulationEngine.bullet` simulates by MuJoCo, with a warning.
- States of a `Simulation` unpack as (X, q, V, qDot), and solvers keep their trace.
- Names and arguments of earlier versions (0.1.10, 0.2.3, 0.2.9) are there, too.
- Names of the reference without an implementation here exist, and raise an explaining error when used.

Both packages can be imported in one process; neither changes the other.
"""

from __future__ import annotations

import sys as _sys
from importlib import import_module as _import_module
from typing import TYPE_CHECKING
from typing import Any as _Any

import kinegraph
from kinegraph import __version__ as __version__

if TYPE_CHECKING:
    from kinegraph import *  # noqa: F403
    from kinegraph import ArgWord as ArgWord
    from kinegraph import test as test
    from kinegraph.compatibility.lgp import (
        Actions2KOMO_Translator,
        Logic2KOMO_Translator,
        TAMP_Provider,
        default_Actions2KOMO_Translator,
        default_Logic2KOMO_Translator,
        default_TAMP_Provider,
    )

    from . import DataGen, algo, calib, manipulation, nlp, render
    from .keywords import arg
    from .manipulation import KOMO_ManipulationHelper, LGP_Tool, ManipulationModelling
    from .tools.mujoco_io import MujocoLoader

from .earlier_words import acceptEarlierWords as _acceptEarlierWords
from .exported_values import exportedValue as _exportedValue
from .log_level import setLogLevel
from .not_yet import (
    CtrlSet,
    CtrlSolver,
    ImpType,
    KOMO_Objective,
    SRRT_PathFinder,
)
from .operation import BotOp
from .path_finder import RRT_PathFinder
from .path_finder import RRT_PathFinder as PathFinder  # until 0.2.3
from .results import NLP_Solver, SolverReturn
from .scenes import Config
from .simulation import Simulation, SimulationState

SimulatorEngine = kinegraph.SimulationEngine  # in libry

_acceptEarlierWords()

__all__ = [
    *kinegraph.__all__,
    "Actions2KOMO_Translator",
    "CtrlSet",
    "CtrlSolver",
    "DataGen",
    "ImpType",
    "KOMO_ManipulationHelper",
    "KOMO_Objective",
    "Logic2KOMO_Translator",
    "ManipulationModelling",
    "MujocoLoader",
    "SRRT_PathFinder",
    "SimulatorEngine",
    "TAMP_Provider",
    "algo",
    "arg",
    "calib",
    "default_Actions2KOMO_Translator",
    "default_Logic2KOMO_Translator",
    "default_TAMP_Provider",
    "manipulation",
    "nlp",
    "rai_path",
    "render",
    "ry",
    "setLogLevel",
]


# Modules loaded at the first use of one of their names, as in kinegraph.
_LAZY = {
    "kinegraph.compatibility.lgp": (
        "Actions2KOMO_Translator",
        "Logic2KOMO_Translator",
        "TAMP_Provider",
        "default_Actions2KOMO_Translator",
        "default_Logic2KOMO_Translator",
        "default_TAMP_Provider",
    ),
    "robotic.manipulation": ("KOMO_ManipulationHelper", "LGP_Tool", "ManipulationModelling"),
    "robotic.keywords": ("arg",),
    "robotic.tools.mujoco_io": ("MujocoLoader",),
}
_MODULE_OF = {name: module for module, names in _LAZY.items() for name in names}
_SUBMODULES = ("DataGen", "algo", "calib", "manipulation", "nlp", "render", "src", "test", "tools")

if not TYPE_CHECKING:  # otherwise type checkers accept any name
    globals().update(
        {
            name: vars(kinegraph)[name]
            for name in kinegraph.__all__
            if name in vars(kinegraph) and name not in globals() and name not in _MODULE_OF
        }
    )

    def __getattr__(name: str) -> _Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if name in _SUBMODULES:
            return _import_module("." + name, __name__)
        if name in _MODULE_OF:
            value = getattr(_import_module(_MODULE_OF[name]), name)
        elif name in kinegraph.__all__:
            value = getattr(kinegraph, name)
        elif (exported := _exportedValue(name)) is not None:
            value = exported
        else:
            import difflib  # not at import: it takes milliseconds, and is rarely needed

            near = difflib.get_close_matches(name, __all__, 3, 0.5)
            hint = f"; similar names: {', '.join(near)}" if near else ""
            raise AttributeError(f"robotic has no '{name}'{hint}")
        globals()[name] = value
        return value

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})


import robotic as ry  # noqa: E402

rai_path = kinegraph.raiPath().rstrip("/")
_robotic = ry  # the module of the reference's compiled classes, as in annotations
_sys.modules[__name__ + ".ry"] = _sys.modules[__name__ + "._robotic"] = ry
