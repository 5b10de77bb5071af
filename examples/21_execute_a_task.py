"""Execute and repair a task.

Plans a tower of three cubes, builds it with a simulated robot, and repairs it after a failure.
"""

import numpy as np

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
for name, at, color in (
    ("red", [-0.3, 0.2], [1.0, 0.3, 0.2]),
    ("green", [0.3, 0.3], [0.3, 0.8, 0.3]),
    ("blue", [0.1, 0.45], [0.2, 0.4, 1.0]),
):
    cube = C.addFrame(name, "table").setRelativePosition([*at, 0.075]).setJoint(ry.JT.rigid)
    cube.setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.004]).setColor(color).setContact(1)
    cube.setMass(0.1).setAttributes({"friction": 1.0})

plan = ry.planTask(C, "(on green red) (on blue green)")
print(plan)
print(f"{plan.duration:.1f} s; after 1 s the arm is at", np.round(plan.eval(1.0)[0], 2))

world = C.copy()  # in the robot's world, one cube differs from the plan
world.getFrame("blue").setRelativePosition([0.1, 0.37, 0.075])
bot = ry.BotOp(world)
run = plan.run(bot)
for event in run:
    print(event)
print(run.result)
assert run.result.feasible
bot.getWorld().view(False, "the tower")
