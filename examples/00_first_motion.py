"""A first motion: a robot plans around a column, and follows the plan in simulation."""

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))  # a Panda at a table
column = C.addFrame("column", "table").setShape(ry.ST.ssBox, [0.1, 0.1, 0.8, 0.02])  # three lengths, radius of edges; m
column.setRelativePosition([0.0, 0.35, 0.4]).setContact(1)  # without contact it would not be an obstacle

goal = {"l_gripper": {"position": [0.35, 0.3, 0.9], "z": [0, 0, 1]}}  # in the world; the hand comes from above
first = ry.solveIk(C, {"l_gripper": {"position": [-0.35, 0.3, 0.9], "z": [0, 0, 1]}})
print(first)
C.setJointState(first.q)

plan = ry.planMotion(C, goal, margin=0.01)  # 1 cm from everything, also between the samples
print(plan)  # or the reason for which there is none
print("least distance:", round(plan.clearance(), 3), "m")

bot = ry.BotOp(C)  # a simulated robot in a copy of the scene
bot.follow(plan)
bot.wait(C)
print("the gripper is at", C.getFrame("l_gripper").getPosition().round(3))
C.view_path(plan.path, plan.duration)  # plays the motion on a page in the browser
