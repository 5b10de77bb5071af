"""Part 6: inverse kinematics as an optimization. Which joint angles bring the gripper to the target?

Of all solutions, we want those near the present configuration and near home:

    minimize  |.1 (q - q0)|^2 + |.1 (q - q_home)|^2   subject to   10 (gripper - target) = 0
"""

import time

import numpy as np
from numpy.typing import NDArray

from robotic import ry

np.set_printoptions(suppress=True)
Q_HOME = [0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]

C = ry.Config()
C.addFile(ry.raiPath("../rai-robotModels/scenarios/pandaSingle.g"))
target = C.addFrame("target", "table")
target.setShape(ry.ST.marker, [0.1])
target.setRelativePosition([0.0, 0.3, 0.3])
center = target.getPosition()
C.view(True, "the target is the marker in front of the robot")


def inverseKinematics(C: ry.Config) -> tuple[NDArray[np.float64], ry.SolverReturn]:
    q0 = C.getJointState()
    komo = ry.KOMO(C, 1, 1, 0, False)  # one phase with one slice; positions only, no collisions
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], q0)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], Q_HOME)
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    return komo.getPath()[0], result


def gap(C: ry.Config) -> float:
    """Distance of gripper and target in mm."""
    return 1e3 * float(np.linalg.norm(C.eval(ry.FS.positionDiff, ["l_gripper", "target"])[0]))


q, result = inverseKinematics(C)
print("before:", f"{gap(C):.1f} mm;", "answer:", result)
C.setJointState(q)
print(f"after:  {gap(C):.4f} mm, q = {q.round(3)}\n")
assert result.feasible and gap(C) < 0.1
C.view(True, "the gripper is at the target")

# The target moves randomly; each solution starts from the previous one.
rng = np.random.default_rng(0)
position = center.copy()
for _ in range(20):
    position = center + 0.98 * (position - center) + 0.02 * rng.standard_normal(3)
    target.setPosition(position)
    start = time.perf_counter()
    q, result = inverseKinematics(C)
    milliseconds = 1e3 * (time.perf_counter() - start)
    C.setJointState(q)
    print(f"target {position.round(3)}: feasible {result.feasible}, {gap(C):.4f} mm off, {milliseconds:.2f} ms")
    assert result.feasible and gap(C) < 0.1
    C.view()
    time.sleep(0.02)
