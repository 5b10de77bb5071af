"""Part 34: a seam.

A seam on a part at a constant speed, with approach and retract, and a clamp that is in the way.
"""

import numpy as np

from robotic import ry

C = ry.Config()
C.addFile(ry.raiPath("ur10e/ur10e.g"))
C.addFrame("torch", "tool0").setShape(ry.ST.capsule, [0.14, 0.012]).setRelativePosition([0, 0, 0.09]).setContact(-2)
C.addFrame("tip", "tool0").setRelativePosition([0, 0, 0.18])
C.addFrame("part").setShape(ry.ST.ssBox, [0.5, 0.3, 0.1, 0.005]).setPosition([0.75, 0, 0.2]).setContact(1)

# The seam is a wave on the top of the part, in its coordinates. The axis of the torch points into the part, may lean by
# 15 degrees, and the torch may turn about it.
x = np.linspace(-0.2, 0.2, 401)
points = np.stack([x, 0.06 * np.sin(12 * x), 0 * x + 0.052], axis=1)
into = np.tile([0.0, 0.0, -1.0], (len(x), 1))
seam = ry.ToolPath.along(points, into, frame="tip", relativeTo="part").tilt(np.radians(15))

plan = ry.planToolPath(
    C, seam, touching=["part"], speed=0.05, approach=0.05, retract=0.05, acceleration=8.0, jerk=150.0
)
print(plan)
for kind, _, _, begin, end in plan.segments:
    print(f"  {kind}: {begin:.2f} to {end:.2f} s")
assert plan, plan.message
assert plan.deviation[0] < 2e-5
print(f"the tip is at most {1e6 * plan.deviation[0]:.0f} micrometers from the seam at all times")
plan.view(C, seam)

# A clamp on the seam: the plan says where and why, and has the motion up to there.
C.addFrame("clamp", "part").setShape(ry.ST.ssBox, [0.04, 0.3, 0.06, 0.002]).setRelativePosition([0.12, 0, 0.09])
C.getFrame("clamp").setContact(1)
plan = ry.planToolPath(
    C, seam, touching=["part"], speed=0.05, approach=0.05, retract=0.05, acceleration=8.0, jerk=150.0
)
print(plan.message)
assert plan.status == ry.ToolPathStatus.in_collision
assert "clamp" in plan.frames
print(f"{len(plan.reached)} configurations lead to {plan.where[1]:.3f} m")
plan.view(C, seam, pause=True)
