"""Part 8: inverse kinematics in one call.

`solveIk` makes the problem, tries many starting points, respects limits and avoids collisions. If there is no solution,
it explains why.
"""

import time

import numpy as np

from robotic import ry

np.set_printoptions(precision=3, suppress=True)

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandasTable.g"))
ball = C.addFrame("ball").setShape(ry.ST.sphere, [0.05]).setColor([1, 0.5, 0]).setPosition([-0.1, 0.2, 1.0])
C.view(True, "two arms, a table and a ball")

# A frame to a frame's position, from above: z points out of the back of the hand. apply=True moves C.
result = ry.solveIk(C, {"l_gripper": {"position": "ball", "z": [0, 0, 1]}}, apply=True)
print(result)
assert result.feasible and C.getFrame("l_palm").getPosition()[2] > ball.getPosition()[2]
C.view(True, "the left gripper is at the ball")

# Both arms at once, at least 2 cm from everything, and the nearest of 50 answers to the present configuration.
left, right = C.getFrame("l_gripper").getPosition(), C.getFrame("r_gripper").getPosition()
up = np.array([0, 0, 0.1])
targets = {"l_gripper": left + up, "r_gripper": right + up}
result = ry.solveIk(C, targets, margin=0.02, best=True, attempts=50, apply=True)
print(result)
assert result.feasible
print("moved by", np.linalg.norm(C.getFrame("r_gripper").getPosition() - right).round(3), "m")
C.view(True, "both went up by 10 cm")

# A target out of reach is an outcome with a reason.
result = ry.solveIk(C, {"l_gripper": [1.5, 0.4, 1.0]})
print(result.feasible, result.status)
assert result.status == ry.IkStatus.goal_unreachable
print(result.message)

# A thousand targets at once; threads share them, and the solutions do not depend on the number of threads.
points = left + 0.3 * np.random.default_rng(0).standard_normal((1000, 3))
start = time.perf_counter()
results = ry.solveIk(C, {"l_gripper": points}, attempts=10, threads=2)
assert isinstance(results, ry.IkResults)  # because the targets are rows
print(f"{results.feasible.sum()} of {len(results)} reached without collision, {time.perf_counter() - start:.2f} s")
print("answers:", results.q.shape, "attempts, at most:", results.attempts.max())
