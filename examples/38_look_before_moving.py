"""Look before moving.

A camera at the wrist looks, the robot plans and picks, looks again and places, while somebody moves things.
"""

import numpy as np

import kinegraph as ry

C = ry.Config()  # what the robot believes: nothing stands on the table but a cube
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.getFrame("cameraWrist").setAttributes({"width": 320, "height": 240})
C.addFrame("tray", "table").setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.005]).setRelativePosition([0.3, 0.35, 0.06])
C.getFrame("tray").setContact(1)
cube = C.addFrame("cube", "table").setRelativePosition([-0.3, 0.3, 0.075]).setJoint(ry.JT.rigid)
cube.setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.004]).setContact(1).setMass(0.1).setAttributes({"friction": 1.0})

world = C.copy()  # what is there: the cube lies elsewhere, and a bottle and a carton are in the way
world.getFrame("cube").setRelativePosition([-0.27, 0.34, 0.075])
things = {"bottle": ([0.07, 0.07, 0.3], [0.0, 0.4, 0.8]), "carton": ([0.12, 0.05, 0.2], [0.16, 0.15, 0.75])}
for name, (size, at) in things.items():
    world.addFrame(name, "table").setShape(ry.ST.ssBox, [*size, 0.005]).setPosition(at).setJoint(ry.JT.rigid)
    world.getFrame(name).setContact(1).setMass(0.5)
bot = ry.BotOp(world)
map = ry.OccupancyMap(C, region=[[-0.5, 0, 0.66], [0.5, 0.7, 1.1]], cell=0.02)


def look(moving: list[str]) -> dict[str, np.ndarray | None]:
    """Updates the belief by an image of the camera at the wrist, and returns the poses of these objects."""
    there = bot.getWorld()
    C.setJointState(there.getJointState())
    view = ry.CameraView(there)
    view.setCamera("cameraWrist")
    image = ry.DepthView(view.computeImageAndDepth()[1], view.getFxycxy(), "cameraWrist")
    seen = ry.registerScene(C, image, moving, support="table", search_radius=0.1)
    map.update(C, image, known=seen)
    map.attach(C, unseen="shadows")
    print(f"{seen}, {map}")
    return seen.poses()


def follow(plan: ry.MotionPlan) -> None:
    assert plan.feasible, plan.message
    bot.follow(plan)
    bot.wait(C.copy())  # C itself would be told the truth


def gaze(at: list[float]) -> None:
    ik = ry.solveIk(C, {"cameraWrist": {"position": [0.7 * at[0], at[1] - 0.2, 1.2], "gaze": at}}, margin=0.005)
    follow(ry.planMotion(C, ik.q))


gaze([-0.3, 0.3, 0.7])
look(["cube"])
print(pick := ry.planTask(C, "(on l_gripper cube)"))
run = pick.execute(bot, observe=lambda: {})  # the cube stays where it was seen
assert run.feasible, run.message
bot.setFramePose("bottle", [0.12, 0.4, 0.8, 1, 0, 0, 0])  # somebody moves the bottle in front of the tray

C.setJointState(bot.get_q())
C.getFrame("cube").setPose(run.C.getFrame("cube").getPose())
C.attach("l_gripper", "cube")
gaze([0.3, 0.35, 0.7])
look([])
above = ry.solveIk(C, {"l_gripper": {"position": [0.3, 0.35, 0.8], "z": [0, 0, 1]}}, collisions=False)
while place := (plan := ry.planMotion(C, above.q)).blockedByUnseen:  # the next look
    print(place)
    view = ry.nextView(C, map, "cameraWrist", plan)
    print(view)
    follow(view.plan)
    look([])
print(put := ry.planTask(C, "(on tray cube)"))
run = put.execute(bot, observe=lambda: {})
print(run)
assert run.feasible
off = [np.linalg.norm(bot.getWorld().getFrame(name).getPosition()[:2] - at[:2]) for name, (_, at) in things.items()]
print(f"carton moved by {1e3 * off[1]:.1f} mm")
