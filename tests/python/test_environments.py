"""Environments of gymnasium."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph as ry

pytest.importorskip("gymnasium", reason="the extra gym")

from gymnasium.utils.env_checker import check_env

from kinegraph.environments import LiftEnv, Randomization, ReachEnv, RobotEnv

FREE_TO_BE_LARGE = "ignore:.*(Box observation space|render modes).*:UserWarning"  # joint values have no bounds


@pytest.mark.filterwarnings(FREE_TO_BE_LARGE)
@pytest.mark.parametrize("make", [ReachEnv, LiftEnv])
def test_gymnasium_accepts_the_environment(make: type[RobotEnv]) -> None:
    check_env(make(render_mode="rgb_array"))


@pytest.mark.parametrize("make", [ReachEnv, LiftEnv])
@pytest.mark.parametrize("randomize", [None, Randomization(0.2, 0.3, 0.02, 0.1)])
def test_the_same_seed_and_actions_give_the_same_episode(make: type[RobotEnv], randomize: Randomization | None) -> None:
    def run(seed: int) -> np.ndarray:
        env = make(randomize=randomize)
        rng = np.random.default_rng(0)
        seen = [env.reset(seed=seed)[0]]
        for _ in range(10):
            seen.append(env.step(rng.uniform(-1, 1, env.action_space.shape))[0])
        return np.array(seen)

    np.testing.assert_array_equal(run(3), run(3))
    assert not np.array_equal(run(3), run(4))


def test_an_episode_begins_where_it_began_and_ends_with_its_time() -> None:
    env = ReachEnv(time_limit=0.5)
    first, _ = env.reset(seed=1)
    steps = 0
    over = False
    while not over:
        _, reward, _, over, info = env.step(np.ones(7))
        steps += 1
        assert reward == pytest.approx(-env.distance(env.C))
    assert steps == 10 and info["time"] == pytest.approx(0.5)
    np.testing.assert_array_equal(env.reset(seed=1)[0], first)


def test_joints_go_as_fast_as_the_action_says_and_stay_within_their_limits() -> None:
    env = ReachEnv(speed=0.5)
    start = env.reset(seed=0)[0][:7]
    seen = env.step(0.5 * np.eye(7)[0])[0]
    assert seen[0] - start[0] == pytest.approx(0.5 * 0.5 * 0.05, abs=2e-3)
    assert seen[1:7] == pytest.approx(start[1:7], abs=2e-3)
    for _ in range(200):
        seen = env.step(np.eye(7)[5])[0]
    assert seen[5] == pytest.approx(3.0, abs=5e-3)  # the limit


def test_a_box_can_be_lifted() -> None:
    env = LiftEnv(time_limit=20.0, randomize=Randomization(position=0.02, mass=0.2))
    seen, _ = env.reset(seed=2)
    done, steps, closed = False, 0, 0
    while not done and steps < 300:  # a policy by hand: above, down, close, up
        hand, box = seen[14:17], seen[17:20]
        away = box - hand
        if closed == 0 and np.linalg.norm(away[:2]) > 0.01:
            target = away + np.array([0, 0, 0.12])
        elif closed == 0 and abs(away[2]) > 0.01:
            target = away
        else:
            closed += 1
            target = np.array([0, 0, 0.3 if closed > 12 else 0.0])
        seen, reward, done, _, _ = env.step(np.append(5 * target, -1.0 if closed else 1.0))
        steps += 1
    assert done and env.lifted(env.C) > 0.1 and reward > 0.9


def test_what_makes_no_sense_is_an_error() -> None:
    with pytest.raises(ry.ArgumentError, match="expected \\(7,\\)"):
        env = ReachEnv()
        env.reset(seed=0)
        env.step(np.zeros(3))
    with pytest.raises(ry.ArgumentError, match="mass is 1.5"):
        Randomization(mass=1.5)
    with pytest.raises(ry.ArgumentError, match="render_mode is 'human'"):
        ReachEnv(render_mode="human")
    with pytest.raises(ry.FrameNotFound):
        RobotEnv(ry.Config(), lambda C: 0.0, ("nothing",))
