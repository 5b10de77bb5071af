"""Plans that improve.

Plans that improve with more evaluations; and an explanation if there is none.
"""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
tray = C.addFrame("tray", "table").setRelativePosition([0.35, 0.3, 0.055])
tray.setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]).setColor([0.3, 0.6, 0.3]).setContact(1)
for name, x in (("cup", -0.3), ("jug", 0.0)):
    thing = C.addFrame(name, "table").setRelativePosition([x, 0.3, 0.1]).setJoint(ry.JT.rigid)
    thing.setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.005]).setColor([1, 0.5, 0]).setContact(1)

for plan in ry.planTasks(C, "(on tray cup) (on tray jug)", max_evaluations=30000):
    print(f"{plan.duration:.2f} s after {plan.evaluations} evaluations")

lid = C.addFrame("lid", "table").setRelativePosition([-0.3, 0.3, 0.19])
lid.setShape(ry.ST.ssBox, [0.3, 0.3, 0.02, 0.004]).setColor([0.7, 0.7, 0.9]).setContact(1)
for k, (dx, dy) in enumerate(((-0.1, 0), (0.1, 0), (0, -0.1), (0, 0.1))):
    wall = C.addFrame(f"wall{k}", "table").setRelativePosition([-0.3 + dx, 0.3 + dy, 0.115])
    wall.setShape(ry.ST.ssBox, [0.02, 0.2, 0.13, 0.004] if dx else [0.2, 0.02, 0.13, 0.004]).setColor(
        [0.7, 0.7, 0.9]
    ).setContact(1)
caged = ry.planTask(C, "(on tray cup)")
print(caged.explain())
print(caged.searchTree())
caged.view(C, False)  # shows a red copy of the arm at the nearest approach
