"""Look, plan and pick.

A simulated depth camera looks, the robot plans and picks, and looks again while somebody moves the cubes.
"""

import numpy as np

import kinegraph as ry

C = ry.Config()  # what the robot believes
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("tray", "table").setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.005]).setRelativePosition([0.35, 0.35, 0.06])
C.getFrame("tray").setContact(1)
cubes = {"red": [-0.3, 0.25], "blue": [-0.1, 0.4]}
for name, at in cubes.items():
    cube = C.addFrame(name, "table").setRelativePosition([*at, 0.075]).setJoint(ry.JT.rigid)
    cube.setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.004]).setContact(1).setMass(0.1)
    cube.setAttributes({"friction": 1.0})

eye, target = np.array([-0.5, 0.95, 1.2]), np.array([0, 0.3, 0.65])  # a fixed camera beyond the table
z = (target - eye) / np.linalg.norm(target - eye)
x = np.cross(z, [0, 0, 1]) / np.linalg.norm(np.cross(z, [0, 0, 1]))
camera = C.addFrame("camera").setPosition(eye).setRotationMatrix(np.stack([x, np.cross(z, x), z], 1))
camera.setAttributes({"focalLength": 1.25, "width": 640, "height": 480})

world = C.copy()  # what is there: both cubes are 4 cm beside their believed places
for name, at in cubes.items():
    world.getFrame(name).setRelativePosition([at[0] + 0.03, at[1] - 0.03, 0.075])
bot = ry.BotOp(world)
rng = np.random.default_rng(0)


def look() -> dict[str, np.ndarray | None]:
    """Returns the poses of the cubes that the camera sees, and updates the robot's belief."""
    there = bot.getWorld()
    C.setJointState(there.getJointState())
    view = ry.CameraView(there)
    view.setCamera("camera")
    depth = view.computeImageAndDepth()[1]
    depth += 0.0027 * depth**2 * rng.normal(size=depth.shape).astype(np.float32)  # as a good stereo camera
    image = ry.DepthView(depth, view.getFxycxy(), "camera")
    seen = ry.registerScene(C, image, list(cubes), support="table", search_radius=0.1)
    return seen.poses()


for name, pose in look().items():
    if pose is None:
        continue
    off = np.linalg.norm(pose[:3] - world.getFrame(name).getPosition())
    print(f"{name} was seen within {1e3 * off:.1f} mm")

run = ry.planTask(C, "(on tray red) (on tray blue)").run(bot, observe=look)
moved = False
for event in run:
    print(event)
    if not moved and event.kind == ry.TaskEventKind.grip:  # while the hand is busy, somebody moves the other cube
        other = next(name for name in cubes if name not in str(event))
        pose = bot.getWorld().getFrame(other).getPose()
        pose[:2] += [0.04, 0.03]
        bot.setFramePose(other, pose)
        moved = True
print(run.result)
bot.getWorld().view(False, "both cubes on the tray")
assert run.result.feasible
