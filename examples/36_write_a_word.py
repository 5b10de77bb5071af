"""Part 36: write a word.

Writing a word, in strokes with their own speed, and a program of G-code.
"""

import tempfile
from pathlib import Path

import numpy as np

from robotic import ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("pen", "l_gripper").setShape(ry.ST.capsule, [0.06, 0.008]).setRelativePosition([0, 0, -0.032]).setContact(-2)
C.addFrame("tip", "l_gripper").setRelativePosition([0, 0, -0.08])
C.addFrame("paper", "table").setShape(ry.ST.box, [0.4, 0.2, 0.001]).setRelativePosition([0, 0.35, 0.051])

# "ry" in strokes on the paper, 5 cm high: lines, arcs, and corners with a radius.
up, down = 0.03, 0.002


def stroke(*points: tuple[float, float]) -> ry.ToolPath:
    path = ry.ToolPath("tip", relativeTo="paper").free().start([*points[0], up]).speed(0.05).line([*points[0], down])
    path.speed(0.1)
    for k, point in enumerate(points[1:]):
        path.line([*point, down], blend=0.004 if k > 0 else 0)
    return path.speed(0).line([*points[-1], up])


r = stroke((-0.1, 0.05), (-0.1, 0.0))
shoulder = ry.ToolPath("tip", relativeTo="paper").free().start([-0.1, 0.03, up]).speed(0.1).line([-0.1, 0.03, down])
shoulder.arc([-0.085, 0.047, down], [-0.065, 0.05, down]).speed(0).line([-0.065, 0.05, up])
word = [r, shoulder, stroke((-0.03, 0.05), (-0.005, 0.0)), stroke((0.02, 0.05), (-0.005, 0.0), (-0.02, -0.03))]

plan = ry.planToolPath(C, word, speed=0.3, transfer_from=C.getJointState(), acceleration=6.0, jerk=120.0)
print(plan, *plan.warnings, sep="\n")
assert plan, plan.message
print([kind for kind, *_ in plan.segments])
plan.view(C, word)

# The same from a program: mm, and mm per minute. Its zero is the middle of the paper.
program = """G21 G90
G0 X50 Y0 Z30
G1 Z2 F3000
G2 X50 Y0 I-20 J0 F6000 (a full circle)
G64 P4
G1 X50 Y50
X10
G0 Z30
M2
"""
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "frame.nc"
    file.write_text(program)
    path = ry.ToolPath.read(file, frame="tip", relativeTo="paper").free()
plan = ry.planToolPath(C, path, speed=0.3, acceleration=6.0, jerk=120.0)
assert plan, plan.message
t = np.linspace(0, plan.duration, 2000)
q = plan.eval(t)[0]
fast = max(plan.speed(time) for time in t if plan.way(time)[1] > 0.04)
print(f"{plan.duration:.1f} s, the cut at up to {fast:.3f} m/s")
assert fast < 0.3 * 1.001
plan.view(C, path, pause=True)
