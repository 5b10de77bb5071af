"""Part 37: the part in the hand.

A part in the hand moves along a fixed tool; a turntable turns a can while an arm welds around it.
"""

import numpy as np

from robotic import ry

# A plate in the gripper is drawn past a fixed nozzle: the nozzle moves in the coordinates of the plate.
C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("plate", "l_gripper").setShape(ry.ST.ssBox, [0.16, 0.1, 0.01, 0.002]).setRelativePosition([0, 0, -0.05])
C.getFrame("plate").setContact(-2)
C.addFrame("nozzle", "table").setShape(ry.ST.capsule, [0.1, 0.01]).setRelativePosition([0.1, 0.35, 0.1]).setContact(1)
C.addFrame("jet", "nozzle").setRelativePosition([0, 0, 0.08])

corners = np.array([[-0.06, -0.03, -0.01], [0.06, -0.03, -0.01], [0.06, 0.03, -0.01], [-0.06, 0.03, -0.01]])
bead = ry.ToolPath("jet", relativeTo="plate").start(np.r_[corners[0], 1, 0, 0, 0]).free()
for corner in (*corners[1:], corners[0]):
    bead.line(corner, blend=0.01)
plan = ry.planToolPath(C, bead, speed=0.1, acceleration=6.0, jerk=120.0)
print(plan)
assert plan, plan.message

t, q = plan.sample(500)[:2]
jet, plate = (C.evalBatch(ry.FS.pose, [name], q)[0] for name in ("jet", "plate"))
moves = [np.linalg.norm(np.diff(p[:, :3], axis=0), axis=1).sum() for p in (jet, plate)]
print(f"the jet moves by {moves[0]:.3f} m, the plate by {moves[1]:.2f} m")
assert moves[0] < 1e-9
plan.view(C, bead)

# A turntable is one more joint of the same problem.
C = ry.Config()
C.addFile(ry.raiPath("ur5e/ur5e.g"))
C.addFrame("torch", "tool0").setShape(ry.ST.capsule, [0.08, 0.01]).setRelativePosition([0, 0, 0.06]).setContact(-2)
C.addFrame("tip", "tool0").setRelativePosition([0, 0, 0.12])
C.addFrame("post").setPosition([0.6, 0, 0.2])
C.addFrame("table", "post").setJoint(ry.JT.hingeZ, limits=[-9, 9])
C.addFrame("can", "table").setShape(ry.ST.cylinder, [0.2, 0.08]).setRelativePosition([0, 0, 0.1]).setContact(1)
angle = np.linspace(0, 2 * np.pi, 721)
ring = np.stack([0.081 * np.cos(angle), 0.081 * np.sin(angle), 0 * angle], axis=1)
into = np.stack([-np.cos(angle), -np.sin(angle), 0 * angle], axis=1)
seam = ry.ToolPath.along(ring, into, frame="tip", relativeTo="can").tilt(np.radians(20))
plan = ry.planToolPath(C, seam, speed=0.05, touching=["can"], acceleration=6.0, jerk=120.0)
print(plan)
assert plan, plan.message
q = plan.eval(np.array([0.0, plan.duration]))[0]
print(f"the table turns by {np.degrees(q[1, -1] - q[0, -1]):.0f} degrees")
plan.view(C, seam, pause=True)
