"""Part 35: a raster between clamps.

A raster on a cylinder between clamps; the tool leans within a cone, and turns freely about its axis.
"""

import numpy as np

from robotic import ry

RADIUS = 0.12

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("pen", "l_gripper").setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.032]).setContact(-2)
C.addFrame("tool", "l_gripper").setRelativePosition([0, 0, -0.08])
C.addFrame("drum", "table").setShape(ry.ST.cylinder, [0.3, RADIUS - 0.01]).setRelativePose("t(0 .45 .22) d(90 0 1 0)")
C.getFrame("drum").setContact(1)
for k, x in enumerate((-0.05, 0.07)):
    C.addFrame(f"clamp {k}", "table").setShape(ry.ST.ssBox, [0.015, 0.06, 0.05, 0.002]).setContact(1)
    C.getFrame(f"clamp {k}").setRelativePosition([x, 0.345, 0.33])

# Lines along the drum, which half circles connect; x is along its axis, and angles count from the top.
lines = []
for k, angle in enumerate(np.linspace(-0.5, 0.3, 7)):
    along = np.linspace(-0.1, 0.1, 101) * (-1) ** k
    lines.append(np.stack([along, np.full(101, angle)], axis=1))
    if k < 6:
        turn = np.linspace(0, np.pi, 30)[1:-1]
        end, half = along[-1], 0.4 / 6
        bend = [end + np.sign(end) * half * RADIUS * np.sin(turn), angle + half * (1 - np.cos(turn))]
        lines.append(np.stack(bend, axis=1))
surface = np.vstack(lines)
normals = np.stack([0 * surface[:, 1], np.sin(surface[:, 1]), np.cos(surface[:, 1])], axis=1)
points = normals * RADIUS + np.stack([surface[:, 0], 0 * surface[:, 0], 0 * surface[:, 0]], axis=1)
points += C.getFrame("drum").getPosition()

raster = ry.ToolPath.along(points, normals, frame="tool").tilt(np.radians(20))
plan = ry.planToolPath(C, raster, speed=0.1, margin=0.002, approach=0.03, retract=0.03, acceleration=6.0, jerk=120.0)
print(plan)
assert plan, plan.message

t, q = plan.sample(200)[:2]
assert C.isValid(q, margin=0.002 - 1e-6).all()
axis = C.evalBatch(ry.FS.vectorZ, ["tool"], q)[0]
way = np.array([plan.way(time)[1] for time in t])
length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
nearest = normals[np.clip(np.searchsorted(length, way), 0, len(length) - 1)]
lean = np.degrees(np.arccos(np.clip(np.sum(axis * nearest, axis=1), -1, 1)))
print(f"{length[-1]:.2f} m; the pen leans by up to {lean[(way > 0) & (way < length[-1])].max():.1f} degrees")
slow = sum(end - begin for _, begin, end, *_ in plan.slow)
print(f"slower than asked on {100 * slow / length[-1]:.0f} % of the way, first because of the {plan.slow[0][4]}")
plan.view(C, raster, pause=True)
