"""Ordinary scenes of manipulation, drawn as a person sets them up on the first day: see everyday.py.

Each generator draws a scene from a numpy Generator: things within easy reach of the arm, a hand's width apart, on a
table. `GENERATORS` lists them by name.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import kinegraph as ry

TOP = 0.05  # m: the top of the table above the frame of the table
DENSITY = 500.0  # kg/m^3

Point = tuple[float, float]
Generator = np.random.Generator


@dataclass
class Scene:
    """A scene and a goal. `robots` are the frames that carry arms, `things` all that stands on the table, and `objects`
    what hands move.
    """

    C: ry.Config
    goal: str
    robots: list[str]
    things: list[str]
    objects: list[str]


class Table:
    """A table with arms on it; draws free spots within easy reach."""

    def __init__(self, rng: Generator, file: str = "scenarios/pandaSingle.g", robots: tuple[str, ...] = ()) -> None:
        self.rng, self.C = rng, ry.Config()
        self.C.addFile(ry.raiPath(file))
        self.things: list[str] = []
        self.objects: list[str] = []
        self.robots = list(robots or ("l_panda_base",))
        self.taken: list[tuple[np.ndarray, float]] = []
        self.reach = [(np.array([0.0, -0.2]), 0.38, 0.64, 1.1)]  # center, from, to (m), angle to either side (rad)
        self.parent, self.top = "table", TOP

    def spot(self, radius: float, gap: float = 0.06, arm: int | None = None, side: float = 0.0) -> Point:
        """Draws the center of a free disk, `gap` apart from all others; `side` -1 is left, 1 is right."""
        for _ in range(2000):
            center, low, high, angle = self.reach[self.rng.integers(len(self.reach)) if arm is None else arm]
            a, r = self.rng.uniform(-angle, angle), self.rng.uniform(low, high)
            at = center + r * np.array([np.sin(a), np.cos(a)])
            if side * (at[0] - center[0]) < 0.1 * abs(side):
                continue
            if all(np.linalg.norm(at - other) >= radius + size + gap for other, size in self.taken):
                self.take(at, radius)
                return float(at[0]), float(at[1])
        raise RuntimeError("there is no free spot left")

    def take(self, at: Point | np.ndarray, radius: float) -> None:
        self.taken.append((np.array(at, float), radius))

    def plate(self, name: str, size: Point, at: Point | None = None, height: float = 0.01, **where: float) -> str:
        """Adds a flat place: a tray, a board, a pad."""
        at = at or self.spot(0.5 * float(np.hypot(*size)), **where)  # type: ignore[arg-type]
        frame = self.C.addFrame(name, self.parent).setRelativePosition([*at, self.top + 0.5 * height])
        frame.setShape(ry.ST.ssBox, [*size, height, 0.004]).setColor([0.3, 0.6, 0.3]).setContact(1)
        self.things.append(name)
        return name

    def _stand(self, name: str, on: str | None, at: Point, height: float, turn: float) -> ry.Frame:
        top = self.top if on is None else 0.5 * self.C.getFrame(on).getSize()[0 if self.isRound(on) else 2]
        frame = self.C.addFrame(name, on or self.parent).setJoint(ry.JT.rigid)
        frame.setRelativePosition([*at, top + 0.5 * height])
        frame.setRelativeQuaternion([np.cos(0.5 * turn), 0, 0, np.sin(0.5 * turn)])
        self.objects.append(name)
        if on is None:
            self.things.append(name)
        return frame

    def isRound(self, name: str) -> bool:
        return self.C.getFrame(name).getShapeType() == ry.ST.cylinder

    def box(
        self,
        name: str,
        size: tuple[float, float, float],
        at: Point | None = None,
        on: str | None = None,
        **where: float,
    ) -> str:
        """Adds a box; on the table with any rotation, on another thing aligned with it."""
        if at is None:
            at = (0.0, 0.0) if on else self.spot(0.5 * float(np.hypot(*size[:2])), **where)  # type: ignore[arg-type]
        turn = 0.0 if on else float(self.rng.uniform(-np.pi / 4, np.pi / 4))
        frame = self._stand(name, on, at, size[2], turn)
        frame.setShape(ry.ST.ssBox, [*size, 0.004]).setColor([1.0, 0.6, 0.2]).setContact(1)
        frame.setMass(DENSITY * float(np.prod(size)))
        return name

    def can(
        self, name: str, radius: float, height: float, at: Point | None = None, on: str | None = None, **where: float
    ) -> str:
        if at is None:
            at = (0.0, 0.0) if on else self.spot(radius, **where)  # type: ignore[arg-type]
        frame = self._stand(name, on, at, height, 0.0)
        frame.setShape(ry.ST.cylinder, [height, radius]).setColor([0.8, 0.2, 0.2]).setContact(1)
        frame.setMass(DENSITY * np.pi * radius * radius * height)
        return name

    def wall(self, name: str, parent: str, at: tuple[float, float, float], size: tuple[float, float, float]) -> None:
        frame = self.C.addFrame(name, parent).setRelativePosition(at).setShape(ry.ST.ssBox, [*size, 0.004])
        frame.setColor([0.6, 0.5, 0.4]).setContact(1)

    def scene(self, goal: str) -> Scene:
        return Scene(self.C, goal, self.robots, self.things, self.objects)

    def cube(self, low: float = 0.04, high: float = 0.055) -> tuple[float, float, float]:
        """Draws the size of a box that stands well and that a hand of 8 cm takes."""
        w = float(self.rng.uniform(low, high))
        return w, float(self.rng.uniform(low, high)), float(self.rng.uniform(0.9, 1.5)) * w


def boxesToTray(rng: Generator) -> Scene:
    """One to three boxes to a tray."""
    t = Table(rng)
    t.plate("tray", (0.24, 0.24))
    names = [t.box(f"box{i}", t.cube()) for i in range(rng.integers(1, 4))]
    return t.scene(" ".join(f"(on tray {name})" for name in names))


def cupsOnBoard(rng: Generator) -> Scene:
    """Two cups to a board."""
    t = Table(rng)
    t.plate("board", (float(rng.uniform(0.28, 0.34)), 0.18), height=0.015)
    names = [t.can(f"cup{i}", float(rng.uniform(0.022, 0.03)), float(rng.uniform(0.08, 0.1))) for i in range(2)]
    return t.scene(" ".join(f"(on board {name})" for name in names))


def bin(rng: Generator) -> Scene:
    """Two boxes into a bin with low walls."""
    t = Table(rng)
    w, h = float(rng.uniform(0.22, 0.26)), float(rng.uniform(0.04, 0.06))
    t.plate("bin", (w, w))
    for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
        size = (0.01, w + 0.02, h) if x else (w + 0.02, 0.01, h)
        t.wall(f"bin_wall{k}", "bin", (x * (0.5 * w + 0.005), y * (0.5 * w + 0.005), 0.5 * h - 0.005), size)
    names = [t.box(f"box{i}", t.cube()) for i in range(2)]
    return t.scene(" ".join(f"(on bin {name})" for name in names))


def rowOfThree(rng: Generator) -> Scene:
    """Three boxes in a row on a narrow tray."""
    t = Table(rng)
    t.plate("tray", (float(rng.uniform(0.36, 0.42)), 0.09), (float(rng.uniform(-0.1, 0.1)), 0.36))
    t.take((-0.12, 0.36), 0.1)
    t.take((0.12, 0.36), 0.1)
    names = [t.box(f"box{i}", t.cube(0.04, 0.05)) for i in range(3)]
    return t.scene(" ".join(f"(on tray {name})" for name in names))


def stack(rng: Generator) -> Scene:
    """Three boxes, one on the other."""
    t = Table(rng)
    for i, w in enumerate(sorted(rng.uniform(0.045, 0.06, 3), reverse=True)):
        t.box(f"box{i}", (float(w), float(w), 0.05))
    return t.scene("(on box0 box1) (on box1 box2)")


def swap(rng: Generator) -> Scene:
    """Two boxes on two pads change places."""
    t = Table(rng)
    for i, side in enumerate((-1.0, 1.0)):
        t.box(f"box{i}", t.cube(), on=t.plate(f"pad{i}", (0.12, 0.12), side=side))
    return t.scene("(on pad0 box1) (on pad1 box0)")


def cans(rng: Generator) -> Scene:
    """Two cans of 66 mm to a pad each."""
    t = Table(rng)
    for i in range(2):
        t.plate(f"pad{i}", (0.12, 0.12))
    for i in range(2):
        t.can(f"can{i}", 0.033, float(rng.uniform(0.09, 0.115)))
    return t.scene("(on pad0 can0) (on pad1 can1)")


def sorting(rng: Generator) -> Scene:
    """Four boxes, onto two trays."""
    t = Table(rng)
    for tray, side in (("red", -1.0), ("blue", 1.0)):
        t.plate(tray, (0.2, 0.2), side=side)
    names = [t.box(f"box{i}", t.cube(0.035, 0.05), gap=0.05) for i in range(4)]
    return t.scene(" ".join(f"(on {'red' if i % 2 else 'blue'} {name})" for i, name in enumerate(names)))


def clutter(rng: Generator) -> Scene:
    """One of eight things on a cluttered table goes to a tray."""
    t = Table(rng)
    t.plate("tray", (0.16, 0.16))
    t.box("wanted", t.cube(), gap=0.05)
    for i in range(7):
        if rng.integers(2):
            t.box(f"other{i}", t.cube(), gap=0.045)
        else:
            t.can(f"other{i}", float(rng.uniform(0.02, 0.03)), float(rng.uniform(0.06, 0.12)), gap=0.045)
    return t.scene("(on tray wanted)")


def tallBeforeLow(rng: Generator) -> Scene:
    """A tall thing stands between the arm and the low one that goes to a tray."""
    t = Table(rng)
    a, r = float(rng.uniform(-0.8, 0.8)), float(rng.uniform(0.52, 0.6))
    along = np.array([np.sin(a), np.cos(a)])
    low, tall = along * r - [0.0, 0.2], along * (r - float(rng.uniform(0.12, 0.15))) - [0.0, 0.2]
    t.take(low, 0.04)
    t.take(tall, 0.04)
    t.box("low", (0.05, 0.05, 0.05), (float(low[0]), float(low[1])))
    t.box("tall", (0.05, 0.05, float(rng.uniform(0.15, 0.2))), (float(tall[0]), float(tall[1])))
    t.plate("tray", (0.18, 0.18))
    return t.scene("(on tray low)")


def twoArmTable(rng: Generator) -> Table:
    t = Table(rng, "scenarios/pandasTable.g", ("l_panda_base", "r_panda_base"))
    t.reach = [(np.array([x, -0.3]), 0.38, 0.62, 0.7) for x in (-0.4, 0.4)]
    return t


def twoArms(rng: Generator) -> Scene:
    """Two arms, each with a box and a tray on its own side."""
    t = twoArmTable(rng)
    for i in range(2):
        t.plate(f"tray{i}", (0.16, 0.16), arm=i)
        t.box(f"box{i}", t.cube(), arm=i)
    return t.scene("(on tray0 box0) (on tray1 box1)")


def handingOver(rng: Generator) -> Scene:
    """A stick lies where only one of two arms reaches, and goes to a tray where only the other does."""
    t = twoArmTable(rng)
    side = 1.0 if rng.integers(2) else -1.0
    at = (side * float(rng.uniform(0.6, 0.7)), float(rng.uniform(0.1, 0.25)))
    t.plate("tray", (0.2, 0.2), (-side * float(rng.uniform(0.6, 0.7)), float(rng.uniform(0.1, 0.25))))
    t.box("stick", (0.04, 0.04, float(rng.uniform(0.16, 0.2))), at)
    return t.scene("(on tray stick)")


UR_SCENE = """
world: {}
table (world): { Q: [0 0 .6], shape: ssBox, size: [2.5 2.5 .1 .02], color: [.3], contact: 1, friction: .1 }
Include: <%s>
Edit ur_world (table): { Q: "t(0 -.4 .05)" }
Edit ur_shoulder_pan_joint: { q: 1.3 }
Edit ur_shoulder_lift_joint: { q: -1.8 }
Edit ur_elbow_joint: { q: 2 }
Edit ur_wrist_1_joint: { q: -1.77 }
Edit ur_wrist_2_joint: { q: -1.57 }
Include: <%s>
Edit robotiq_base (ur_ee_fixed_joint): { Q: "d(90 0 1 0)" }
Edit finger_joint: { joint_active: false }
"""


def urRobotiq(rng: Generator) -> Scene:
    """A UR10 with a Robotiq: two boxes to a tray."""
    t = Table(rng)
    t.C = ry.Config()
    t.C.addText(UR_SCENE % (ry.raiPath("ur10/ur10.g"), ry.raiPath("robotiq/robotiq.g")))
    t.robots = ["ur_world"]
    t.reach = [(np.array([0.0, -0.4]), 0.5, 0.8, 0.8)]
    t.plate("tray", (0.24, 0.24))
    names = [t.box(f"box{i}", t.cube()) for i in range(2)]
    return t.scene(" ".join(f"(on tray {name})" for name in names))


def slabs(rng: Generator) -> Scene:
    """Three slabs, each smaller than the one below, go from one place to another by a third."""
    t = Table(rng)
    for name, x in (("left", -0.35), ("middle", 0.0), ("right", 0.35)):
        y = 0.42 if name == "middle" else float(rng.uniform(0.15, 0.3))
        t.plate(name, (0.16, 0.16), (x + float(rng.uniform(-0.03, 0.03)), y))
    below = "left"
    for i, w in enumerate((0.068, 0.056, 0.045)):
        below = t.box(f"slab{i}", (w, w, 0.04), on=below)
    return t.scene("(on right slab0) (on slab0 slab1) (on slab1 slab2)")


def makeWay(rng: Generator) -> Scene:
    """A small pad is occupied; the jug there makes way for the cup, or stays on the table."""
    t = Table(rng)
    t.box("jug", t.cube(), on=t.plate("pad", (0.1, 0.1)))
    t.box("cup", t.cube())
    return t.scene("(on pad cup) (on table jug)")


def comeBack(rng: Generator) -> Scene:
    """A box stands on another; the lower one goes to a tray, and the upper one comes back onto it."""
    t = Table(rng)
    t.box("lower", (0.06, 0.06, 0.05))
    t.box("upper", (0.045, 0.045, 0.05), on="lower")
    t.plate("tray", (0.16, 0.16))
    return t.scene("(on tray lower) (on lower upper)")


def shelf(rng: Generator) -> Scene:
    """A cup goes from the table onto the upper board of a shelf, another onto the lower board."""
    t = Table(rng)
    x, y, w, h = float(rng.uniform(-0.1, 0.1)), float(rng.uniform(0.42, 0.46)), 0.4, 0.3
    t.C.addFrame("shelf", "table").setRelativePosition([x, y, TOP])
    t.things.append("shelf")
    for side in (-1, 1):
        t.wall(f"shelf_side{side}", "shelf", (side * 0.5 * w, 0.0, 0.5 * h), (0.02, 0.2, h))
    for name, z in (("lower", 0.02), ("upper", h)):
        board = t.C.addFrame(name, "shelf").setRelativePosition([0, 0, z])
        board.setShape(ry.ST.ssBox, [w - 0.03, 0.2, 0.02, 0.004]).setColor([0.6, 0.5, 0.4]).setContact(1)
    for offset in (-0.15, 0.0, 0.15):
        t.take((x + offset, y), 0.15)
    names = [t.can(f"cup{i}", 0.027, float(rng.uniform(0.07, 0.1)), gap=0.04) for i in range(2)]
    return t.scene(f"(on upper {names[0]}) (on lower {names[1]})")


def drawer(rng: Generator) -> Scene:
    """A box goes into a closed drawer."""
    t = Table(rng)
    x, y = float(rng.uniform(-0.08, 0.08)), float(rng.uniform(0.42, 0.48))
    t.C.addFrame("cabinet", "table").setRelativePosition([x, y, TOP])
    t.things.append("cabinet")
    for name, at, size in (
        ("left", (-0.14, 0.15, 0.08), (0.02, 0.3, 0.16)),
        ("right", (0.14, 0.15, 0.08), (0.02, 0.3, 0.16)),
        ("back", (0.0, 0.31, 0.08), (0.3, 0.02, 0.16)),
        ("roof", (0.0, 0.16, 0.17), (0.3, 0.32, 0.02)),
    ):
        t.wall(f"cabinet_{name}", "cabinet", at, size)
    slide = t.C.addFrame("drawer", "cabinet").setJoint(ry.JT.transY, [-0.2, 0.0]).setJointState([0.0])
    slide.setAttributes({"logical": {"is_drawer": True}, "noMotor": True, "jointFriction": 2.0})
    for name, at, size in (
        ("drawer_floor", (0.0, 0.14, 0.02), (0.24, 0.26, 0.02)),
        ("drawer_front", (0.0, -0.01, 0.07), (0.25, 0.02, 0.12)),
        ("handle", (0.0, -0.07, 0.1), (0.02, 0.02, 0.08)),
    ):
        t.wall(name, "drawer", at, size)
        t.C.getFrame(name).setMass(0.2)
    t.C.getFrame("handle").setAttributes({"logical": {"is_handle": True}})
    side = 1.0 if rng.integers(2) else -1.0
    t.box("box", (0.04, 0.05, 0.07), (side * float(rng.uniform(0.35, 0.5)), float(rng.uniform(0.0, 0.2))))
    return t.scene("(on drawer_floor box)")


def mobileBase(rng: Generator) -> Scene:
    """An arm on a base that drives: a box goes from one table to another, out of reach of the first."""
    t = Table(rng, "scenarios/panda_mobile.g", ("base_origin",))
    t.C.addFrame("floor")
    for name, y in (("here", -0.9), ("there", 0.9)):
        board = t.C.addFrame(name, "floor").setRelativePosition([float(rng.uniform(-0.2, 0.2)), y, 0.25])
        board.setShape(ry.ST.ssBox, [1.0, 0.6, 0.5, 0.02]).setContact(1)
        t.things.append(name)
    t.C.addFrame("tray", "there").setRelativePosition([float(rng.uniform(-0.2, 0.2)), -0.1, 0.255]).setShape(
        ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]
    ).setContact(1)
    t.parent, t.top = "here", 0.25
    t.box("box", t.cube(), (float(rng.uniform(-0.25, 0.25)), float(rng.uniform(0.05, 0.15))))
    return t.scene("(on tray box)")


def pickUp(rng: Generator) -> Scene:
    """A hand picks up one of two boxes, and holds it."""
    t = Table(rng)
    t.box("box", t.cube())
    t.box("other", t.cube())
    return t.scene("(on l_gripper box)")


GENERATORS: dict[str, Callable[[Generator], Scene]] = {
    "boxes to a tray": boxesToTray,
    "cups on a board": cupsOnBoard,
    "bin": bin,
    "row of three": rowOfThree,
    "stack": stack,
    "swap": swap,
    "cans": cans,
    "sorting": sorting,
    "clutter": clutter,
    "tall before low": tallBeforeLow,
    "pick up": pickUp,
    "make way": makeWay,
    "come back": comeBack,
    "slabs": slabs,
    "shelf": shelf,
    "drawer": drawer,
    "two arms": twoArms,
    "handing over": handingOver,
    "UR10 and Robotiq": urRobotiq,
    "mobile base": mobileBase,
}
