"""Simulations, tasks and cameras."""

import numpy as np

import kinegraph as ry

from .motions import panda
from .scenes import PANDA, Loop

VIEW = dict.fromkeys(
    ("put_a_cup_on_a_tray", "stack_two_boxes", "clear_the_way", "grasp_and_lift", "depth_as_points"), PANDA
)
VIEW["a_box_in_flight"] = ([0.3, -4.2, 1.2], [0, 0, 0.8])
VIEW |= {
    "conveyor": ([0.9, -1.5, 1.7], [0.1, 0, 0.5]),
    "domino": ([0.4, -1.7, 0.9], [0.6, 0, 0.1]),
    "friction_on_a_slope": ([0.6, -2.4, 1.5], [0, 0, 0.4]),
}


def simulated(C: ry.Config, seconds: float, rate: int = 15) -> np.ndarray:
    """Poses of all frames while a scene moves by itself."""
    S, frames = ry.Simulation(C), [C.getFrameState()]
    for _ in range(round(seconds * rate)):
        S.multi_step(1 / rate, 0.01)
        frames.append(C.getFrameState())
    return np.array(frames)


def falling_boxes() -> Loop:
    """Twenty boxes fall onto each other."""
    C, rng = ry.Config(), np.random.default_rng(0)
    for i in range(20):
        box = C.addFrame(f"b{i}").setShape(ry.ST.ssBox, [0.15, 0.15, 0.15, 0.01]).setMass(0.5)
        rotation = rng.normal(size=4)
        box.setPosition([*rng.uniform(-0.2, 0.2, 2), 0.2 + 0.2 * i]).setQuaternion(rotation / np.linalg.norm(rotation))
        box.setColor(rng.uniform(0.2, 0.9, 3))
    return C, simulated(C, 2.5), 2.5


def a_tower_that_stands() -> Loop:
    """A tower of ten boxes stands, and a ball hits it."""
    C = ry.Config()
    for i in range(10):
        box = C.addFrame(f"b{i}").setShape(ry.ST.ssBox, [0.15, 0.15, 0.1, 0.005]).setMass(0.3)
        box.setPosition([0, 0, 0.05 + 0.1 * i]).setColor([0.9, 0.3 + 0.06 * i, 0.2])
    C.addText("ramp: { X: 't(-.9 0 .75) d(30 0 1 0)', shape: box, size: [1 .3 .03], contact: 1, color: [.4] }")
    C.addFrame("ball").setShape(ry.ST.sphere, [0.08]).setMass(3.0).setPosition([-1.25, 0, 1.1]).setColor(
        [0.1, 0.3, 0.8]
    )
    return C, simulated(C, 2.5), 2.5


def domino() -> Loop:
    """Dominoes: the first one leans."""
    C = ry.Config()
    for i in range(12):
        stone = C.addFrame(f"d{i}").setShape(ry.ST.ssBox, [0.03, 0.12, 0.25, 0.003]).setMass(0.2)
        stone.setPosition([0.11 * i, 0, 0.125]).setColor([0.2, 0.3 + 0.05 * i, 0.8])
    C.getFrame("d0").setPose("t(0 0 .128) d(16 0 1 0)")
    return C, simulated(C, 1.6, 20), 1.6


def friction_on_a_slope() -> Loop:
    """Three boxes on a slope of 20 degrees, with friction 0, .3 and 1."""
    C = ry.Config()
    C.addText("slope: { X: 't(0 0 .5) d(20 0 1 0)', shape: box, size: [2 1 .05], contact: 1, friction: 0 }")
    for i, friction in enumerate((0, 0.4, 2)):  # a contact has the mean of both
        box = C.addFrame(f"b{i}", "slope").setRelativePosition([-0.8, 0.3 * i - 0.3, 0.1]).setMass(1.0)
        box.setShape(ry.ST.ssBox, [0.15, 0.15, 0.15, 0.01]).setColor([0.9 - 0.3 * i, 0.4, 0.2 + 0.3 * i])
        box.setJoint(ry.JT.free).setAttributes({"friction": friction, "noMotor": True})
    return C, simulated(C, 1.2, 20), 1.2


def conveyor() -> Loop:
    """A conveyor belt: `surfaceVelocity` moves the surface, not the shape."""
    C = ry.Config()
    C.addFrame("belt", "", "shape: box, size: [2 .3 .1], color: [.2], surfaceVelocity: [.5 0 0]").setPosition(
        [0, 0, 0.5]
    )
    for i, mass in enumerate([0.05, 0.5, 2.0]):
        box = C.addFrame(f"box{i}").setShape(ry.ST.ssBox, [0.1, 0.1, 0.1, 0.005]).setMass(mass)
        box.setPosition([-0.8 + 0.3 * i, 0, 0.6]).setColor([1, 0.6, 0.2])
    return C, simulated(C, 2.5), 2.5


def grasp_and_lift() -> Loop:
    """A gripper closes on a box of 1 kg and lifts it: friction holds it."""
    C = panda()
    at = np.array([0.0, 0.3, 0.68])
    C.addFrame("box").setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.005]).setPosition(at).setMass(1.0).setColor(
        [1, 0.5, 0]
    )
    down, up = (
        ry.solveIk(C, {"l_gripper": {"position": at + [0, 0, z], "z": [0, 0, 1], "y": [1, 0, 0]}}).q for z in (0, 0.25)
    )
    C.setJointState(down)
    S, frames = ry.Simulation(C), []
    S.closeGripper("l_gripper", force=30.0)
    while not S.gripperIsDone("l_gripper"):
        S.step()
    S.setSplineRef([up], [1.0])
    for _ in range(24):
        S.multi_step(0.05, 0.01)
        frames.append(C.getFrameState())
    return C, np.array(frames), 2.0


def tray_scene() -> ry.Config:
    """A cup and a jug on a table, and a tray."""
    C = panda()
    tray = C.addFrame("tray", "table").setRelativePosition([0.25, 0.35, 0.055])
    tray.setShape(ry.ST.ssBox, [0.09, 0.09, 0.01, 0.004]).setContact(1).setColor([0.3, 0.6, 0.3])
    for name, parent, at, color in (
        ("cup", "table", [-0.3, 0.25, 0.1], [1, 0.5, 0]),
        ("jug", "table", [0.0, 0.4, 0.1], [0, 0.5, 1]),
    ):
        thing = C.addFrame(name, parent).setRelativePosition(at).setJoint(ry.JT.rigid)
        thing.setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.005]).setContact(1).setColor(color)
    return C


def put_a_cup_on_a_tray() -> Loop:
    """planTask: a goal of literals, and the motion that reaches it."""
    C = tray_scene()
    plan = ry.planTask(C, "(on tray cup)")
    return C, plan.frames(C), plan.duration / 2


def clear_the_way() -> Loop:
    """planTask: the jug stands on the tray and has to leave first."""
    C = tray_scene()
    C.attach("tray", "jug")
    C.getFrame("jug").setRelativePosition([0, 0, 0.055])
    plan = ry.planTask(C, "(on tray cup) (on table jug)")
    return C, plan.frames(C), plan.duration / 3


def stack_two_boxes() -> Loop:
    """planTask: one box on the other."""
    C = panda()
    for name, x in (("a", -0.25), ("b", 0.25)):
        box = C.addFrame(name, "table").setRelativePosition([x, 0.3, 0.08]).setJoint(ry.JT.rigid)
        box.setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.003]).setContact(1).setColor([0.9, 0.5 + x, 0.2])
        box.setAttributes({"logical": {"is_object": True, "is_place": True, "is_box": True}})
    C.getFrame("l_gripper").setAttributes({"logical": {"is_gripper": True}})
    C.getFrame("table").setAttributes({"logical": {"is_place": True}})
    plan = ry.planTask(C, "(on b a)")
    return C, plan.frames(C), plan.duration / 2


def depth_as_points() -> ry.Config:
    """A depth picture of a camera in the scene, as a point cloud."""
    C = panda()
    C.addFrame("box").setShape(ry.ST.ssBox, [0.1, 0.15, 0.2, 0.01]).setPosition([0.2, 0.3, 0.75]).setColor([1, 0.5, 0])
    C.addFrame("cam", "", "focalLength: 1, width: 160, height: 120").setPose("t(0 1.3 1.3) d(180 0 0 1) d(-125 1 0 0)")
    camera = ry.CameraView(C)
    camera.setCamera("cam")
    color, depth = camera.computeImageAndDepth()
    points = ry.depthImage2PointCloud(depth, camera.getFxycxy())
    scene = ry.Config()
    cloud = scene.addFrame("cloud").setPose(C.getFrame("cam").getPose())
    cloud.setPointCloud(points.reshape(-1, 3), color.reshape(-1, 3))
    return scene


def distances() -> ry.Config:
    """Nearest points of all pairs that may collide, as lines."""
    C, rng = ry.Config(), np.random.default_rng(3)
    for i in range(6):
        shape = C.addFrame(f"s{i}").setShape(ry.ST.ssBox, [0.2, 0.3, 0.1, 0.02]).setContact(1)
        rotation = rng.normal(size=4)
        shape.setPosition(rng.normal(size=3) * 0.45 + [0, 0, 0.8]).setQuaternion(rotation / np.linalg.norm(rotation))
        shape.setColor([0.4, 0.6, 0.8])
    points = C.getNearestPoints()[1]
    for i, pair in enumerate(points):
        C.addFrame(f"l{i}").setLines(pair).setColor([0.9, 0.2, 0.1])
    return C


def a_proof_that_there_is_no_path() -> ry.Config:
    """A ball that does not fit through a gap: planMotion proves it. The message names the ball and the walls."""
    C = ry.Config()
    C.addText(
        "base: {}\n body(base): { joint: transXY, limits: [-1 -.4 1 .4], shape: sphere, size: [.15], contact: 1 }"
    )
    for name, y in (("left", 0.35), ("right", -0.35)):
        wall = C.addFrame(name).setShape(ry.ST.box, [0.2, 0.5, 0.4]).setPosition([0, y, 0]).setContact(1)
        wall.setColor([0.7, 0.4, 0.3])
    plan = ry.planMotion(C, [0.8, 0.0], [-0.8, 0.0], max_evaluations=1000)
    assert plan.status == ry.PlanStatus.infeasible
    return C


def a_box_in_flight() -> Loop:
    """KOMO with physics: a box flies freely through three slices' equations of motion."""
    C = ry.Config()
    C.addText(
        "world: {}\n box(world): { joint: free, q: [-.6 0 .2 1 0 0 0], mass: 1, shape: ssBox, size: [.2 .2 .2 .02] }"
    )
    C.getFrame("box").setColor([0.9, 0.5, 0.2])
    komo = ry.KOMO(C, 1, 24, 2, False)
    komo.addControlObjective([], 2, 1e-3)
    komo.addObjective([0.1, 1.0], ry.FS.physics, ["box"], ry.OT.eq, [1.0], [], order=2)
    komo.addObjective([1.0], ry.FS.position, ["box"], ry.OT.eq, [10.0], [0.6, 0, 0.2])
    ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    return C, komo.getPath(), 1.5
