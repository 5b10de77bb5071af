"""Part 11: collision-free motions to a goal.

`planMotion` searches, shortens, verifies and times a motion. Without one, it explains the reason.

    python 11_plan_motions.py [FOLDER]     saves a picture of each search and its path in the folder
"""

import sys
from pathlib import Path

import numpy as np

from robotic import ry


def show(C: ry.Config, plan: ry.MotionPlan, what: str, camera: list[float], at: list[float]) -> None:
    """Plays the motion, and saves a picture of the trees and the path if a folder is passed."""
    C.view_path(plan.path, plan.duration, True, what)
    if len(sys.argv) > 1:
        picture = plan.picture(C)
        picture.view(offscreen=True)
        picture.viewer().setWindow(what, 480, 360)
        picture.viewer().setCamera(camera, at)
        picture.viewer().savePng(str(Path(sys.argv[1]) / f"{what.replace(' ', '_')}.png"))


# Among obstacles: around a column, 1 cm from everything, to a target of the gripper.
C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
column = C.addFrame("column", "table").setShape(ry.ST.ssBox, [0.1, 0.1, 0.8, 0.02])
column.setRelativePosition([0.0, 0.35, 0.4]).setContact(1)
q = C.getJointState()
turn = np.array([0.6, 0, 0, 0, 0, 0, 0])
start = q - turn
plan = ry.planMotion(C, q + turn, start, margin=0.01)
print(plan.explain())
assert plan.feasible and plan.clearance() > 0.0099
show(C, plan, "around the column", [1.3, 1.5, 1.8], [0.0, 0.1, 1.15])

# With a glass: the gripper keeps its direction along the whole path.
C.delFrame("column")
C.setJointState([0.0, -0.5, 0.0, -2.0, 0.0, 2.0, 0.0])
up, _ = C.eval(ry.FS.vectorZ, ["l_gripper"])
upright = ry.MotionConstraint(ry.FS.vectorZ, ["l_gripper"], target=up)
plan = ry.planMotion(C, {"l_gripper": {"position": [0.3, 0.4, 1.1], "z": up}}, constraints=[upright])
print(plan)
assert plan.feasible
for t in np.linspace(0, plan.duration, 50):
    C.setJointState(plan.eval(t)[0])
    assert np.allclose(C.eval(ry.FS.vectorZ, ["l_gripper"])[0], up, atol=2e-3)
show(C, plan, "with a glass", [1.2, 1.3, 1.6], [0.1, 0.2, 1.15])

# Two arms at once.
C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandasTable.g"))
left, right = C.getFrame("l_gripper").getPosition(), C.getFrame("r_gripper").getPosition()
plan = ry.planMotion(
    C, {"l_gripper": 0.6 * left + 0.4 * right, "r_gripper": right + np.array([0, 0.2, 0.2])}, margin=0.02
)
print(plan)
assert plan.feasible
show(C, plan, "two arms", [0.0, 1.9, 1.9], [0.0, 0.0, 1.1])

# A mobile base through a door, and a door that is too narrow.
for width in (0.5, 0.25):
    C = ry.Config()
    C.addFrame("floor")
    base = C.addFrame("base", "floor").setJoint(ry.JT.transXYPhi, [-2.0, -2.0, -4.0, 2.0, 2.0, 4.0])
    C.addFrame("body", "base").setShape(ry.ST.ssBox, [0.5, 0.3, 0.4, 0.02]).setContact(1)
    for name, side in (("left", 1), ("right", -1)):
        wall = C.addFrame(name, "floor").setShape(ry.ST.box, [0.1, 3.0, 1.0]).setContact(1)
        wall.setRelativePosition([0, side * (1.5 + width / 2), 0])
    plan = ry.planMotion(C, [1.0, 1.0, 1.57], [-1.0, 1.2, 1.57], max_evaluations=20000)
    print(plan)
    assert plan.feasible == (width > 0.3)
    if plan.feasible:
        show(C, plan, "through the door", [-2.6, 0.2, 2.6], [0.0, 0.3, 0.0])
print(plan.message)

# Around a point cloud of a camera.
C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
around = np.linspace(0, 2 * np.pi, 60, endpoint=False)
ring = np.stack([0.06 * np.cos(around), 0.35 + 0.06 * np.sin(around)], axis=1)
points = np.array([[x, y, z] for z in np.linspace(0, 0.8, 60) for x, y in ring])
C.addFrame("seen", "table").setPointCloud(points).setContact(1)
plan = ry.planMotion(C, q + turn, start, margin=0.01)
print(plan)
assert plan.feasible
show(C, plan, "around what was seen", [1.3, 1.5, 1.8], [0.0, 0.1, 1.15])
