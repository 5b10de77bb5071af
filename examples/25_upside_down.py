"""Turn a box upside down.

A box has to stand upside down. The wrist cannot turn it over in one grasp: it is laid on its side first.
"""

import kinegraph as ry

C = ry.Config()
table = C.addFrame("table").setPosition([0, 0, 0.55]).setShape(ry.ST.ssBox, [2.0, 2.0, 0.1, 0.02]).setContact(1)
base = C.addFrame("base").setPosition([0, 0, 0.6])
carriage = C.addFrame("carriage", "base").setJoint(ry.JT.trans3, [-0.9, -0.9, 0, 0.9, 0.9, 1])
carriage.setJointState([0, 0, 0.5])
hand = C.addFrame("g_gripper", "carriage").setShape(ry.ST.marker, [0.05]).setAttributes({"opening": 0.09})
hand.setJoint(ry.JT.hingeX, [-1.66, 1.66]).setJointState([0.0])
palm = C.addFrame("g_palm", "g_gripper").setRelativePosition([0, 0, 0.08])
palm.setShape(ry.ST.ssBox, [0.1, 0.2, 0.04, 0.004]).setColor([0.5, 0.5, 0.5]).setContact(1)
box = C.addFrame("box", "table").setRelativePosition([0.3, 0.2, 0.11]).setJoint(ry.JT.rigid)
box.setShape(ry.ST.ssBox, [0.07, 0.08, 0.12, 0.004]).setColor([1, 0.5, 0]).setContact(1)

plan = ry.planTask(C, "(up zNeg box)")
print(plan)
assert plan.feasible and len(plan.actions) == 4
plan.play(C)
print("the box's z axis is now", C.getFrame("box").getRotationMatrix()[:, 2].round(3))
