#!/usr/bin/env python3
"""Makes the figures of these pages from what the library computes.

python docs/theory/make_figures.py [FOLDER]      (this folder if none is given)
"""

import sys
from pathlib import Path

import numpy as np

import kinegraph as ry

BLUE, ORANGE, GRAY, INK = "#26c", "#e70", "#bbb", "#444"


class Chart:
    """A picture in a box of data coordinates."""

    def __init__(self, x: tuple[float, float], y: tuple[float, float], size: tuple[int, int] = (420, 240)):
        self.x, self.y, self.size, self.parts = x, y, size, []

    def at(self, x: float, y: float) -> tuple[float, float]:
        w, h = self.size
        return (
            40 + (w - 50) * (x - self.x[0]) / (self.x[1] - self.x[0]),
            h - 30 - (h - 40) * (y - self.y[0]) / (self.y[1] - self.y[0]),
        )

    def line(self, points: np.ndarray, color: str = BLUE, width: float = 1.8, dashed: bool = False) -> None:
        text = " ".join("{:.1f},{:.1f}".format(*self.at(*point)) for point in points)
        dash = ' stroke-dasharray="4 3"' if dashed else ""
        self.parts.append(f'<polyline points="{text}" fill="none" stroke="{color}" stroke-width="{width}"{dash}/>')

    def box(self, x: float, y: float, w: float, h: float, color: str, opacity: float = 1.0) -> None:
        (x1, y1), (x2, y2) = self.at(x, y + h), self.at(x + w, y)
        self.parts.append(
            f'<rect x="{x1:.1f}" y="{y1:.1f}" width="{x2 - x1:.1f}" height="{y2 - y1:.1f}" fill="{color}" '
            f'fill-opacity="{opacity}"/>'
        )

    def text(self, x: float, y: float, text: str, color: str = INK, anchor: str = "start") -> None:
        px, py = self.at(x, y)
        self.parts.append(f'<text x="{px:.1f}" y="{py:.1f}" fill="{color}" text-anchor="{anchor}">{text}</text>')

    def axes(self, of_x: str, of_y: str) -> None:
        corners = [(self.x[0], self.y[1]), (self.x[0], self.y[0]), (self.x[1], self.y[0])]
        self.line(np.array(corners), INK, 1.0)
        w, h = self.size
        self.parts.append(f'<text x="{w - 10}" y="{h - 8}" text-anchor="end" fill="{INK}">{of_x}</text>')
        self.parts.append(f'<text x="44" y="16" fill="{INK}">{of_y}</text>')

    def save(self, file: Path) -> None:
        w, h = self.size
        head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}"'
        style = 'font-family="sans-serif" font-size="11"'
        file.write_text(f"{head} {style}>{''.join(self.parts)}</svg>\n")


def band(folder: Path) -> None:
    """The pattern of J and of its square, of a problem with three joints, eight slices and order 2."""
    C = ry.Config()
    C.addText("base: {}, a(base): { joint: hingeX }, b(a): { joint: hingeY }, c(b): { joint: hingeZ }")
    komo = ry.KOMO(C, 1, 8, 2, False)
    komo.addControlObjective([], 2, 1.0)
    nlp = komo.nlp()
    x = np.zeros(nlp.dimension)
    J = np.array([nlp.evaluate(x + e)[0] - nlp.evaluate(x)[0] for e in np.eye(nlp.dimension)]).T  # phi is linear
    chart = Chart((0, 52), (0, 24), (520, 270))
    for left, matrix, name in ((0, J, "J"), (28, J.T @ J, "JᵀJ")):
        rows, columns = np.nonzero(matrix)
        for row, column in zip(rows, columns):
            chart.box(left + column, 23 - row, 0.85, 0.85, BLUE)
        chart.text(left + 12, -2.2, name, anchor="middle")
    chart.save(folder / "band.svg")


def penalty(folder: Path) -> None:
    """max(0, lambda + mu c)^2 / (2 mu) for three multipliers."""
    mu, c = 4.0, np.linspace(-1, 0.8, 200)
    chart = Chart((-1, 0.8), (0, 3))
    chart.axes("c", "penalty")
    chart.line(np.array([[0, 0], [0, 3]]), GRAY, 1.0, dashed=True)
    for multiplier, color in ((0.0, GRAY), (1.0, BLUE), (2.0, ORANGE)):
        t = np.maximum(0, multiplier + mu * c)
        chart.line(np.stack([c, np.minimum(t * t / (2 * mu), 3)], 1), color)
        chart.text(-0.95, 2.6 - 0.3 * multiplier, f"λ = {multiplier:.0f}", color)
    chart.save(folder / "penalty.svg")


def advancement(folder: Path) -> None:
    """Steps of conservative advancement of an arm that swings past a post."""
    C = ry.Config()
    C.addText("""
    base: {}
    arm(base): { joint: hingeZ }
    link(arm): { shape: capsule, size: [.9 .05], Q: "t(.5 0 0) d(90 0 1 0)", contact: 1 }
    post(base): { Q: [.6 .3 0], shape: sphere, size: [.1], contact: 1 }
    """)
    start, goal, reach = -1.2, 0.15, 1.05

    def distance(s: float) -> float:
        C.setJointState([start + s * (goal - start)])
        return -float(C.eval(ry.FS.negDistance, ["link", "post"])[0][0])

    s = np.linspace(0, 1, 120)
    chart = Chart((0, 1), (0, 0.8))
    chart.axes("s", "distance, m")
    speed, at = (goal - start) * reach, 0.0
    while at < 1:
        d = distance(at)
        after = min(1.0, at + d / speed)
        chart.line(np.array([[at, d], [after, d - speed * (after - at)]]), ORANGE, 1.4)
        chart.line(np.array([[at, 0], [at, d]]), GRAY, 1.0, dashed=True)
        at = after
    chart.line(np.array([[x, distance(x)] for x in s]))
    chart.save(folder / "advancement.svg")


def cells(folder: Path) -> None:
    """Closed and reached cells of a ball between two walls."""
    radius, side = 0.15, 0.05
    x, y = np.arange(-1, 1, side) + side / 2, np.arange(-0.4, 0.4, side) + side / 2
    walls = [((-0.1, 0.1), (0.1, 0.6)), ((-0.1, 0.1), (-0.6, -0.1))]

    def depth(px: float, py: float) -> float:
        gaps = [[max(low - p, p - high) for p, (low, high) in zip((px, py), wall)] for wall in walls]
        return min(float(np.linalg.norm(np.maximum(gap, 0))) or max(gap) for gap in gaps)

    limit = radius - 0.5 * side * np.sqrt(2)
    closed = np.array([[depth(a, b) < limit for b in y] for a in x])
    reached, todo = np.zeros_like(closed), [(2, len(y) // 2)]
    while todo:
        i, j = todo.pop()
        if 0 <= i < len(x) and 0 <= j < len(y) and not closed[i, j] and not reached[i, j]:
            reached[i, j] = True
            todo += [(i + a, j + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
    assert not reached[-3, len(y) // 2]  # the proof
    chart = Chart((-1, 1), (-0.6, 0.6), (520, 320))
    for i, a in enumerate(x):
        for j, b in enumerate(y):
            color = GRAY if closed[i, j] else BLUE if reached[i, j] else "#eee"
            chart.box(a - 0.45 * side, b - 0.45 * side, 0.9 * side, 0.9 * side, color, 0.8)
    for (x1, x2), (y1, y2) in walls:
        chart.box(x1, y1, x2 - x1, y2 - y1, ORANGE, 0.5)
    for place, name in ((-0.8, "start"), (0.8, "goal")):
        t = np.linspace(0, 2 * np.pi, 40)
        chart.line(np.stack([place + radius * np.cos(t), radius * np.sin(t)], 1), INK, 1.4)
        chart.text(place, 0.2, name, anchor="middle")
    chart.save(folder / "cells.svg")


def slip(folder: Path) -> None:
    """Slip of a box of 1 kg while the hand lifts it and rotates."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    at = np.array([0.0, 0.3, 0.68])
    C.addFrame("box").setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.005]).setPosition(at).setMass(1.0)
    target = {"position": at, "z": [0, 0, 1], "y": [1, 0, 0]}
    down = ry.solveIk(C, {"l_gripper": target}).q
    up = ry.solveIk(C, {"l_gripper": {**target, "position": [0.0, 0.3, 0.88]}}).q
    C.setJointState(down)
    S = ry.Simulation(C)
    S.closeGripper("l_gripper", force=30.0)
    while not S.gripperIsDone("l_gripper"):
        S.step()
    before = C.getFrame("box").getPosition(C.getFrame("l_gripper"))
    S.setSplineRef([up, up + np.eye(7)[0]], [1.0, 2.0])
    times, slips = np.arange(0, 2.5, 0.02), []
    for _ in times:
        S.multi_step(0.02, 0.01)
        slips.append(1e6 * np.linalg.norm(C.getFrame("box").getPosition(C.getFrame("l_gripper")) - before))
    chart = Chart((0, 2.5), (0, 100))
    chart.axes("time, s", "slip, µm")
    chart.line(np.stack([times, np.minimum(slips, 100)], 1))
    for value in (50, 100):
        chart.text(-0.04, value - 2, str(value), anchor="end")
    chart.save(folder / "slip.svg")


FIGURES = [band, penalty, advancement, cells, slip]

if __name__ == "__main__":
    for make in FIGURES:
        make(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
