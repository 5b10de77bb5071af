"""Calls with one option each, whose errors name the valid values of the option."""

import functools
from collections.abc import Callable, Mapping
from typing import Any

import kinegraph as ry

Call = Callable[..., object]


@functools.cache
def calls() -> Mapping[str, Call]:
    """Functions, methods and classes by name. Each call takes an option by name, and is valid without it."""
    C = ry.Config()
    C.addText("""
        base: { shape: sphere, size: [.1], contact: 1 }
        j (base): { joint: hingeX, limits: [-1 1], q: 0 }
        tip (j): { Q: [0 0 .5], shape: sphere, size: [.1], contact: 1 }
    """)
    limits = {"velocity": 1.0, "acceleration": 1.0}
    plan = ry.planMotion(C, [0.1])
    bot = ry.BotOp(C, False)
    line = ry.ToolPath.along([[0, 0, 0.5], [0, 0.01, 0.5]], frame="tip")

    def withLimits(call: Call, *arguments: Any) -> Call:
        return lambda **option: call(*arguments, **{**limits, **option})

    def linear(**option: Any) -> object:
        return bot.moveLinear("tip", [0, 0.01, 0.5], **option)

    return {
        "planMotion": lambda **option: ry.planMotion(C, [0.1], **option),
        "planMotions": lambda **option: ry.planMotions(C, [[0.1]], **option),
        "replan": lambda **option: plan.replan(C, 0.0, **option),
        "planTask": lambda **option: ry.planTask(C, "(on base tip)", **option),
        "planTasks": lambda **option: next(iter(ry.planTasks(C, "(on base tip)", **option)), None),
        "retime": withLimits(ry.retime, C, [[0], [0.5], [1.0]]),
        "planToolPath": lambda **option: ry.planToolPath(C, line, **option),
        "moveLinear": linear,
        "moveCircular": linear,
        "moveSequence": linear,
        "DiffIk": lambda **option: ry.DiffIk(C, **option),
        "reachability": lambda **option: ry.reachability(C, "tip", **{"spacing": 1.0, "workers": 1, **option}),
        "selfCollisionMatrix": C.selfCollisionMatrix,
        "RobotInfo": lambda **option: ry.RobotInfo("robot", ["j"], **option),
        "IkOptions": ry.IkOptions,
        "NLP_SolverOptions": ry.NLP_SolverOptions,
        "SimulationOptions": ry.SimulationOptions,
    }
