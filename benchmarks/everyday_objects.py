"""Scenes of everyday.py with household objects: bodies of several shapes, and low ones that lie on the table."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from everyday_scenes import TOP, Generator, Scene, Table

import kinegraph as ry

Quaternion = list[float]


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    w, v, W, V = a[0], np.array(a[1:]), b[0], np.array(b[1:])
    return [w * W - float(v @ V), *(w * V + W * v + np.cross(v, V))]


def rotation(axis: str, angle: float) -> Quaternion:
    v = np.sin(0.5 * angle) * np.eye(3)["xyz".index(axis)]
    return [float(np.cos(0.5 * angle)), *v]


class Household(Table):
    """A table with a tray, and objects with any rotation about the vertical."""

    def tray(self, size: tuple[float, float] = (0.26, 0.26)) -> None:
        self.plate("tray", size)

    def body(self, name: str, radius: float, height: float, mass: float, tilt: Quaternion | None = None) -> ry.Frame:
        """Adds an object without a shape; `radius` and `height` are those of its room on the table."""
        turn = float(self.rng.uniform(-np.pi, np.pi))
        frame = self._stand(name, None, self.spot(radius), height, turn)
        frame.setRelativeQuaternion(product(rotation("z", turn), tilt or [1.0, 0.0, 0.0, 0.0])).setMass(mass)
        return frame

    def box_part(
        self, name: str, parent: str, at: list[float], size: list[float], turn: Quaternion | None = None
    ) -> None:
        frame = (
            self.C.addFrame(name, parent).setRelativePosition(at).setRelativeQuaternion(turn or [1.0, 0.0, 0.0, 0.0])
        )
        frame.setShape(ry.ST.ssBox, [*size, 0.25 * min(*size, 0.008)]).setColor([0.3, 0.5, 0.8]).setContact(1)

    def round_part(self, name: str, parent: str, at: list[float], height: float, radius: float) -> None:
        frame = self.C.addFrame(name, parent).setRelativePosition(at)
        frame.setShape(ry.ST.cylinder, [height, radius]).setColor([0.3, 0.5, 0.8]).setContact(1)

    def uniform(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def walls(self, name: str, sides: tuple[float, float], height: float, thick: float) -> None:
        """Adds four walls around the edge of an object's floor."""
        for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
            at = [0.5 * x * (sides[0] - thick), 0.5 * y * (sides[1] - thick), 0.5 * height]
            size = [thick, sides[1], height] if x else [sides[0] - 2 * thick, thick, height]
            self.box_part(f"{name}_wall{k}", name, at, size)


def mug(rng: Generator) -> Scene:
    """A mug of thin walls goes to a tray: five boxes, or a round one with a handle, or a mesh."""
    t = Household(rng)
    t.tray()
    height, kind = t.uniform(0.08, 0.1), rng.integers(3)
    if kind == 0:
        side = t.uniform(0.065, 0.09)
        t.body("mug", 0.7 * side, 0.006, 0.25).setShape(ry.ST.ssBox, [side, side, 0.006, 0.001]).setContact(1)
        t.walls("mug", (side, side), height, 0.005)
    elif kind == 1:
        radius = t.uniform(0.036, 0.044)
        t.body("mug", 1.8 * radius, height, 0.25)
        t.round_part("mug_floor", "mug", [0, 0, 0.003 - 0.5 * height], 0.006, radius)
        for k in range(10):
            a = 0.2 * np.pi * k
            size = [0.005, 2 * radius * np.tan(0.1 * np.pi), height]
            t.box_part(f"mug_wall{k}", "mug", [radius * np.cos(a), radius * np.sin(a), 0], size, rotation("z", a))
        t.box_part("mug_handle", "mug", [radius + 0.026, 0, 0], [0.01, 0.012, 0.05])
        for end in (-1, 1):
            t.box_part(f"mug_handle{end}", "mug", [radius + 0.014, 0, 0.022 * end], [0.024, 0.012, 0.01])
    else:
        points, triangles = cup(t.uniform(0.03, 0.037), height)
        t.body("mug", 0.04, height, 0.25).setMesh(points, triangles).setContact(1)
    return t.scene("(on tray mug)")


def cup(radius: float, height: float, thick: float = 0.004, n: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """Returns points and triangles of an open cylinder."""
    a, h = 2 * np.pi * np.arange(n) / n, 0.5 * height
    circle = np.stack([np.cos(a), np.sin(a)], axis=1)
    rings = ((radius, -h), (radius, h), (radius - thick, h), (radius - thick, thick - h))
    points = [np.column_stack([r * circle, np.full(n, z)]) for r, z in rings]
    points.append(np.array([[0, 0, -h], [0, 0, thick - h]]))
    triangles = []
    for k in range(n):
        j = (k + 1) % n
        for ring in (0, n, 2 * n):
            triangles += [[ring + k, ring + j, ring + n + j], [ring + k, ring + n + j, ring + n + k]]
        triangles += [[4 * n, j, k], [4 * n + 1, 3 * n + k, 3 * n + j]]
    return np.vstack(points), np.array(triangles)


def bowl(rng: Generator) -> Scene:
    """A bowl, wider than a hand opens, goes to a tray by its rim."""
    t = Household(rng)
    t.tray((0.3, 0.3))
    low, high, height, n = t.uniform(0.035, 0.042), t.uniform(0.055, 0.07), 0.05, 12
    t.body("bowl", 1.2 * high, 0.008, 0.25).setShape(ry.ST.cylinder, [0.008, low]).setContact(1)
    lean, length = np.arctan2(high - low, height), float(np.hypot(high - low, height))
    for k in range(n):
        a, r = 2 * np.pi * k / n, 0.5 * (low + high)
        turn = product(rotation("z", a), rotation("y", lean))
        size = [0.006, 2 * high * np.tan(np.pi / n), length]
        t.box_part(f"bowl_wall{k}", "bowl", [r * np.cos(a), r * np.sin(a), 0.5 * height], size, turn)
    return t.scene("(on tray bowl)")


def carton(rng: Generator) -> Scene:
    """An open carton goes to a board by one of its walls."""
    t = Household(rng)
    t.tray((0.3, 0.3))
    x, y = t.uniform(0.09, 0.11), t.uniform(0.12, 0.15)
    t.body("carton", 0.5 * float(np.hypot(x, y)), 0.006, 0.15).setShape(ry.ST.ssBox, [x, y, 0.006, 0.001]).setContact(1)
    t.walls("carton", (x, y), t.uniform(0.06, 0.08), 0.006)
    return t.scene("(on tray carton)")


def flat(rng: Generator) -> Scene:
    """A card or a coaster of 6 to 12 mm, or a small book, lies on the table and goes to a tray."""
    t = Household(rng)
    t.tray()
    kind, height = rng.integers(3), t.uniform(0.006, 0.012)
    if kind == 0:
        size = [t.uniform(0.05, 0.07), t.uniform(0.08, 0.1), height, 0.001]
        t.body("thing", 0.06, height, 0.04).setShape(ry.ST.ssBox, size).setContact(1)
    elif kind == 1:
        t.body("thing", 0.037, height, 0.05).setShape(ry.ST.cylinder, [height, t.uniform(0.03, 0.036)]).setContact(1)
    else:
        height = t.uniform(0.015, 0.025)
        size = [t.uniform(0.06, 0.072), t.uniform(0.1, 0.13), height, 0.002]
        t.body("thing", 0.07, height, 0.15).setShape(ry.ST.ssBox, size).setContact(1)
    return t.scene("(on tray thing)")


def pen(rng: Generator) -> Scene:
    """A pen or a marker lies on the table and goes to a tray: a cylinder, a capsule or a box."""
    t = Household(rng)
    t.tray()
    kind, r, length = rng.integers(3), t.uniform(0.006, 0.01), t.uniform(0.11, 0.15)
    if kind == 2:
        t.body("pen", 0.08, 2 * r, 0.03).setShape(ry.ST.ssBox, [length, 2 * r, 2 * r, 0.002]).setContact(1)
    else:
        shape = (ry.ST.cylinder, ry.ST.capsule)[kind]
        t.body("pen", 0.08, 2 * r, 0.03, rotation("y", 0.5 * np.pi)).setShape(shape, [length, r]).setContact(1)
    return t.scene("(on tray pen)")


def bottle(rng: Generator) -> Scene:
    """A bottle with a neck stands or lies, and goes to a tray; a wide one by its neck."""
    t = Household(rng)
    t.tray((0.3, 0.3))
    kind, height = rng.integers(3), t.uniform(0.12, 0.16)
    r = t.uniform(0.042, 0.048) if kind == 0 else t.uniform(0.026, 0.034)
    lies = kind == 2
    tilt = rotation("y", 0.5 * np.pi) if lies else None
    frame = t.body("bottle", 0.14 if lies else r, 2 * r if lies else height, 0.3, tilt)
    frame.setShape(ry.ST.cylinder, [height, r]).setContact(1)
    t.round_part("bottle_neck", "bottle", [0, 0, 0.5 * height + 0.025], 0.05, 0.013)
    return t.scene("(on tray bottle)")


def cutlery(rng: Generator) -> Scene:
    """A spoon and a knife go to a tray."""
    t = Household(rng)
    t.tray((0.3, 0.3))
    t.body("spoon", 0.1, 0.008, 0.05).setShape(ry.ST.ssBox, [0.13, 0.014, 0.008, 0.001]).setContact(1)
    t.box_part("spoon_head", "spoon", [0.085, 0, 0.002], [0.045, 0.035, 0.012])
    t.body("knife", 0.1, 0.008, 0.06).setShape(ry.ST.ssBox, [0.18, 0.016, 0.008, 0.001]).setContact(1)
    return t.scene("(on tray spoon) (on tray knife)")


def lid(rng: Generator) -> Scene:
    """A lid with a knob goes onto a pot."""
    t = Household(rng)
    r = t.uniform(0.065, 0.08)
    t.can("pot", r, t.uniform(0.08, 0.11))
    t.C.getFrame("pot").setMass(1.5)
    t.body("lid", r, 0.008, 0.2).setShape(ry.ST.cylinder, [0.008, r]).setContact(1)
    t.round_part("knob", "lid", [0, 0, 0.004 + 0.0125], 0.025, 0.014)
    return t.scene("(on pot lid)")


def tools(rng: Generator) -> Scene:
    """A pan goes to a hob by its handle, or a hammer to a tray."""
    t = Household(rng)
    if rng.integers(2):
        t.plate("hob", (0.2, 0.2))
        t.body("pan", 0.14, 0.04, 0.3).setShape(ry.ST.cylinder, [0.04, 0.075]).setContact(1)
        t.box_part("pan_handle", "pan", [0.125, 0, 0.012], [0.11, 0.02, 0.014])
        return t.scene("(on hob pan)")
    t.tray((0.3, 0.2))
    t.body("hammer", 0.13, 0.024, 0.15).setShape(ry.ST.ssBox, [0.2, 0.024, 0.024, 0.004]).setContact(1)
    t.box_part("hammer_head", "hammer", [0.11, 0, 0.003], [0.03, 0.08, 0.03])
    return t.scene("(on tray hammer)")


def atTheEdge(rng: Generator) -> Scene:
    """A block stands near the edge of a small table, a book upright beside it; the block goes to a tray."""
    t = Household(rng)
    t.tray()
    side, y = (1.0 if rng.integers(2) else -1.0), t.uniform(0.1, 0.25)
    t.C.addFrame("stool", "table").setRelativePosition([0.38 * side, y, TOP + 0.1]).setShape(
        ry.ST.ssBox, [0.3, 0.3, 0.2, 0.005]
    ).setContact(1).setColor([0.5, 0.4, 0.3])
    t.take((0.38 * side, y), 0.22)
    for name, size, at in (("block", [0.05, 0.05, 0.05], -0.115), ("book", [0.1, 0.025, 0.14], 0.05)):
        frame = t.C.addFrame(name, "stool").setJoint(ry.JT.rigid)
        frame.setRelativePosition([at * side, t.uniform(-0.07, 0.07), 0.1 + 0.5 * size[2]])
        frame.setShape(ry.ST.ssBox, [*size, 0.003]).setContact(1).setMass(500 * float(np.prod(size)))
        t.objects.append(name)
    return t.scene("(on tray block)")


def heavyBar(rng: Generator) -> Scene:
    """A bar with a weight hidden in one of its ends goes to a tray."""
    t = Household(rng)
    t.tray((0.3, 0.3))
    t.body("bar", 0.13, 0.045, 0.15).setShape(ry.ST.ssBox, [0.24, 0.045, 0.045, 0.004]).setContact(1)
    weight = t.C.addFrame("weight", "bar").setRelativePosition([0.095, 0, 0])
    weight.setShape(ry.ST.ssBox, [0.03, 0.03, 0.03, 0.004]).setMass(t.uniform(0.3, 0.8))
    return t.scene("(on tray bar)")


def corner(rng: Generator) -> Scene:
    """A box 2 cm from two ledges of its own height goes to a tray."""
    t = Household(rng)
    t.tray((0.2, 0.2))
    size, gap, thick = t.cube(), 0.02, 0.02
    box = t.C.getFrame(t.box("box", size, t.spot(0.12)))
    for name, k in (("ledge0", 0), ("ledge1", 1)):
        sides, beside = [0.2, 0.2, size[2]], np.zeros(3)
        sides[k], beside[k] = thick, 0.5 * size[k] + gap + 0.5 * thick
        ledge = t.C.addFrame(name, "table").setPosition(box.getPosition() + box.getRotationMatrix() @ beside)
        ledge.setQuaternion(box.getQuaternion()).setShape(ry.ST.ssBox, [*sides, 0.004]).setContact(1)
    return t.scene("(on tray box)")


OBJECT_GENERATORS: dict[str, Callable[[Generator], Scene]] = {
    "mug": mug,
    "bowl": bowl,
    "carton": carton,
    "flat": flat,
    "pen": pen,
    "bottle": bottle,
    "cutlery": cutlery,
    "lid": lid,
    "tools": tools,
    "at the edge": atTheEdge,
    "heavy bar": heavyBar,
    "corner": corner,
}
