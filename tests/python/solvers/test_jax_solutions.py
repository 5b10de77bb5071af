"""kinegraph.jax: gradients through solutions equal differences, in jit and in batches."""

import numpy as np
import pytest

jax = pytest.importorskip("jax", reason="needs the extra jax")

import kinegraph as ry  # noqa: E402

jax.config.update("jax_enable_x64", True)
import jax.numpy as jnp  # noqa: E402

from kinegraph.jax import solve, solveIk  # noqa: E402


@pytest.fixture
def panda():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("box").setPosition([0.3, 0.3, 1.0])
    return C


def assertGradient(function, *values, h=1e-5):
    """Against central differences, for each array."""
    gradients = jax.grad(function, argnums=tuple(range(len(values))))(*values)
    for k, value in enumerate(values):
        assert gradients[k].shape == value.shape
        for index in np.ndindex(value.shape):
            ends = []
            for sign in (1, -1):
                moved = [np.array(v) for v in values]
                moved[k][index] += sign * h
                ends.append(function(*moved))
            assert gradients[k][index] == pytest.approx(float(ends[0] - ends[1]) / (2 * h), abs=2e-5)


def test_through_inverse_kinematics(panda):
    reach = solveIk(panda, ["l_gripper"], home_weight=1.0)
    weights = jnp.asarray(np.random.default_rng(0).normal(size=(3, 7)))
    positions = np.array([0.3, 0.3, 1.1]) + 0.05 * np.random.default_rng(1).normal(size=(3, 3))
    q = panda.getJointState()
    f = jax.jit(lambda p: (weights * (reach(p) - q)).sum())
    got = jax.grad(f)(positions)
    expected = np.stack(
        [
            ry.solveIk(panda, {"l_gripper": p}, home_weight=1.0).sensitivity().gradient(w)
            for p, w in zip(positions, weights)
        ]
    )
    np.testing.assert_allclose(got, expected, atol=1e-12)
    assert reach(positions).shape == (3, 7)


def test_through_inverse_kinematics_of_poses_of_any_norm(panda):
    pose = panda.getFrame("l_gripper").getPose() + np.array([0.03, 0.04, 0.05, 0, 0, 0, 0])
    poses = pose[None] * [1, 1, 1, 2, 2, 2, 2]
    reach = solveIk(panda, ["l_gripper"], home_weight=1.0, position_tolerance=1e-9, rotation_tolerance=1e-9)
    f = lambda p: reach(p)[0, 1]  # noqa: E731
    gradient = np.asarray(jax.grad(f)(poses))[0]
    assert abs(gradient[3:] @ poses[0, 3:]) < 1e-9, "what changes the norm changes nothing"
    exact = lambda p: ry.solveIk(panda, {"l_gripper": p}, home_weight=1.0).sensitivity().x[1]  # noqa: E731
    for k in range(7):
        by = 1e-5 * np.eye(7)[k]
        difference = (exact(poses[0] + by) - exact(poses[0] - by)) / 2e-5
        assert gradient[k] == pytest.approx(difference, abs=2e-5)


def test_through_a_motion_problem(panda):
    def make(position, target):
        panda.getFrame("box").setPosition(position)
        komo = ry.KOMO(panda, 1, 4, 2, False)
        komo.addControlObjective([], 2, 1.0)
        komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [10], target)
        return komo

    path = solve(make, ["box", "positionDiff"], 28, threads=2)
    positions, targets = np.array([[0.3, 0.3, 1.0], [0.2, 0.35, 1.1]]), np.array([[0.0, 0.0, 0.1], [0.01, 0.0, 0.0]])
    assertGradient(lambda p, t: (path(p, t)[:, -7:] ** 2).sum(), positions, targets)


def test_problems_without_answers_are_told_or_count_nothing(panda):
    far = np.array([[5.0, 5.0, 5.0], [0.3, 0.3, 1.1]])
    with pytest.raises(Exception, match="1 of 2 targets are unsolved"):
        solveIk(panda, ["l_gripper"], attempts=1)(far).block_until_ready()
    reach = solveIk(panda, ["l_gripper"], attempts=1, unsolved="zero")
    gradient = jax.grad(lambda p: reach(p).sum())(far)
    assert not gradient[0].any()
    assert gradient[1].any()
