"""Part 26: a policy learns to push. A finger has to push a box to the center of a table, from random positions of both.

Many simulations run at once. The policy observes the finger relative to the box and to the direction of the center, and
returns a velocity: ten weights. The cross-entropy method finds them: sample weights, select the best, sample around
those. `python 26_train_a_policy.py curve.svg` plots the training; the environment variable GENERATIONS=5 shortens it.
"""

import os
import sys

import numpy as np
from numpy.typing import NDArray

import kinegraph as ry

Array = NDArray[np.float64]
GENERATIONS = int(os.environ.get("GENERATIONS", 20))
SAMPLES, ELITE, EPISODES = 32, 6, 4  # sampled and selected weights; episodes per sample
STEPS, TAU = 40, 0.1  # decisions in an episode, and their period in s
NEAR, FASTEST = 0.05, 0.3  # m from the center, which counts as success; m/s
FAST = {"inner_step": 0.01, "servo_frequency": 50}  # coarse steps are enough to push

C = ry.Config()
C.addFrame("table").setShape(ry.ST.box, [1.6, 1.6, 0.1]).setPosition([0, 0, -0.05]).setContact(1)
C.addFrame("base").setPosition([0, 0, 0.03])
finger = C.addFrame("finger", "base").setJoint(ry.JT.transXY, [-0.7, -0.7, 0.7, 0.7])
finger.setShape(ry.ST.sphere, [0.02]).setColor([1, 0.5, 0]).setMass(0.2).setContact(1)
C.addFrame("box").setShape(ry.ST.ssBox, [0.08, 0.08, 0.06, 0.01]).setMass(0.1).setContact(1)


def policy(weights: Array, finger: Array, box: Array) -> Array:
    """Returns velocities (N, 2) of N policies with weights (N, 10), from positions (N, 2). The policy is symmetric
    about the line from the box to the center."""
    distance = np.linalg.norm(box, axis=1) + 1e-9
    along = -box / distance[:, None]
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    ahead, aside = ((finger - box) * along).sum(1), ((finger - box) * left).sum(1)
    side = np.where(aside < 0, -1.0, 1.0)
    seen = np.stack([10 * ahead, 10 * abs(aside), np.exp(-abs(aside) / 0.03), 10 * distance, np.ones(len(box))], axis=1)
    forward, sideward = np.tanh(np.einsum("ni,nij->jn", seen, weights.reshape(-1, 5, 2)))
    return np.asarray(FASTEST * (forward[:, None] * along + (side * sideward)[:, None] * left))


def around(middle: Array, low: float, high: float, rng: np.random.Generator) -> Array:
    """Samples points around centers, at distances between `low` and `high`, in random directions."""
    angle, radius = rng.uniform(-np.pi, np.pi, len(middle)), rng.uniform(low, high, len(middle))
    return np.asarray(middle + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def play(batch: ry.SimulationBatch, weights: Array, finger: Array, box: Array) -> tuple[Array, Array]:
    """Runs one episode per row of weights; returns the mean reward and the final distances of the boxes from the
    center, m."""
    poses = np.tile([0, 0, 0.03, 1, 0, 0, 0], (len(box), 1, 1))
    poses[:, 0, :2] = box
    batch.place(None, finger, poses)
    total = np.zeros(len(weights))
    for _ in range(STEPS):
        batch.step(policy(weights, finger, box), TAU, ry.ControlMode.velocity)
        finger, box = batch.q(), batch.freePos()[:, 0, :2]
        total -= np.linalg.norm(box, axis=1) + 0.2 * np.linalg.norm(box - finger, axis=1)
    return total / STEPS, np.linalg.norm(box, axis=1)


def success(weights: Array, seed: int, episodes: int = 100) -> float:
    """Returns the share of new episodes, in %, that end near the center."""
    rng = np.random.default_rng(seed)
    box = around(np.zeros((episodes, 2)), 0.15, 0.3, rng)
    batch = ry.SimulationBatch(C, episodes, threads=2, options=FAST)
    far = play(batch, np.tile(weights, (episodes, 1)), around(box, 0.12, 0.25, rng), box)[1]
    return 100 * float((far < NEAR).mean())


def curve(rewards: list[float], file: str) -> None:
    """Plots the reward over the generations."""
    right, down = np.linspace(20, 580, len(rewards)), np.interp(rewards, [min(rewards), max(rewards)], [280, 30])
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(right, down, strict=True))
    with open(file, "w") as out:
        out.write('<svg xmlns="http://www.w3.org/2000/svg" width="600" height="300"><text x="20" y="20">')
        out.write(f"mean reward of {len(rewards)} generations, from {rewards[0]:.3f} to {rewards[-1]:.3f}</text>")
        out.write(f'<polyline points="{points}" fill="none" stroke="blue" stroke-width="2"/></svg>\n')


rng = np.random.default_rng(0)
mean, spread = np.zeros(10), np.ones(10)
before = success(rng.standard_normal(10), seed=1000)
batch = ry.SimulationBatch(C, SAMPLES * EPISODES, threads=2, options=FAST)
rewards = []
for generation in range(GENERATIONS):
    drawn = mean + spread * rng.standard_normal((SAMPLES, 10))
    at = around(np.zeros((EPISODES, 2)), 0.15, 0.3, rng)  # common to all samples, for a fair comparison
    starts = np.tile(around(at, 0.12, 0.25, rng), (SAMPLES, 1)), np.tile(at, (SAMPLES, 1))
    gained = play(batch, np.repeat(drawn, EPISODES, axis=0), *starts)[0].reshape(SAMPLES, EPISODES).mean(1)
    best = drawn[np.argsort(-gained, kind="stable")[:ELITE]]
    mean, spread = best.mean(0), best.std(0) + 0.5 * 0.85**generation
    rewards.append(float(gained.mean()))
    print(f"generation {generation + 1}: mean reward {rewards[-1]:.3f}")
after = success(mean, seed=1001)
C.view(False, "the finger and the box")
print(f"within 5 cm of the center, from 100 new starts: before {before:.0f} %, after {after:.0f} %")
if len(sys.argv) > 1:
    curve(rewards, sys.argv[1])
