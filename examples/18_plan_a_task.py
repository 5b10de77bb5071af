"""Plan a task.

Plans a motion for a goal: objects in the way are put aside first. An impossible goal is explained.
"""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
tray = C.addFrame("tray", "table").setRelativePosition([0.25, 0.35, 0.055])
tray.setShape(ry.ST.ssBox, [0.09, 0.09, 0.01, 0.004]).setColor([0.3, 0.6, 0.3]).setContact(1)
for name, parent, at, color in (
    ("cup", "table", [-0.3, 0.25, 0.1], [1, 0.5, 0]),
    ("jug", "tray", [0, 0, 0.055], [0, 0.5, 1]),
):
    thing = C.addFrame(name, parent).setRelativePosition(at).setJoint(ry.JT.rigid)
    thing.setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.005]).setColor(color).setContact(1)

plan = ry.planTask(C, "(on tray cup) (on table jug)")
print(plan)
if plan.feasible:
    plan.play(C.copy())

# No motion achieves this, and the result explains the reason.
far = C.addFrame("far", "table").setRelativePosition([0.0, 5.0, 0.055]).setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004])
print(ry.planTask(C, "(on far cup)"))
