"""Model predictive control.

A receding horizon controls a simulated Panda: it follows a target, avoids a crossing ball, and recovers from a push.

Twenty times a second, the motion of the next second is replanned from measurements.
"""

import numpy as np

import kinegraph as ry

TAU, SLICES = 0.05, 20

M = ry.Config()  # the planner's model
M.addFile(ry.raiPath("scenarios/pandaSingle.g"))
start = np.array(M.getFrame("l_gripper").getPosition())
M.addFrame("target").setShape(ry.ST.marker, [0.2]).setPose(M.getFrame("l_gripper").getPose())
ball = M.addFrame("ball").setShape(ry.ST.sphere, [0.08]).setColor([1, 0.5, 0]).setContact(1)


def target_at(t: np.ndarray | float) -> np.ndarray:
    return np.asarray(start + 0.1 * np.stack([np.sin(t), 0 * t, 1 - np.cos(t)], axis=-1))


def ball_at(t: np.ndarray | float) -> np.ndarray:
    return np.asarray(start + np.stack([1 - 0.25 * t, 0 * t, 0.1 + 0 * t], axis=-1))  # through the hand's position


ball.setPosition(ball_at(np.array(0.0)))
komo = ry.KOMO(M, SLICES * TAU, round(1 / TAU), 2, True)
komo.addControlObjective([], 2, 0.1)
komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, margin=0.02)
komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
komo.addObjective([], ry.FS.poseDiff, ["l_gripper", "target"], ry.OT.sos, [10])
komo.addObjective([SLICES * TAU], ry.FS.jointState, [], ry.OT.sos, [0.1], order=1)  # nearly at rest at the end
mpc = ry.Mpc(komo, evaluations=2)  # one step per call

C = ry.Config()  # the simulated world
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
S = ry.Simulation(C)
M.view()

ahead = TAU * np.arange(1, SLICES + 1)
errors, distances = [], []
for i in range(140):
    t = i * TAU
    mpc.setPoses("target", target_at(t + ahead))
    mpc.setPoses("ball", ball_at(t + ahead))
    mpc.step(S.get_q(), S.get_qDot())
    if i == 110:
        S.applyForce("l_gripper", [0, 60, 0])  # a push of 60 N for 0.1 s
    if i == 112:
        S.clearForces()
    for s in np.arange(0.01, TAU + 1e-6, 0.01):
        S.step(np.concatenate(mpc.at(s)), 0.01, ry.ControlMode.positionVelocity)
        M.setJointState(S.get_q())
        ball.setPosition(ball_at(t + s))
        distances.append(float(np.min(M.getNearestPoints()[0])))
    M.view()
    errors.append(np.linalg.norm(M.getFrame("l_gripper").getPosition() - target_at(np.array(t + TAU))))

print(f"nearest to the ball and the table: {1e3 * min(distances):.1f} mm")
print(f"error while the ball comes across: up to {1e3 * max(errors[40:100]):.0f} mm")
print(f"after the push: {1e3 * max(errors[110:120]):.0f} mm, at the end {1e3 * errors[-1]:.1f} mm")
assert min(distances) > 0
assert errors[-1] < 5e-3
