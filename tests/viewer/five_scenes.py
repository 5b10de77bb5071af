"""Five scenes of different kind and size, each with a place and a target of the camera."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import kinegraph as kg

Scene = tuple[kg.Config, list[float], list[float]]


def panda() -> Scene:
    C = kg.Config()
    C.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("ball", "table").setShape(kg.ST.sphere, [0.06]).setRelativePosition([0.3, 0.35, 0.11]).setColor(
        [0.2, 0.5, 0.85]
    )
    return C, [1.6, 2.0, 1.7], [0.0, 0.1, 0.9]


def shelf() -> Scene:
    """A white robot's gripper before a shelf of wood with boxes, cans and balls."""
    C = kg.Config()
    wood, width, depth, height = [0.62, 0.48, 0.34], 1.2, 0.35, 1.6
    for i in range(4):
        C.addFrame(f"board{i}").setShape(kg.ST.ssBox, [depth, width, 0.03, 0.005]).setPosition(
            [0.6, 0, 0.1 + 0.48 * i]
        ).setColor(wood)
    for side in (-1, 1):
        C.addFrame(f"side{side}").setShape(kg.ST.box, [depth, 0.03, height]).setPosition(
            [0.6, side * width / 2, height / 2]
        ).setColor(wood)
    chance = np.random.default_rng(3)
    shapes = [(kg.ST.box, [0.1, 0.1, 0.16], 0.08), (kg.ST.cylinder, [0.15, 0.04], 0.075), (kg.ST.sphere, [0.06], 0.06)]
    for i in range(12):
        shape, size, up = shapes[i % 3]
        place = [0.57, -0.45 + 0.3 * (i % 4), 0.115 + 0.48 * (i // 4) + up]
        C.addFrame(f"thing{i}").setShape(shape, size).setPosition(place).setColor(list(chance.uniform(0.15, 0.9, 3)))
    C.addFile(kg.raiPath("panda/panda.g"))
    return C, [-1.3, 1.7, 1.5], [0.35, 0, 0.7]


def hall() -> Scene:
    """Fifty meters long, with racks and crates."""
    C = kg.Config()
    chance = np.random.default_rng(0)
    for i in range(10):
        for side in (-4.0, 4.0):
            C.addFrame(f"rack{i}{side}").setShape(kg.ST.box, [3.0, 1.2, 4.0]).setPosition(
                [5.0 * i - 22.5, side, 2.0]
            ).setColor([0.35, 0.45, 0.6])
        C.addFrame(f"crate{i}").setShape(kg.ST.ssBox, [0.8, 0.8, 0.8, 0.05]).setPosition(
            [5.0 * i - 22.0, chance.uniform(-2, 2), 0.4]
        ).setColor([0.85, 0.55, 0.25])
    return C, [-33.0, -14.0, 14.0], [0.0, 0.0, 1.0]


def tiny() -> Scene:
    """A screw, a nut and a cube of one centimeter."""
    C = kg.Config()
    C.addFrame("cube").setShape(kg.ST.box, [0.01, 0.01, 0.01]).setPosition([0, 0, 0.005]).setColor([0.75, 0.25, 0.2])
    C.addFrame("head").setShape(kg.ST.cylinder, [0.004, 0.005]).setPosition([0.015, 0, 0.012]).setColor(
        [0.7, 0.7, 0.75]
    )
    C.addFrame("shaft").setShape(kg.ST.cylinder, [0.01, 0.0025]).setPosition([0.015, 0, 0.005]).setColor(
        [0.6, 0.6, 0.65]
    )
    C.addFrame("nut").setShape(kg.ST.ssCylinder, [0.004, 0.005, 0.001]).setPosition([0.006, 0.012, 0.002]).setColor(
        [0.85, 0.7, 0.2]
    )
    return C, [0.035, 0.05, 0.04], [0.006, 0.003, 0.004]


def everything() -> Scene:
    """Glass, markers, points, lines, an open mesh, and a table that is barely below the floor."""
    C = kg.Config()
    C.addFrame("low").setShape(kg.ST.box, [2.2, 1.6, 0.04]).setPosition([0, 0, -0.0205]).setColor([0.8, 0.75, 0.65])
    C.addFrame("glass").setShape(kg.ST.box, [0.3, 0.3, 0.5]).setPosition([0.3, 0.2, 0.25]).setColor(
        [0.2, 0.5, 0.8, 0.4]
    )
    C.addFrame("inside").setShape(kg.ST.capsule, [0.2, 0.06]).setPosition([0.3, 0.2, 0.2]).setColor([0.8, 0.3, 0.2])
    C.addFrame("marker").setShape(kg.ST.marker, [0.35]).setPosition([-0.3, 0.3, 0.1])
    chance = np.random.default_rng(1)
    points = chance.uniform(-0.2, 0.2, (400, 3)) + np.array([-0.4, -0.3, 0.3])
    C.addFrame("points").setPointCloud(points, (255 * chance.uniform(0, 1, (400, 3))).astype(np.uint8))
    angles = np.linspace(0, 4 * np.pi, 60)
    spiral = np.stack([0.25 * np.cos(angles) + 0.2, 0.25 * np.sin(angles) - 0.4, 0.04 * angles], 1)
    C.addFrame("lines").setLines(np.repeat(spiral, 2, axis=0)[1:-1]).setColor([0.1, 0.6, 0.1])
    corners = np.array([[-0.2, -0.2, 0.0], [0.2, -0.2, 0.0], [0.2, 0.2, 0.25], [-0.2, 0.2, 0.25]])
    C.addFrame("sheet").setMesh(corners, np.array([[0, 1, 2], [0, 2, 3]])).setPosition([0.75, -0.3, 0.1]).setColor(
        [0.55, 0.4, 0.75]
    )
    return C, [1.4, 1.7, 1.1], [0.0, 0.0, 0.2]


SCENES: dict[str, Callable[[], Scene]] = {f.__name__: f for f in (panda, shelf, hall, tiny, everything)}
