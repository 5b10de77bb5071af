"""Part 10: many problems.

One problem from many starts, several problems at once, and samples of the feasible set.

A motion problem may have many solutions, or be a choice between several problems: which hand grasps the ball? All of
them are solved in parallel, with the same results for any number of threads.
"""

import numpy as np

from robotic import ry

np.set_printoptions(precision=3, suppress=True)

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandasTable.g"))
C.addFrame("ball").setShape(ry.ST.sphere, [0.05]).setColor([1, 0.5, 0]).setPosition([0.25, 0.15, 0.9])


def take(gripper: str) -> ry.KOMO:
    komo = ry.KOMO(C, 1, 20, 2, False)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1e0)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])
    komo.addObjective([1.0], ry.FS.positionDiff, [gripper, "ball"], ry.OT.eq, [1e1])
    return komo


# A discrete choice: each hand is a separate problem; the cheapest feasible one is chosen.
hands = ["l_gripper", "r_gripper"]
problems = [take(hand) for hand in hands]
answers = ry.solveAll(problems, threads=2)
for hand, ret in zip(hands, answers.results):
    print(f"{hand}: {ret.status.name}, feasible: {ret.feasible}, cost {ret.sos:.3f}")
print("taken by", hands[answers.chosen])
assert answers.feasible
problems[answers.chosen].view(True, "the motion of the hand that is chosen")

# One problem from the present path and from random ones: the best result.
komo = problems[answers.chosen]
result = komo.solveFromMany(6, threads=2, seed=1)
print(result)
print("costs:", np.array([ret.sos for ret in result.results]))
assert result.feasible and result.best.sos <= answers.best.sos + 1e-6

# Random configurations with the gripper at the ball.
hold = ry.KOMO(C, 1, 1, 0, False)
hold.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
hold.addObjective([], ry.FS.positionDiff, [hands[answers.chosen], "ball"], ry.OT.eq, [1e0])
sampler = ry.NLP_Sampler(hold.nlp()).setOptions(interiorMethod="MCMC", interiorSampleSteps=10)
samples = [sampler.sample() for _ in range(10)]
configurations = np.array([ret.x for ret in samples if ret.feasible])
print(len(configurations), "configurations; each joint spreads by", configurations.std(axis=0))
