#!/usr/bin/env python3
"""Solves random reaches behind obstacles by the default solver: number solved, evaluations, and costs.

    python benchmarks/reaches.py [--problems 120] [--seed 1] [--save FILE] [--against FILE]

Four robots (a Panda on its table, a mobile Panda, a UR10, a small mobile arm) start at random collision-free
configurations. The goal is the gripper position of another one. Up to five balls, boxes and capsules lie around, if
possible one of them on the straight path in joint space. Paths have 16, 32, 64 or 128 slices. Some problems also have a
direction of the gripper, joint limits, or other weights. The seed determines all numbers.

An answer is solved if it misses the goal by at most 1 mm (direction: 1e-2) and no slice has a collision deeper than 1
mm, regardless of the solver's status. --save stores the answers as JSON. --against compares with such a file problem by
problem: solved or not, evaluations, and costs of problems that both solve. Costs are compared as long as both are
within the tolerance of the solver.
"""

import argparse
import json
from pathlib import Path
from time import process_time

import numpy as np

import kinegraph as ry

GRIPPERS = {
    "panda": ("scenarios/pandaSingle.g", "l_gripper"),
    "mobile": ("scenarios/panda_mobile.g", "gripper"),
    "ur10": ("ur10/ur10.g", "ur_ee_fixed_joint"),
    "mini": ("scenarios/mobileMini.g", "gripperCenter"),
}
LENGTHS = [16, 32, 64, 128]
MOST_DEPTH, MOST_MISS, MOST_TURN = 1e-3, 1e-3, 1e-2


def depth(C, q):
    """Returns the sum of all penetrations, m."""
    C.setJointState(q)
    C.computeCollisions()
    return C.getTotalPenetration()


def addObstacle(C, name, position, rng):
    kind = rng.integers(3)
    size = rng.uniform(0.04, 0.12)
    frame = C.addFrame(name)
    if kind == 0:
        frame.setShape(ry.ST.sphere, [size])
    elif kind == 1:
        frame.setShape(ry.ST.ssBox, [*(2 * size * rng.uniform(0.4, 1.2, 3)), 0.01])
    else:
        frame.setShape(ry.ST.capsule, [rng.uniform(0.1, 0.5), 0.6 * size])
    turn = rng.standard_normal(4)
    frame.setPosition(position).setQuaternion(turn / np.linalg.norm(turn)).setContact(1)


def range_of_joints(C):
    lower, upper = C.getJointLimits()
    home = C.getJointState()
    has_limits = upper > lower
    lower = np.where(has_limits, np.maximum(lower, home - 2.0), home - 2.0)
    upper = np.where(has_limits, np.minimum(upper, home + 2.0), home + 2.0)
    return lower, np.maximum(lower, upper)


def problems(count, seed):
    """Yields scene, start, and objectives."""
    rng = np.random.default_rng(seed)
    names = list(GRIPPERS)
    scenes = {}
    for robot, (file, _) in GRIPPERS.items():
        scenes[robot] = ry.Config()
        scenes[robot].addFile(ry.raiPath(file))
        if robot == "ur10":
            for frame in scenes[robot].getFrames():
                if frame.getShapeType() not in (None, ry.ST.none):
                    frame.setContact(-1)
            scenes[robot].ignoreCollisionsNow()
    made = 0
    while made < count:
        robot = names[made % len(names)]
        gripper = GRIPPERS[robot][1]
        C = scenes[robot].copy()
        lower, upper = range_of_joints(C)
        start, goal = C.getJointState() + rng.uniform(-0.4, 0.4, len(lower)), rng.uniform(lower, upper)
        start = np.clip(start, lower, upper)
        if robot in ("mobile", "mini"):
            goal[:2] = start[:2] + rng.uniform(-1.0, 1.0, 2)
        if depth(C, start) > 0 or depth(C, goal) > 0:
            continue
        place = np.array(C.getFrame(gripper).getPosition())
        direction = np.array(C.getFrame(gripper).getRotationMatrix())[:, 2]
        C.setJointState(0.5 * (start + goal))
        middle = np.array(C.getFrame(gripper).getPosition())
        for i in range(rng.integers(1, 6)):
            spread = 0.03 if i == 0 else 0.35
            addObstacle(C, f"obstacle{i}", middle + spread * rng.standard_normal(3), rng)
        if depth(C, start) > 0 or depth(C, goal) > 0:
            continue
        if all(depth(C, start + s * (goal - start)) == 0 for s in np.linspace(0, 1, 41)):
            continue
        C.setJointState(start)
        yield (
            C,
            {
                "robot": robot,
                "gripper": gripper,
                "slices": LENGTHS[(made // len(names)) % len(LENGTHS)],
                "start": start,
                "goal": place,
                "direction": direction if rng.random() < 0.3 else None,
                "limits": bool(rng.random() < 0.5),
                "collision": float(rng.choice([1.0, 10.0])),
                "velocity": float(rng.choice([0.0, 1e-1])),
                "home": float(rng.choice([0.0, 1e-2])),
            },
        )
        made += 1


def build(C, ask):
    komo = ry.KOMO(C, 1, ask["slices"], 2, True)
    if ask["home"]:
        komo.addControlObjective([], 0, ask["home"])
    if ask["velocity"]:
        komo.addControlObjective([], 1, ask["velocity"])
    komo.addControlObjective([], 2, 1.0)
    if ask["limits"]:
        komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1.0])
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [ask["collision"]])
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [1.0], [], order=1)
    komo.addObjective([1.0], ry.FS.position, [ask["gripper"]], ry.OT.eq, [10.0], ask["goal"])
    if ask["direction"] is not None:
        komo.addObjective([1.0], ry.FS.vectorZ, [ask["gripper"]], ry.OT.eq, [1.0], ask["direction"])
    return komo


def solve(C, ask):
    begin = process_time()
    komo = build(C, ask)
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    seconds = process_time() - begin
    path = np.array(komo.getPath())
    deepest = max(depth(C, q) for q in path)
    C.setJointState(path[-1])
    miss = float(np.linalg.norm(np.array(C.getFrame(ask["gripper"]).getPosition()) - ask["goal"]))
    turn = 0.0
    if ask["direction"] is not None:
        seen = np.array(C.getFrame(ask["gripper"]).getRotationMatrix())[:, 2]
        turn = float(np.linalg.norm(seen - ask["direction"]))
    return {
        "robot": ask["robot"],
        "slices": ask["slices"],
        "solved": deepest < MOST_DEPTH and miss < MOST_MISS and turn < MOST_TURN,
        "feasible": bool(result.feasible),
        "status": result.status.name,
        "cost": float(result.sos + result.f),
        "violation": float(max(result.eq, result.ineq)),
        "evaluations": int(result.evals),
        "seconds": seconds,
    }


def row(title, answers):
    solved = [a for a in answers if a["solved"]]
    evaluations = [a["evaluations"] for a in solved]
    print(
        f"{title:12}{len(solved):5}/{len(answers):<5}feasible {sum(a['feasible'] for a in answers):4}   evaluations of solved: "
        f"median {np.median(evaluations) if evaluations else 0:5.0f}, mean {np.mean(evaluations) if evaluations else 0:6.1f}   "
        f"all {sum(a['evaluations'] for a in answers):6}   ms {1e3 * sum(a['seconds'] for a in answers):8.0f}"
    )


def compare(answers, before):
    both = [(a, b) for a, b in zip(answers, before, strict=True) if a["solved"] and b["solved"]]
    gained = sum(a["solved"] and not b["solved"] for a, b in zip(answers, before, strict=True))
    lost = sum(b["solved"] and not a["solved"] for a, b in zip(answers, before, strict=True))
    print(f"\nsolved now and not before: {gained}, before and not now: {lost}; by both: {len(both)}")
    ratios = np.array([a["evaluations"] / b["evaluations"] for a, b in both])
    total = [sum(pair[k]["evaluations"] for pair in both) for k in (0, 1)]
    print(
        f"evaluations of these: {total[0]} for {total[1]}; geometric mean of the ratios {np.exp(np.log(ratios).mean()):.3f}, "
        f"fewer in {np.sum(ratios < 1)}, more in {np.sum(ratios > 1)}"
    )
    costs = np.array([(a["cost"] + 1e-6) / (b["cost"] + 1e-6) for a, b in both])
    print(
        f"costs: geometric mean of the ratios {np.exp(np.log(costs).mean()):.4f}, "
        f"lower by 1 % in {np.sum(costs < 0.99)}, higher by 1 % in {np.sum(costs > 1.01)}"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problems", type=int, default=120)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--save", type=Path)
    parser.add_argument("--against", type=Path)
    options = parser.parse_args()
    answers = [solve(C, ask) for C, ask in problems(options.problems, options.seed)]
    if options.save:
        options.save.write_text(json.dumps(answers))
    for robot in GRIPPERS:
        row(robot, [a for a in answers if a["robot"] == robot])
    for slices in LENGTHS:
        row(f"{slices} slices", [a for a in answers if a["slices"] == slices])
    row("all", answers)
    if options.against:
        compare(answers, json.loads(options.against.read_text()))


if __name__ == "__main__":
    main()
