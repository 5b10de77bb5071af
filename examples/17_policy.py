"""Part 17: a policy that learns in a gymnasium environment (`pip install kinegraph[gym]`).

A Panda learns to bring its hand to a ball by the cross-entropy method: policies are drawn at random, those that did best say where to
draw the next ones from. The policy is linear: joint velocities from where the ball is, seen from the hand.
"""

import numpy as np

from kinegraph.environments import ReachEnv

ROUNDS, CROWD, ELITE, EPISODES = 14, 24, 6, 3
STEPS = 40  # of an episode that does not end before
env = ReachEnv()
joints = env.action_space.shape[0]


def episode(policy: np.ndarray, seed: int) -> tuple[float, bool]:
    """The reward of an episode per step of its time, 0 once the ball is reached; and whether it is."""
    observation, _ = env.reset(seed=seed)
    rewards, done, over = [], False, False
    while not (done or over):
        hand, ball = observation[-6:-3], observation[-3:]
        observation, reward, done, over, _ = env.step(policy @ (10 * (ball - hand)))
        rewards.append(reward)
    return sum(rewards) / STEPS, done


rng = np.random.default_rng(0)
mean, spread = np.zeros((joints, 3)), 0.5 * np.ones((joints, 3))
curve = []
for i in range(ROUNDS):
    crowd = mean + spread * rng.normal(size=(CROWD, joints, 3))
    worth = [
        np.mean([episode(policy, seed)[0] for seed in range(i * EPISODES, (i + 1) * EPISODES)]) for policy in crowd
    ]
    best = crowd[np.argsort(worth)[-ELITE:]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 0.02
    curve.append(np.sort(worth)[-ELITE:].mean())

worst, top = min(curve), max(curve)
for i, value in enumerate(curve):  # the learning curve
    print(f"{i + 1:3d} {value:7.3f} m {'#' * (1 + round(50 * (value - worst) / (top - worst)))}")
reached = [episode(mean, 1000 + seed)[1] for seed in range(20)]
print(f"the ball is reached in {sum(reached)} of {len(reached)} episodes that it has not seen")
assert curve[-1] > curve[0] and sum(reached) >= 15
