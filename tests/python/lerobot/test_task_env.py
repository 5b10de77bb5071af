"""TaskEnv, the environment of policies that learn from demonstrations."""

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.lerobot import rehearse

pytest.importorskip("gymnasium", reason="needs gymnasium")

from kinegraph.task_env import TaskEnv

GOAL = "(on tray box)"


def scene():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box", "table").setRelativePosition([0.2, 0.25, 0.09])
    box.setShape(ry.ST.ssBox, [0.04, 0.05, 0.08, 0.004]).setContact(1).setJoint(ry.JT.rigid).setMass(0.1)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.25, 0.055])
    tray.setShape(ry.ST.ssBox, [0.14, 0.14, 0.01, 0.004]).setContact(1)
    return C


@pytest.mark.parametrize("seed", [0, 1])
def test_the_commands_of_a_plan_reach_the_goal(seed):
    env = TaskEnv(scene(), GOAL)
    observation, info = env.reset(seed=seed)
    assert env.observation_space.contains(observation) and not info["is_success"]
    rows = rehearse(env.world, GOAL)
    assert rows.shape[1] == len(env.names) == 8
    rewards, done = [], False
    for row in [*rows, *[rows[-1]] * 20]:
        observation, reward, done, truncated, info = env.step(row)
        rewards.append(reward)
        if done:
            break
    assert done and info["is_success"] and not truncated and rewards == [0.0] * (len(rewards) - 1) + [1.0]
    assert len(rewards) > 0.7 * len(rows)  # not while the hand still holds the box
    env.close()


def test_equal_seeds_give_equal_episodes_and_others_differ():
    env = TaskEnv(scene(), GOAL, cameras=["cameraTop"], size=(24, 32))
    assert env.observation_space["pixels"]["cameraTop"].shape == (24, 32, 3)
    seen = []
    for seed in (3, 3, 4):
        env.reset(seed=seed)
        for _ in range(3):
            observation, _, done, _, _ = env.step(env.action_space.low * 0 + observation_of(env))
        assert not done
        seen.append(
            (observation["agent_pos"], observation["pixels"]["cameraTop"], env.world.getFrame("box").getPosition())
        )
    for a, b in zip(seen[0], seen[1], strict=True):
        np.testing.assert_array_equal(a, b)
    assert np.abs(seen[0][2] - seen[2][2]).max() > 1e-3
    assert env.render().shape == (24, 32, 3)


def observation_of(env):
    return np.append(env.world.getJointState(), 0.08)


def test_wild_commands_stay_within_the_limits():
    env = TaskEnv(scene(), GOAL)
    env.reset(seed=0)
    lower, upper = env.world.getJointLimits()
    for command in np.random.default_rng(0).uniform(-10, 10, (30, 8)):
        observation, _, done, _, _ = env.step(command)
        q = observation["agent_pos"][:7]
        assert not done and (q > lower - 0.05).all() and (q < upper + 0.05).all()


def test_a_box_in_the_hand_above_the_tray_is_no_success():
    env = TaskEnv(scene(), GOAL)
    env.reset(seed=0)
    rows = rehearse(env.world, GOAL)
    closed = np.flatnonzero(rows[:, 7] < 1e-3)
    for row in rows[: closed[-1] + 1]:
        _, reward, done, _, _ = env.step(row)
        assert not done and reward == 0.0
    for _ in range(20):
        assert not env.step(rows[closed[-1]])[2]


def test_wrong_arguments_are_named():
    with pytest.raises(ry.ArgumentError, match=r"the goal is '\(held box\)'; expected literals \(on PLACE OBJECT\)"):
        TaskEnv(scene(), "(held box)")
    with pytest.raises(ry.ArgumentError, match="fps is 30; expected a divisor of the control rate"):
        TaskEnv(scene(), GOAL, fps=30)
    with pytest.raises(ry.FrameNotFound, match="bocks"):
        TaskEnv(scene(), "(on tray bocks)")
    with pytest.raises(ry.FrameNotFound, match="camera"):
        TaskEnv(scene(), GOAL, cameras=["camera"])
    env = TaskEnv(scene(), GOAL)
    for action in (np.zeros(7), np.full(8, np.nan)):
        with pytest.raises(ry.ArgumentError, match=r"TaskEnv\.step: the action is .* expected 8 finite numbers"):
            env.step(action)


def test_a_rehearsal_without_a_plan_says_why():
    C = scene()
    C.getFrame("box").setRelativePosition([2.0, 0.25, 0.09])
    with pytest.raises(ry.Error, match="rehearse: "):
        rehearse(C, GOAL)
