"""The receding horizon from Python, and in a closed loop with a simulated Panda."""

import numpy as np
import pytest

import kinegraph as ry

TAU, SLICES = 0.05, 20
AHEAD = TAU * np.arange(1, SLICES + 1)


def model():
    M = ry.Config()
    M.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    M.addFrame("target").setPose(M.getFrame("l_gripper").getPose())
    M.addFrame("ball").setShape(ry.ST.sphere, [0.08]).setContact(1).setPosition([0, 0, 5])
    return M


def horizon(M):
    komo = ry.KOMO(M, SLICES * TAU, round(1 / TAU), 2, True)
    komo.addControlObjective([], 2, 0.1)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, margin=0.02)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
    komo.addObjective([], ry.FS.poseDiff, ["l_gripper", "target"], ry.OT.sos, [10])
    return komo


class Loop:
    """One step a call, twenty calls a second, from what the simulation measures."""

    def __init__(self):
        self.M, self.C = model(), ry.Config()
        self.C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
        self.start = np.array(self.M.getFrame("l_gripper").getPosition())
        self.mpc, self.S = ry.Mpc(horizon(self.M), evaluations=2), ry.Simulation(self.C)
        self.errors, self.distances = [], []

    def run(self, calls, target, ball=None):
        for _ in range(calls):
            t = self.S.get_t()
            self.mpc.setPoses("target", self.start + target(t + AHEAD))
            if ball is not None:
                self.mpc.setPoses("ball", self.start + ball(t + AHEAD))
            self.result = self.mpc.step(self.S.get_q(), self.S.get_qDot())
            for s in np.arange(0.01, TAU + 1e-6, 0.01):
                self.S.step(np.concatenate(self.mpc.at(s)), 0.01, ry.ControlMode.positionVelocity)
                self.M.setJointState(self.S.get_q())
                if ball is not None:
                    self.M.getFrame("ball").setPosition(self.start + ball(np.array(t + s)))
                self.distances.append(np.min(self.M.getNearestPoints()[0]))
            tip = self.M.getFrame("l_gripper").getPosition() - self.start
            self.errors.append(np.linalg.norm(tip - target(np.array(t + TAU))))


def circle(t):
    return 0.1 * np.stack([np.sin(2 * t), 0 * t, 1 - np.cos(2 * t)], axis=-1)


def still(t):
    return np.stack([0 * t, 0 * t, 0.05 + 0 * t], axis=-1)


def test_a_moving_target_is_followed_by_a_simulated_arm():
    loop = Loop()
    loop.run(80, circle)
    assert max(loop.errors[30:]) < 5e-3
    assert loop.result.feasible


def test_an_obstacle_that_comes_across_is_dodged():
    loop = Loop()
    loop.run(100, still, lambda t: np.stack([0.8 - 0.3 * t, 0 * t, 0.1 + 0 * t], axis=-1))
    assert min(loop.distances) > 0.005  # of the margin of 2 cm
    assert min(loop.distances) < 0.03  # it came near
    assert max(loop.errors[30:80]) > 0.03  # so that it left the target
    assert loop.errors[-1] < 5e-3  # and came back


def test_a_push_at_the_arm_is_taken_up():
    loop = Loop()
    loop.run(40, still)
    assert loop.errors[-1] < 1e-3
    loop.S.applyForce("l_gripper", [0, 60, 0])
    loop.run(2, still)
    loop.S.clearForces()
    assert loop.errors[-1] > 2e-3
    loop.run(40, still)
    assert loop.errors[-1] < 1e-3
    assert min(loop.distances) > 0


def test_the_result_says_how_good_the_motion_is():
    M = model()
    mpc = ry.Mpc(horizon(M), evaluations=2)
    q = np.array(M.getJointState())
    first = mpc.step(q, np.zeros(7))
    assert first.was_cold
    assert first.feasible
    assert first.status.name == "converged"
    mpc.setPoses("target", [0.3, 0.3, 1.2])
    result = mpc.step(q, np.zeros(7), dt=0.01)
    assert not result.was_cold
    assert result.evals == 2
    assert result.status.name == "limit"
    assert result.cost > first.cost
    assert result.time > 0
    assert mpc.getPath().shape == (SLICES, 7)
    position, velocity = mpc.at(0.0)
    assert np.array_equal(position, q)
    assert np.array_equal(velocity, np.zeros(7))
    assert mpc.elapsed == 0.01


def test_the_problem_itself_stays_as_it_was():
    M = model()
    komo = horizon(M)
    before = np.array(komo.getPath())
    mpc = ry.Mpc(komo)
    mpc.setPoses("target", [0.3, 0.3, 1.2])
    mpc.step(M.getJointState(), np.zeros(7))
    assert np.array_equal(komo.getPath(), before)
    assert np.max(np.abs(mpc.getPath() - before)) > 0.01


def test_mistakes_are_named():
    M = model()
    mpc = ry.Mpc(horizon(M))
    with pytest.raises(ry.errors.FrameNotFound, match="target"):
        mpc.setPoses("traget", [0, 0, 0])
    with pytest.raises(ry.errors.ArgumentError, match="which joints move"):
        mpc.setPoses("l_gripper", [0, 0, 0])
    with pytest.raises(ry.errors.ArgumentError, match="q has 3 entries"):
        mpc.step([0, 0, 0], np.zeros(7))
    with pytest.raises(ry.errors.ArgumentError, match="evaluations is 1"):
        ry.Mpc(horizon(M), evaluations=1)
    mpc.microseconds = -1
    with pytest.raises(ry.errors.ArgumentError, match="microseconds is -1"):
        mpc.step(M.getJointState(), np.zeros(7))
