"""Motions among dynamic obstacles.

Motions among dynamic obstacles, replanning of a running motion, and improving motions.

The motion avoids obstacles with known trajectories, continuously in time. `replan` continues a running motion without a
stop. `planMotions` yields better and better motions.
"""

import numpy as np

from robotic import ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("cart").setPosition([-0.6, 0.35, 1.1])
C.addFrame("load", "cart").setShape(ry.ST.ssBox, [0.3, 0.3, 0.5, 0.02]).setContact(1).setColor([0.8, 0.5, 0.2])
q = C.getJointState()
turn = np.array([0.6, 0, 0, 0, 0, 0, 0])
start, goal = q - turn, q + turn

# The trajectory of a load that is carried past the arm, and then away.
times = np.array([0.0, 2.0, 4.0])
poses = np.array([[-0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 0.35, 1.1, 1, 0, 0, 0], [0.6, 1.5, 1.1, 0.7, 0, 0, 0.7]])
plan = ry.planMotion(C, goal, start, margin=0.01, obstacle_trajectories={"cart": (times, poses)})
print(plan, *plan.warnings, sep="\n")
assert plan.feasible

# Both together, every 10 ms; nothing touches.
for t in np.arange(0, plan.duration + 1, 0.01):
    C.setJointState(plan.eval(t)[0])
    C.getFrame("cart").setPose(plan.obstaclesAt(t)["cart"])
    assert not [pair for pair in C.getCollisions(0.009) if "load" in pair[:2]]
    C.view(False, f"among what moves, {t:.2f} s")

# A load that stays at the goal.
C.setJointState(goal)
hand = C.getFrame("l_gripper").getPosition()
C.setJointState(start)
stays = np.array([[0, 2, 1, 1, 0, 0, 0], [*hand, 1, 0, 0, 0]])
print(ry.planMotion(C, goal, start, obstacle_trajectories={"cart": ([0.0, 1.0], stays)}).message)

# A new goal for a moving robot: the new plan starts with the velocity of the old one.
C.getFrame("cart").setPosition([0, 2, 1])
bot = ry.BotOp(C, False)
plan = ry.planMotion(C, goal, start, velocity=0.6, acceleration=1.5)
bot.follow(plan)  # exactly, as it was verified
while bot.get_t() < 0.4 * plan.duration:
    bot.sync(C, 0.05)
now = bot.get_t() + 0.1
bend = plan.replan(C, at=now, goal=goal + np.array([-0.3, 0.3, 0, 0, 0, 0.1, 0]))
assert bend.feasible
bot.follow(bend, overwrite=True, start_time=now)
slowest = 1.0
while bot.get_t() < now + 0.3:
    bot.sync(C, 0.01)
    slowest = min(slowest, float(np.linalg.norm(bot.get_qDot())))
bot.wait(C, forKeyPressed=False, forTimeToEnd=True)
print(f"another goal after {now:.1f} s, never slower than {slowest:.2f} rad/s until {now + 0.3:.1f} s")

# A disc moves through two walls with gaps: the first path is seldom in the best homotopy class.
C = ry.Config()
C.addFrame("floor")
C.addFrame("disc", "floor").setJoint(ry.JT.transXY, [-2.0, -2.0, 2.0, 2.0])
C.addFrame("body", "disc").setShape(ry.ST.cylinder, [0.2, 0.05]).setContact(1)
walls = {
    -0.5: ((-2.2, -1.5), (-1.2, -0.2), (0.05, 1.0), (1.3, 2.2)),
    0.5: ((-2.2, -1.25), (-0.95, 0.05), (0.3, 0.75), (1.05, 2.2)),
}
for x, pieces in walls.items():
    for low, high in pieces:
        wall = C.addFrame(f"wall {x} {low}").setShape(ry.ST.box, [0.1, high - low, 1.0]).setContact(1)
        wall.setPosition([x, 0.5 * (low + high), 0])
for plan in ry.planMotions(C, [1.5, 0.9], [-1.5, -1.0], optimize="length", restarts=1, improvement_evaluations=20000):
    print(f"length {plan.length:.3f}")
C.view_path(plan.path, plan.duration, True, "shorter and shorter")
