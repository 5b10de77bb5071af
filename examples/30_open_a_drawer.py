"""Open a drawer.

A cup goes into a closed drawer. The geometry alone implies that the drawer has to be opened first.
"""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("cabinet", "table").setRelativePosition([0.05, 0.45, 0.05])
for name, at, size in (
    ("left", [-0.14, 0.15, 0.08], [0.02, 0.3, 0.16]),
    ("right", [0.14, 0.15, 0.08], [0.02, 0.3, 0.16]),
    ("back", [0, 0.31, 0.08], [0.3, 0.02, 0.16]),
    ("roof", [0, 0.16, 0.17], [0.3, 0.32, 0.02]),
):
    wall = C.addFrame(name, "cabinet").setRelativePosition(at).setShape(ry.ST.ssBox, [*size, 0.004])
    wall.setColor([0.7, 0.5, 0.3, 0.6]).setContact(1)

# It has a joint of one dof with limits, and no motor, so a simulated hand can move it.
drawer = C.addFrame("drawer", "cabinet").setJoint(ry.JT.transY, [-0.2, 0]).setJointState([0])
drawer.setAttributes({"logical": {"is_drawer": True}, "noMotor": True, "jointFriction": 2.0})
for name, at, size in (
    ("floor", [0, 0.14, 0.02], [0.24, 0.26, 0.02]),
    ("front", [0, -0.01, 0.07], [0.25, 0.02, 0.12]),
    ("handle", [0, -0.07, 0.1], [0.02, 0.02, 0.08]),
):
    part = C.addFrame(name, "drawer").setRelativePosition(at).setShape(ry.ST.ssBox, [*size, 0.004])
    part.setColor([0.9, 0.8, 0.6]).setContact(1).setMass(0.2)
C.getFrame("handle").setAttributes({"logical": {"is_handle": True}})

cup = C.addFrame("cup", "table").setRelativePosition([0.4, 0.1, 0.09]).setJoint(ry.JT.rigid)
cup.setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004]).setColor([1, 0.5, 0]).setContact(1).setMass(0.1)

plan = ry.planTask(C, "(on floor cup) (closed drawer)")
print(plan)
assert plan.feasible

bot = ry.BotOp(C)
run = plan.execute(bot)
print(run)
print("the drawer is", ry.doorStates(bot.getWorld())["drawer"])
bot.getWorld().view(False, "put away")
