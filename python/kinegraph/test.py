"""Demonstration scenes, as in the tutorial's first command: `ry.test.RndScene()`."""

from __future__ import annotations

import math
from typing import NoReturn

from ._core import ST, Config
from .model_paths import raiPath


def randomScene(seed: int = 0, boxes: int = 30) -> Config:
    """Creates two robot arms at a table with many rounded boxes of random size, color and pose around them."""
    import random  # not at import: it takes milliseconds, and is rarely needed

    rng = random.Random(seed)
    C = Config()
    C.addFile(raiPath("scenarios/pandasTable.g"))
    for i in range(boxes):
        size = [rng.uniform(0.1, 0.4), rng.uniform(0.05, 0.3), rng.uniform(0.05, 0.2), 0.01]
        axis = [rng.gauss(0, 1) for _ in range(4)]
        norm = math.sqrt(sum(x * x for x in axis))
        angle, radius = rng.uniform(0, 2 * math.pi), rng.uniform(0.6, 1.8)
        frame = C.addFrame(f"obj{i}").setShape(ST.ssBox, size)
        frame.setPosition([radius * math.cos(angle), radius * math.sin(angle), rng.uniform(0.9, 2.4)])
        frame.setQuaternion([x / norm for x in axis])
        frame.setColor([rng.uniform(0.2, 1) for _ in range(3)]).setMass(0.2).setContact(1)
    return C


def RndScene() -> None:
    """Shows a random scene and waits for a key, if a user can press one."""
    C = randomScene()
    print(C.report())
    C.view(True, "ry.test.RndScene: a random scene")


_DEMOS = {
    "Align": "examples/03_relative_positions.py",
    "Compound": "C.addFile(ry.raiPath('tests/compound.g'))",
    "Easy": "examples/06_inverse_kinematics.py",
    "Friction": "ry.Simulation(C), and docs/simulation.md",
    "Grasp": "examples/15_grasp_and_lift.py",
    "OpenClose": "examples/15_grasp_and_lift.py",
    "PR2": "C.addFile(ry.raiPath('pr2/pr2.g'))",
    "Pushes": "ry.Simulation(C), and docs/simulation.md",
    "StackOfBlocks": "ry.Simulation(C), and docs/simulation.md",
    "Thin": "C.addFile(ry.raiPath('tests/thin.g')) and ry.planMotion",
    "Threading": "examples/10_many_problems.py",
}


def __getattr__(name: str) -> NoReturn:
    """Raises an error for the reference's other demonstrations, with a replacement."""
    hint = f"; instead: {_DEMOS[name]}" if name in _DEMOS else ""
    raise AttributeError(f"test has no '{name}'{hint}")
