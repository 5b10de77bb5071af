"""Writes the page of features: one table with formula, dimension, columns of the Jacobian, and a picture.

Frames, dimensions, units and orders are those of the registry, by the table of docs/features.md, which a test keeps
equal to the registry. The pictures draw values that the features have in small scenes.
"""

import re
from pathlib import Path

import numpy as np
from drawings import BLACK, BLUE, GRAY, GREEN, ORANGE, RED, Drawing
from feature_formulas import FORMULAS

import kinegraph as ry

TWO_FRAMES = """
base: { X: [0 0 0] }
a(base): { Q: "t(1.1 .1 .75) d(55 1 .6 .4)" }
b(base): { Q: "t(.45 .75 .1) d(25 0 0 1)" }
"""
TWO_SHAPES = """
base: {}
a(base): { Q: "t(1.1 .2 .75)", shape: sphere, size: [.28], contact: 1 }
b(base): { Q: "t(.3 .1 .15)", shape: sphere, size: [.35], contact: 1 }
"""
INTRODUCTION = """# Table of features

The pictures draw the value in orange. Axes are red (x), green (y) and blue (z). [Features](../features.md) shows how to
evaluate them.

The Jacobian has one column per dof of `q`. A hinge with the unit axis {math}`u` through the point {math}`c` turns a frame
below it with {math}`\\omega_a = u` and moves its origin with {math}`v_a = u \\times (p_a - c)`. A slide has
{math}`\\omega_a = 0` and {math}`v_a = u`. Frames that are not below the joint have {math}`\\omega_a = v_a = 0`. The column
follows from these two, as the table shows. {math}`p, q, R` are position, quaternion and rotation matrix, {math}`n` is the unit
normal from b to a, {math}`s_a, s_b` are the nearest points and {math}`d` is the signed distance of two shapes, {math}`c_i` are
centers of mass, and {math}`h` are half sides.

An objective of order 1 or 2 differentiates the value by backward differences of two or three slices. Scale and target act
on the result: {math}`\\text{scale} \\cdot (y - \\text{target})`.
"""


def tableRows(page: str) -> list[list[str]]:
    """Rows of the table of docs/features.md: feature, frames, rows, unit, order, value."""
    lines = page[page.index("| feature | frames |") :].split("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def frames(text: str) -> tuple[ry.Config, dict[str, tuple[np.ndarray, np.ndarray]]]:
    C = ry.Config()
    C.addText(text)
    return C, {f.name: (f.getPosition(), f.getRotationMatrix()) for f in C.getFrames()}


def drawFrames(name: str) -> Drawing:
    """Positions, rotations and axes of one or two frames."""
    d = Drawing()
    C, placed = frames(TWO_FRAMES)
    (pa, Ra), (pb, Rb), zero = placed["a"], placed["b"], np.zeros(3)
    with_b = name.endswith(("Diff", "Rel")) or name.startswith("scalarProduct")
    pb, Rb = (pb, Rb) if with_b else (zero, np.eye(3))
    label = "b" if with_b else ""
    if name.startswith(("position", "pose")):
        d.axes(pa, Ra, "a")
        d.axes(pb, Rb, label)
        value = C.eval(ry.FS.positionDiff, ["a", "b"])[0] if with_b else C.eval(ry.FS.position, ["a"])[0]
        d.arrow(pb, pb + value)
    if name.startswith(("quaternion", "pose")):
        center = np.array([0.75, 0.2, 0.3]) if name.startswith("quaternion") else pb
        if name.startswith("quaternion"):
            d.axes(center, Rb, label, 0.55)
            d.axes(center, Ra, "a", 0.55)
        length = 0.45 if name.startswith("quaternion") else 0.3
        for i in (0, 2):
            d.arc(center, length * Rb[:, i], length * Ra[:, i])
    if name.startswith("vector"):
        i = "XYZ".index(name[6])
        center = np.array([0.6, 0.3, 0.25])
        d.axes(center, Ra, "a", 0.45)
        if not with_b:
            d.arrow(center, center + 0.7 * C.eval(ry.FS[name], ["a"])[0])
        elif name.endswith("Diff"):
            d.arrow(center, center + 0.7 * Rb[:, i], GRAY, 1.2)
            d.arrow(center + 0.7 * Rb[:, i], center + 0.7 * Ra[:, i])
            d.text(center + 0.7 * Rb[:, i], "b", GRAY)
        else:
            d.axes(center, Rb, "", 0.45)
            d.arrow(center, center + 0.7 * Rb @ C.eval(ry.FS[name], ["a", "b"])[0])
    if name.startswith("scalarProduct"):
        i, j = "XYZ".index(name[13]), "XYZ".index(name[14])
        center, colors = np.array([0.5, 0.4, 0.15]), (RED, GREEN, BLUE)
        d.arrow(center, center + 0.8 * Ra[:, i], colors[i])
        d.arrow(center, center + 0.8 * Rb[:, j], colors[j])
        d.text(center + 0.8 * Ra[:, i], "a")
        d.text(center + 0.8 * Rb[:, j], "b")
        d.arc(center, 0.4 * Ra[:, i], 0.4 * Rb[:, j], arrow=False)
        d.text(center, f"{C.eval(ry.FS[name], ['a', 'b'])[0][0]:.2f}", ORANGE, (-8, 16))
    return d


def drawGaze(_: str) -> Drawing:
    d = Drawing()
    C, placed = frames('camera: { X: "t(.1 .2 .1) d(62 0 1 0)" } object: { X: [1.4 .2 .2] }')
    (p, R), (o, _) = placed["camera"], placed["object"]
    xy = C.eval(ry.FS.gazeAt, ["object", "camera"])[0]
    foot = o - R[:, :2] @ xy
    d.axes(p, R, "camera", 0.3)
    d.line(p, p + 1.3 * (foot - p), BLUE, 1, dashed=True)
    d.ball(o, 0.06, BLACK)
    d.arrow(foot, o)
    return d


def arm(d: Drawing, angles: tuple[float, float], color: str = BLACK) -> list[np.ndarray]:
    points = [np.array([0.4, 0.0, 0.0])]
    for angle in np.cumsum(angles):
        points.append(points[-1] + 0.6 * np.array([np.cos(angle), 0, np.sin(angle)]))
    d.curve(points, color, 3)
    for point in points[:2]:
        d.ball(point, 0.06, color)
    return points


def drawJoints(name: str) -> Drawing:
    d = Drawing()
    if name == "qQuaternionNorms":
        center = np.array([0.6, 0.0, 0.35])
        d.ball(center, 0.5, filled=False)
        d.arrow(center, center + np.array([0.45, 0, 0.5]), BLACK, 1.4)
        d.arrow(center + np.array([0.33, 0, 0.37]), center + np.array([0.45, 0, 0.5]))
        d.text(center, "1", GRAY, (-34, 4))
        return d
    if name == "jointLimits":
        for angle in (0.1, 2.0):
            d.line([0.4, 0, 0], np.array([0.4 + 0.7 * np.cos(angle), 0, 0.7 * np.sin(angle)]), RED, 1.2, dashed=True)
    points = arm(d, (0.8, -0.6))
    starts = (np.array([0.4, 0, 0]), np.array([np.cos(0.8), 0, np.sin(0.8)]) * 0.4)
    d.arc(points[0], starts[0], starts[1])
    d.text(points[0] + np.array([0.4, 0, 0.1]), "q1", ORANGE)
    if name == "qItself":
        d.arc(points[1], starts[1], 0.4 * np.array([np.cos(0.2), 0, np.sin(0.2)]))
        d.text(points[1] + np.array([0.4, 0, 0.25]), "q2", ORANGE)
    return d


def drawShapes(name: str) -> Drawing:
    d = Drawing()
    C, placed = frames(TWO_SHAPES)
    d.ball(placed["a"][0], 0.28)
    d.ball(placed["b"][0], 0.35)
    d.text(placed["a"][0], "a")
    d.text(placed["b"][0], "b")
    s_a, s_b = (C.eval(ry.FS[f"pairCollision_p{i}"], ["a", "b"])[0] for i in (1, 2))
    if name.endswith("p1") or name.endswith("p2"):
        d.ball(s_a if name.endswith("p1") else s_b, 0.05, ORANGE)
    elif name.endswith("normal"):
        d.arrow(s_b, s_b + 0.5 * C.eval(ry.FS.pairCollision_normal, ["a", "b"])[0])
    elif name.endswith("vector"):
        d.arrow(s_b, s_b + C.eval(ry.FS.pairCollision_vector, ["a", "b"])[0])
    else:
        d.line(s_a, s_b, ORANGE, 2.2)
        d.text((s_a + s_b) / 2, f"{C.eval(ry.FS.distance, ['a', 'b'])[0][0]:.2f} m", ORANGE, (6, 12))
    return d


def drawOverlaps(name: str) -> Drawing:
    d = Drawing()
    centers = [np.array(c) for c in ([0.1, 0, 0.1], [0.55, 0, 0.35], [1.2, 0, 0.3])]
    for center in centers:
        d.ball(center, 0.33)
    for a, b in ((0, 1), (1, 2)):
        along = (centers[b] - centers[a]) / np.linalg.norm(centers[b] - centers[a])
        start, end = centers[b] - 0.33 * along, centers[a] + 0.33 * along
        if name == "pairCollisions" or a == 0:
            d.line(start, end, ORANGE, 2.6)
            d.text((start + end) / 2, f"y{a + 1}" if name == "pairCollisions" else "sum", ORANGE)
    return d


def drawFingers(name: str) -> Drawing:
    d = Drawing()
    center, fingers = np.array([0.6, 0, 0.3]), [np.array([-0.05, 0, 0.38]), np.array([1.3, 0, 0.3])]
    d.box(center, [0.5, 0.3, 0.5])
    for i, (finger, side) in enumerate(zip(fingers, (-1, 1))):
        d.ball(finger, 0.1, BLACK)
        start = np.array([center[0] + 0.25 * side, 0, finger[2]])
        d.arrow(start, finger - np.array([0.1 * side, 0, 0]))
        d.text(finger, f"v{i + 1}", ORANGE, (-4, -14))
    if name == "opposeCentral":
        d.line(fingers[0], fingers[1], BLUE, 1, dashed=True)
    return d


def drawBoxes(name: str) -> Drawing:
    d = Drawing()
    box = np.array([0.6, 0.2, 0.1])
    size = [1.0, 0.7, 0.5 if name == "insideBox" else 0.15]
    d.box(box, size)
    if name == "standingAbove":
        d.box(box + [0, 0, 0.55], [0.3, 0.3, 0.3], color=BLACK)
        d.line(box + [0.3, 0, 0.075], box + [0.3, 0, 0.4], ORANGE, 2.2)
    elif name == "aboveBox":
        point = box + [0.15, 0, 0.6]
        d.ball(point, 0.06, BLACK)
        d.line(point, box + [0.15, 0, 0.075], GRAY, 1, dashed=True)
        d.arrow(point, box + [0.5, 0, 0.6])
    else:
        point = box + [0.1, 0, 0.05]
        d.ball(point, 0.06, BLACK)
        d.arrow(point, box + [0.5, 0, 0.05])
        d.arrow(point, box + [0.1, 0, 0.25])
    return d


def drawMotion(name: str) -> Drawing:
    d = Drawing()
    _, placed = frames(TWO_FRAMES)
    R = placed["a"][1]
    if name.startswith("Align"):
        start, end = np.array([0.1, 0.1, 0.0]), np.array([1.1, 0.2, 0.45])
        d.axes(start, np.eye(3), "a", 0.5, name[5].lower())
        d.ball(start, 0.05, GRAY)
        d.ball(end, 0.05, BLACK)
        d.arrow(start, end)
        d.text(end, "b")
        return d
    center = np.array([0.5, 0.2, 0.25])
    d.axes(center, R, "a", 0.4)
    axis = np.array([0.1, 0.1, 0.75])
    d.line(center, center + axis, GRAY, 1, dashed=True)
    circle = [center + 0.8 * axis + 0.22 * np.array([np.cos(t), np.sin(t), 0]) for t in np.linspace(0, 5, 14)]
    d.curve(circle, arrow=True)
    if name == "linangVel":
        d.arrow(center, center + [0.8, 0, 0.05])
    return d


def drawMasses(name: str) -> Drawing:
    d = Drawing()
    masses = [np.array([0.1, 0, 0.5]), np.array([1.2, 0, 0.2])]
    for mass, radius in zip(masses, (0.16, 0.1)):
        d.ball(mass, radius, BLACK)
    if name == "energy":
        for mass in masses:
            d.arrow(mass, mass + [0.4, 0, 0.1])
            d.line(mass, [mass[0], 0, -0.2], BLUE, 1, dashed=True)
    else:
        center = 0.7 * masses[0] + 0.3 * masses[1]
        a = np.array([0.8, 0, 0.85])
        d.line(*masses, GRAY, 1, dashed=True)
        d.ball(center, 0.04, BLUE)
        d.text(a, "a")
        d.arrow(center, a)
    return d


def drawForces(name: str) -> Drawing:
    d = Drawing()
    center = np.array([0.55, 0, 0.35])
    if name == "physics":
        path = [np.array([0.1 + t, 0, 0.1 + 1.8 * t - 1.6 * t * t]) for t in np.linspace(0, 1.1, 12)]
        d.curve(path, GRAY, 1.2)
        for i in (0, 5, 11):
            d.box(path[i], [0.16, 0.16, 0.16], color=BLACK)
        d.arrow(path[5], path[5] - [0, 0, 0.4])
        return d
    d.box(center, [0.5, 0.35, 0.35], color=BLACK)
    d.line([-0.1, 0, 0.17], [1.3, 0, 0.17], GRAY, 2)
    foot = np.array([0.45, 0, 0.17])
    if name == "totalForce":
        d.arrow(center, center - [0, 0, 0.5])
        d.arrow(foot, foot + [0, 0, 0.6], BLUE)
    else:
        force = np.array([0.4, 0, 0.6])
        d.arrow(foot, foot + force, BLUE, 1.4)
        d.line(foot, foot + [0, 0, 0.6], GRAY, 1, dashed=True)
        d.arrow(foot, foot + [0.4, 0, 0])
    return d


DRAWERS = (
    (r"position|quaternion|pose|vector|scalarProduct", drawFrames),
    (r"gazeAt", drawGaze),
    (r"qItself|jointLimits|qQuaternionNorms", drawJoints),
    (r"distance|pairCollision_", drawShapes),
    (r"accumulatedCollisions|pairCollisions", drawOverlaps),
    (r"oppose", drawFingers),
    (r"aboveBox|insideBox|standingAbove", drawBoxes),
    (r"angularVel|linangVel|Align", drawMotion),
    (r"energy|EqCenterOfMass", drawMasses),
    (r"physics|totalForce|contactConstraints", drawForces),
)


def picture(name: str) -> str:
    """The drawing of a feature as SVG."""
    draw = next(draw for pattern, draw in DRAWERS if re.match(pattern, name))
    return draw(name).svg()


def writePage(features: Path, out: Path) -> None:
    """`features`: docs/features.md."""
    pictures = out.parent / "features"
    pictures.mkdir(parents=True, exist_ok=True)
    head = "| feature | frames | dimension | order | value, and column of the Jacobian |"
    lines = [INTRODUCTION, head, "|" + "---|" * 5]
    for feature, roles, dimension, unit, order, value in tableRows(features.read_text()):
        name = re.findall(r"`(\w+)`", feature)[0]
        if name not in FORMULAS:  # obsolete names
            lines.append(f"| {feature} | | | | {value} |")
            continue
        (pictures / f"{name}.svg").write_text(picture(name))
        y, column = FORMULAS[name]
        image = f"![{name}](features/{name}.svg)"
        size = f"{dimension}, {unit}" if unit != "-" else dimension
        named = f"{feature} <br> {image}"
        in_words = f"{value} <br> " if re.search("[a-z]{3}", value) else ""  # not the same formula again
        formulas = f"{{math}}`y = {y}` <br> {in_words}{{math}}`J_i = {column}`"
        cells = [named, roles, size, order, formulas]
        lines.append(f"| {' | '.join(cells)} |")
    out.write_text("\n".join([*lines, ""]))
