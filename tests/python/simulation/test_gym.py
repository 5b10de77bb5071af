"""Environments follow the rules of gymnasium, and equal seeds give equal runs."""

import numpy as np
import pytest

import kinegraph as ry

gymnasium = pytest.importorskip("gymnasium", reason="needs the extra gym")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from kinegraph.gym import BatchEnv, LiftEnv, PushEnv, ReachEnv, SimulationEnv  # noqa: E402


@pytest.mark.parametrize("make", [ReachEnv, LiftEnv, PushEnv])
def test_an_environment_passes_the_checks_of_gymnasium(make):
    check_env(make(), skip_render_check=True)


@pytest.mark.parametrize("name, kind", [("Reach", ReachEnv), ("Lift", LiftEnv), ("Push", PushEnv)])
def test_environments_are_made_by_their_names_and_end_after_10_s(name, kind):
    env = gymnasium.make(f"kinegraph.gym:kinegraph/{name}-v0")
    assert isinstance(env.unwrapped, kind)
    env.reset(seed=1)
    rest = np.zeros(env.action_space.shape, np.float32)
    ends = [env.step(rest)[2:4] for _ in range(200)]
    assert [any(end) for end in ends] == [False] * 199 + [True]
    assert ends[-1] == (False, True)


@pytest.mark.parametrize("make", [ReachEnv, LiftEnv, PushEnv])
def test_the_same_seed_gives_the_same_run(make):
    runs = []
    for _ in range(2):
        env = make()
        env.action_space.seed(1)
        observations = [env.reset(seed=3)[0]]
        observations += [env.step(env.action_space.sample())[0] for _ in range(20)]
        runs.append(np.array(observations))
    assert np.array_equal(*runs)
    assert np.isfinite(runs[0]).all()


def test_many_at_once_give_the_same_with_two_threads():
    runs = []
    for threads in (1, 2):
        env = BatchEnv(8, threads)
        env.action_space.seed(1)
        first, _ = env.reset(seed=5)
        assert env.observation_space.contains(first)
        rewards = [env.step(env.action_space.sample())[1] for _ in range(10)]
        runs.append(np.array(rewards))
    assert np.array_equal(*runs)
    assert (runs[0] < 0).all()


def test_the_reward_grows_while_a_box_is_pushed():
    """The first joint turns towards the box: the stick pushes it, nearer to the target and then past it."""
    env = PushEnv(time_limit=4.0)
    rewards, is_over = [], False
    env.reset()
    start = env.C.getFrame("box").getPosition()
    while not is_over:
        _, reward, ended, is_over, _ = env.step(-np.eye(7, dtype=np.float32)[0])
        rewards.append(reward)
        assert not ended
    assert len(rewards) == 80
    assert np.linalg.norm(env.C.getFrame("box").getPosition() - start) > 0.1
    assert max(rewards) > rewards[0] + 0.1 and max(rewards) > rewards[-1] + 0.1
    first, _ = env.reset()
    assert env.C.getFrame("box").getPosition() == pytest.approx(start, abs=1e-12)
    assert np.array_equal(first, env.reset()[0])


def test_any_scene_with_any_reward_is_an_environment():
    C = ry.Config()
    C.addText("rail: { X: [0 0 1] } slide (rail): { joint: transX, mass: 1, limits: [-1 1] }")
    env = SimulationEnv(C, 1.0, lambda C: -abs(C.getJointState()[0] - 0.5), fastest=2.0)
    check_env(env, skip_render_check=True)
    env.reset()
    rewards = [env.step(np.ones(1, np.float32))[1] for _ in range(5)]
    assert rewards == pytest.approx([-0.4, -0.3, -0.2, -0.1, 0.0], abs=0.02)
    with pytest.raises(ry.ArgumentError, match="render_mode is 'ansi'"):
        SimulationEnv(C, 1.0, lambda C: 0.0, render_mode="ansi")
    with pytest.raises(ry.ArgumentError, match="time_limit is 0 s"):
        SimulationEnv(C, 0, lambda C: 0.0)
