"""Two arms and a handover.

Two Pandas: one hands over an object to the other, which reaches the goal.
"""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandasTable.g"))
rod = C.addFrame("rod", "table").setRelativePosition([-0.75, 0.25, 0.15]).setJoint(ry.JT.rigid)
rod.setShape(ry.ST.ssBox, [0.04, 0.04, 0.2, 0.005]).setColor([1, 0.5, 0]).setContact(1)
pad = C.addFrame("pad", "table").setRelativePosition([0.8, 0.2, 0.055])
pad.setShape(ry.ST.ssBox, [0.12, 0.12, 0.01, 0.004]).setColor([0.3, 0.6, 0.3]).setContact(1)

plan = ry.planTask(C, "(on pad rod)")
print(plan)
assert plan.feasible and ry.checkTaskPlan(C, plan) == []
plan.play(C)
