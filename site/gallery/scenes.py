"""Shapes, joints and looks of scenes."""

from typing import Any

import numpy as np

import kinegraph as ry

Loop = tuple[ry.Config, Any, float]
PANDA = ([1.5, 2.1, 1.7], [0.0, 0.15, 0.95])
TWO_ARMS = ([0.3, 3.0, 2.0], [0, 0.1, 0.9])
VIEW = {
    "shapes": ([1.1, -3.6, 1.3], [1.1, 0, 0.2]),
    "colors_and_opacity": ([0.5, 2.2, 0.9], [0.5, 0, 0.2]),
    "a_mesh_from_arrays": ([1.1, 1.1, 0.9], [0, 0, 0]),
    "a_point_cloud": ([1.3, 1.3, 1.1], [0, 0, 0.5]),
    "lines_of_a_path": ([1.3, -1.5, 1.0], [0, 0, 0.4]),
    "a_mimic_joint": ([0.7, -3.5, 0.9], [0.7, 0, 0.3]),
    "joint_types": ([0.4, -2.6, 1.6], [0, 0, 0.2]),
    "double_pendulum": ([0.2, -3.2, 1.3], [0, 0, 1.2]),
    "two_arms": TWO_ARMS,
    "prefixes": ([0.8, 4.0, 1.5], [0.8, 0, 0.5]),
}


def shapes() -> ry.Config:
    """Primitive shapes: box, sphere, capsule, cylinder, and the rounded ssBox and ssCylinder."""
    C = ry.Config()
    sizes = {"box": "[.3 .3 .3]", "sphere": "[.18]", "capsule": "[.2 .1]", "cylinder": "[.3 .15]"}
    sizes |= {"ssBox": "[.3 .3 .3 .08]", "ssCylinder": "[.3 .15 .05]"}
    for i, (shape, size) in enumerate(sizes.items()):
        color = f"[{0.9 - 0.12 * i} .5 {0.2 + 0.12 * i}]"
        C.addFrame(shape, "", f"shape: {shape}, size: {size}, color: {color}").setPosition([0.45 * i, 0, 0.2])
    return C


def colors_and_opacity() -> ry.Config:
    """Four numbers of `color` are red, green, blue and opacity."""
    C = ry.Config()
    for i, opacity in enumerate((1.0, 0.7, 0.4, 0.15)):
        ball = C.addFrame(f"ball{i}").setShape(ry.ST.sphere, [0.2]).setPosition([0.35 * i, 0, 0.2])
        ball.setColor([0.9, 0.4, 0.1, opacity])
    C.addFrame("wall").setShape(ry.ST.box, [1.6, 0.05, 0.4]).setPosition([0.5, -0.4, 0.2]).setColor([0.2, 0.4, 0.8])
    return C


def convex_hull() -> ry.Config:
    """The convex hull of points, rounded by a radius: a shape of type ssCvx."""
    C = ry.Config()
    points = np.random.default_rng(1).normal(size=(20, 3)) * 0.15
    C.addFrame("stone").setConvexMesh(points, radius=0.02).setPosition([0, 0, 0.4]).setColor([0.6, 0.5, 0.4])
    return C


def a_mesh_from_arrays() -> ry.Config:
    """A mesh from arrays of vertices and triangles: a wavy sheet."""
    C = ry.Config()
    n = 30
    x, y = np.meshgrid(np.linspace(-0.6, 0.6, n), np.linspace(-0.6, 0.6, n))
    vertices = np.stack([x, y, 0.1 * np.sin(8 * x) * np.cos(8 * y)], axis=-1).reshape(-1, 3)
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    triangles = np.concatenate([np.stack([i, i + 1, i + n], 1), np.stack([i + 1, i + n + 1, i + n], 1)])
    C.addFrame("sheet").setMesh(vertices, triangles).setColor([0.2, 0.6, 0.7])
    return C


def a_point_cloud() -> ry.Config:
    """A point cloud with a color per point."""
    C = ry.Config()
    points = np.random.default_rng(0).normal(size=(4000, 3))
    points = 0.4 * points / np.linalg.norm(points, axis=1, keepdims=True)
    colors = (255 * (points / 0.8 + 0.5)).astype(np.uint8)
    C.addFrame("cloud").setPointCloud(points, colors).setPosition([0, 0, 0.5])
    return C


def lines_of_a_path() -> ry.Config:
    """Lines through the points of a helix."""
    C = ry.Config()
    t = np.linspace(0, 4 * np.pi, 200)
    points = np.stack([0.3 * np.cos(t), 0.3 * np.sin(t), 0.06 * t], 1)
    ends = np.stack([points[:-1], points[1:]], 1).reshape(-1, 3)  # two points per line
    C.addFrame("helix").setLines(ends).setColor([0.9, 0.3, 0.1])
    return C


def joint_types() -> Loop:
    """Hinges, slides and a planar joint, moved together."""
    C = ry.Config()
    C.addText("""
    base: { shape: box, size: [2.2 .6 .05], color: [.3] }
    door(base): { pre: [-.8 0 .05], joint: hingeZ }
    leaf(door): { Q: [.2 0 .25], shape: box, size: [.4 .03 .5], color: [.8 .5 .2] }
    lift(base): { pre: [0 0 .1], joint: transZ }
    deck(lift): { Q: [0 0 .1], shape: box, size: [.3 .3 .06], color: [.2 .6 .3] }
    cart(base): { pre: [.6 0 .1], joint: transXYPhi }
    body(cart): { shape: ssBox, size: [.3 .2 .12 .03], color: [.2 .4 .8] }
    """)
    t = np.linspace(0, 2 * np.pi, 40)
    q = np.stack([np.sin(t), 0.2 - 0.2 * np.cos(t), 0.2 * np.sin(t), 0.15 * np.sin(2 * t), np.sin(t)], 1)
    return C, q, 3.0


def a_mimic_joint() -> Loop:
    """Joints that follow another one, with their own scale: a scissor lift."""
    C = ry.Config()
    text = "base: {}\n a0(base): { pre: [0 0 .1], joint: hingeY, q: .5 }\n"
    text += "s0(a0): { Q: [.3 0 0], shape: box, size: [.6 .04 .05], color: [.8 .4 .1] }\n"
    for i in range(1, 5):
        scale = -2 if i % 2 else 2
        text += f"a{i}(a{i - 1}): {{ pre: [.6 0 0], joint: hingeY, mimic: a0, joint_scale: {scale} }}\n"
        text += f"s{i}(a{i}): {{ Q: [.3 0 0], shape: box, size: [.6 .04 .05], color: [.8 {0.4 + 0.1 * i} .1] }}\n"
    C.addText(text)
    return C, -0.6 - 0.5 * np.sin(np.linspace(0, 2 * np.pi, 30))[:, None], 3.0


def double_pendulum() -> Loop:
    """A double pendulum without motors, simulated for two seconds."""
    C = ry.Config()
    C.addText("""
    world: {}
    j1(world): { pre: [0 0 1.5], joint: hingeY, q: 2, noMotor: true }
    b1(j1): { Q: [0 0 -.25], shape: capsule, size: [.5 .04], mass: 1, color: [.8 .3 .1] }
    j2(j1): { pre: [0 0 -.5], joint: hingeY, q: 1, noMotor: true }
    b2(j2): { Q: [0 0 -.25], shape: capsule, size: [.5 .04], mass: 1, color: [.1 .4 .8] }
    """)
    S, path = ry.Simulation(C), [C.getJointState()]
    for _ in range(100):
        S.step([], 0.02, ry.ControlMode.none)
        path.append(C.getJointState())
    return C, np.array(path), 2.0


def two_arms() -> ry.Config:
    """Two arms at one table: a scene that comes with the package."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    return C


def prefixes() -> ry.Config:
    """Three copies of one robot in one scene: a prefix keeps their names apart."""
    C = ry.Config()
    for i in range(3):
        root = C.addFile(ry.raiPath("panda/panda.g"), f"arm{i}_")
        root.setPosition([0.8 * i, 0, 0])
    return C


def random_boxes() -> ry.Config:
    """Two hundred boxes at random poses."""
    C, rng = ry.Config(), np.random.default_rng(0)
    for i in range(200):
        box = C.addFrame(f"b{i}").setShape(ry.ST.ssBox, [*rng.uniform(0.05, 0.25, 3), 0.01])
        box.setPosition(rng.normal(size=3) * [0.5, 0.5, 0.2] + [0, 0, 0.6])
        rotation = rng.normal(size=4)
        box.setQuaternion(rotation / np.linalg.norm(rotation))
        box.setColor(rng.uniform(0.2, 0.9, 3))
    return C
