"""The environments for gymnasium keep its rules, and the same seed gives the same run."""

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="needs the extra gym")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from kinegraph.gym import BatchEnv, LiftEnv, ReachEnv  # noqa: E402


@pytest.mark.parametrize("make", [ReachEnv, LiftEnv])
def test_an_environment_passes_the_checks_of_gymnasium(make):
    check_env(make(), skip_render_check=True)


@pytest.mark.parametrize("make", [ReachEnv, LiftEnv])
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
