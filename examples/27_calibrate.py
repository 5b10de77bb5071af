"""Calibration by gradients.

Derivatives of solutions by parameters of the problem. The mounting of a tool is estimated from the robot's
configurations at known points, and gradient descent runs through inverse kinematics."""

import numpy as np
from numpy.typing import NDArray

import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
tool = C.addFrame("tool", "l_gripper")
rng = np.random.default_rng(0)
points = np.array([0.3, 0.3, 1.0]) + 0.2 * rng.uniform(-1, 1, (6, 3))


def reach(point: NDArray[np.float64], place: NDArray[np.float64]) -> ry.SolverReturn:
    """Solves the robot's inverse kinematics with the tool at `place`."""
    tool.setRelativePosition(place)
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addControlObjective([], 0, 1e-1)
    komo.addObjective([], ry.FS.position, ["tool"], ry.OT.eq, [10], point)
    return ry.NLP_Solver(komo.nlp()).solve(verbose=0)


truth = np.array([0.03, -0.02, 0.05])
observed = [reach(point, truth).sensitivity("tool").x + 1e-4 * rng.normal(size=7) for point in points]

# Gauss-Newton on the tool's position, with the predicted configurations and their derivatives.
place = np.zeros(3)
for step in range(5):
    moves = [reach(point, place).sensitivity("tool") for point in points]
    missing = np.concatenate([q - move.x for q, move in zip(observed, moves)])
    print(f"step {step}: configurations off by {1e3 * np.sqrt(np.mean(missing**2)):.3f} mrad, tool at {place.round(4)}")
    place = place + np.linalg.lstsq(np.concatenate([move.jacobian for move in moves]), missing, rcond=None)[0]
print(f"found within {1e3 * np.abs(place - truth).max():.2f} mm")

# Which target within 10 cm needs the least bending of the elbow? Its gradient passes through solveIk.
tool.setRelativePosition(place)
target = points[0].copy()
for _ in range(20):
    answer = ry.solveIk(C, {"tool": target}, home_weight=1.0)
    elbow = answer.q[3] - C.getJointState()[3]
    gradient = answer.sensitivity().gradient(2 * elbow * np.eye(7)[3])
    target -= 0.02 * gradient
    target = points[0] + (target - points[0]) * min(1, 0.1 / np.linalg.norm(target - points[0]))
print(
    f"elbow bent by {abs(elbow):.3f} rad, at first "
    f"{abs(ry.solveIk(C, {'tool': points[0]}, home_weight=1.0).q[3] - C.getJointState()[3]):.3f}"
)
tool.setShape(ry.ST.sphere, [0.02])
C.setJointState(answer.q)
C.view(False, "the tool where it was found, and the elbow least bent")
