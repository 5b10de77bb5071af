"""A motion as a spline.

A motion problem whose variables are the control points of a B-spline.

Ten control points for 60 slices: the motion is smooth, respects joint limits everywhere, and a robot can execute the
spline directly.
"""

import numpy as np

from robotic import ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("target", "table").setShape(ry.ST.marker, [0.1]).setRelativePosition([-0.3, 0.35, 0.3])
C.addFrame("post", "table").setShape(ry.ST.ssBox, [0.06, 0.06, 0.6, 0.02]).setRelativePosition([-0.12, 0.35, 0.3])
C.getFrame("post").setContact(1).setColor([0.8, 0.5, 0.2])

komo = ry.KOMO(C, 2, 30, 2, True)  # two phases of one second
komo.addControlObjective([], 2, 0.1)
komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0], margin=0.02)
komo.addObjective([2.0], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0])
motion = ry.SplineMotion(komo, points=10)
nlp = motion.nlp()
result = ry.NLP_Solver(nlp, verbose=0).solve()
print(f"feasible: {result.feasible}, {nlp.dimension} variables for {komo.getPath().size} numbers")
assert result.feasible

spline = motion.spline()
t = np.linspace(0, 2, 2001)
q, qd, qdd = (spline.eval(t, k) for k in range(3))
lower, upper = C.getJointLimits()
print(f"limits hold at all times: {bool(np.all((q >= lower) & (q <= upper)))}")
jump = np.abs(np.diff(qdd[:-1], axis=0)).max()
print(f"acceleration at most {np.abs(qdd).max():.1f} rad/s2, and it changes by at most {jump:.2f} in a millisecond")
print(f"collision-free at {len(q)} times: {bool(C.isValid(q).all())}")

# A simulated robot executes the spline exactly.
bot = ry.BotOp(C, False)
bot.follow(spline)
bot.wait(C, forKeyPressed=False, forTimeToEnd=True)
off = np.linalg.norm(C.getFrame("l_gripper").getPosition() - C.getFrame("target").getPosition())
print(f"the gripper is {1e3 * off:.1f} mm off")
komo.view(True, "a motion as a spline")
