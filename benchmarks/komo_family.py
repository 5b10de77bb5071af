#!/usr/bin/env python3
"""Solves random motion problems that nobody tuned to: number solved, evaluations, costs and times per kind.

    python benchmarks/komo_family.py [--count 10] [--seed 1] [--kinds phases,switches] [--save FILE] [--against FILE]

`count` problems of each kind. The seed determines all of them, and no two seeds share a problem. Each has a capsule, a
ball or a box on the straight path in joint space, which therefore collides:

    phases      a Panda visits ten positions, one after the other, 32 slices each; obstacles block at least three ways
    reach 32    a Panda reaches a position behind obstacles, 32 slices
    reach 128   the same, 128 slices
    two arms    two Pandas reach a position each at the same time, 32 slices
    mobile      a Panda on a base with wheels reaches a position, 32 slices
    switches    a Panda picks a box and places it elsewhere on the table, two phases of 16 slices, two mode switches

All problems have collisions of all slices, those of the robot with itself included. A path is solved if it misses its
positions by at most 1 mm and no slice collides deeper than 1 mm. For `switches`, no constraint may be violated by more
than 1e-2, that is, 1 mm at a weight of 10. The solver's status does not count. Costs are those of the solver's NLP.

`--save` keeps the answers, `--against` compares with kept ones problem by problem: solved or not, evaluations, costs.
`python benchmarks/komo.py --reference ...` runs the same problems in turns with the package `robotic`.
"""

import argparse
import json
import sys
from itertools import pairwise
from pathlib import Path
from time import process_time

SCENES = {
    "panda": ("scenarios/pandaSingle.g", ["l_gripper"]),
    "two arms": ("scenarios/pandasTable.g", ["l_gripper", "r_gripper"]),
    "mobile": ("scenarios/panda_mobile.g", ["gripper"]),
}
KINDS = {
    "phases": ("panda", 10, 32),
    "reach 32": ("panda", 1, 32),
    "reach 128": ("panda", 1, 128),
    "two arms": ("two arms", 1, 32),
    "mobile": ("mobile", 1, 32),
    "switches": ("panda", 2, 16),
}
BLOCKED = 3  # ways of `phases` that obstacles block at least
MOST_DEPTH, MOST_MISS, MOST_VIOLATION = 1e-3, 1e-3, 1e-2


# --- the part that both packages run --------------------------------------------------------------------------------


def loadScene(ry, robot):
    C = ry.Config()
    C.addFile(ry.raiPath(SCENES[robot][0]))
    return C


def addObstacle(ry, C, name, obstacle):
    shape = {"capsule": ry.ST.capsule, "ball": ry.ST.sphere, "box": ry.ST.ssBox}[obstacle["shape"]]
    frame = C.addFrame(name).setShape(shape, obstacle["size"])
    frame.setPosition(obstacle["position"]).setQuaternion(obstacle["quaternion"]).setContact(1)


def makeScene(ry, problem):
    C = loadScene(ry, problem["robot"])
    for i, obstacle in enumerate(problem["obstacles"]):
        addObstacle(ry, C, f"obstacle{i}", obstacle)
    if problem["kind"] == "switches":
        C.addFrame("box").setPosition(problem["box"]).setShape(ry.ST.ssBox, [0.04, 0.04, 0.04, 0.005]).setContact(1)
        C.addFrame("place").setPosition(problem["place"]).setShape(ry.ST.marker, [0.1])
    C.setJointState(problem["start"])
    return C


def buildKomo(ry, C, problem):
    komo = ry.KOMO(C, problem["phases"], problem["slices"], 2, True)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, problem["acceleration"])
    weight = 1e1 if problem["kind"] == "switches" else 1e0
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [weight])
    komo.addObjective([float(problem["phases"])], ry.FS.jointState, [], ry.OT.eq, [1e0], [], order=1)
    for goal in problem["goals"]:
        komo.addObjective([goal["time"]], ry.FS.position, [goal["gripper"]], ry.OT.eq, [1e1], goal["position"])
    if problem["kind"] == "switches":
        komo.addQuaternionNorms()
        komo.addModeSwitch([1.0, 2.0], ry.SY.stable, ["l_gripper", "box"], True)
        komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [1e1])
        komo.addObjective([1.0], ry.FS.scalarProductXZ, ["l_gripper", "box"], ry.OT.eq, [1e1])
        komo.addObjective([1.0], ry.FS.scalarProductXX, ["l_gripper", "box"], ry.OT.eq, [1e1])
        komo.addModeSwitch([2.0, -1.0], ry.SY.stableOn, ["table", "box"], False)
        komo.addObjective([2.0], ry.FS.positionDiff, ["box", "place"], ry.OT.eq, [[1e1, 0, 0], [0, 1e1, 0]])
    return komo


def depth(C, q):
    """Returns the sum of all penetrations, m."""
    C.setJointState(q)
    C.computeCollisions()
    return C.coll_totalViolation()


def solve(ry, np, problem, options):
    C = makeScene(ry, problem)
    start = process_time()
    komo = buildKomo(ry, C, problem)
    nlp = komo.nlp()
    solver = ry.NLP_Solver(nlp, verbose=0)
    if options:
        solver.setOptions(verbose=0, **options)
    answer = solver.solve()
    path = np.array(komo.getPath())
    seconds = process_time() - start
    phi, _ = nlp.evaluate(answer.x)
    kinds = [str(kind).split(".")[-1] for kind in nlp.getTypes()]
    violations = [abs(v) if kind == "eq" else max(v, 0.0) for v, kind in zip(phi, kinds) if kind in ("eq", "ineq")]
    return {
        "kind": problem["kind"],
        "evaluations": int(answer.evals),
        "seconds": seconds,
        "cost": float(sum(v * v for v, kind in zip(phi, kinds) if kind == "sos")),
        "violation": float(max(violations)),
        "status": str(getattr(answer, "status", "")).split(".")[-1],
        "path": path.tolist(),
    }


def solveFamily(ry, np, task):
    return {"answers": [solve(ry, np, problem, task.get("options")) for problem in task["problems"]]}


def isSolved(ry, np, problem, answer):
    if problem["kind"] == "switches":
        return answer["violation"] <= MOST_VIOLATION
    C = makeScene(ry, problem)
    path = np.array(answer["path"])
    if max(depth(C, q) for q in path) > MOST_DEPTH:
        return False
    for goal in problem["goals"]:
        C.setJointState(path[round(goal["time"] * problem["slices"]) - 1])
        if np.linalg.norm(np.array(C.getFrame(goal["gripper"]).getPosition()) - goal["position"]) > MOST_MISS:
            return False
    return True


def checkFamily(ry, np, task):
    return {"solved": [bool(isSolved(ry, np, p, a)) for p, a in zip(task["problems"], task["answers"])]}


# --- the problems, by Kinegraph -------------------------------------------------------------------------------------


def randomObstacle(np, rng, position):
    shape = ["capsule", "ball", "box"][rng.integers(3)]
    size = float(rng.uniform(0.04, 0.09))
    sizes = {"capsule": [float(rng.uniform(0.15, 0.5)), 0.6 * size], "ball": [size], "box": [2 * size] * 3 + [0.01]}
    turn = rng.standard_normal(4)
    position, turn = np.round(position, 4), turn / np.linalg.norm(turn)
    return {"shape": shape, "size": sizes[shape], "position": position.tolist(), "quaternion": turn.tolist()}


def grippers(np, C, robot, q):
    C.setJointState(q)
    return [np.array(C.getFrame(name).getPosition()) for name in SCENES[robot][1]]


def randomConfiguration(np, rng, C, robot, home):
    """Returns joints without collision whose grippers are well above the table."""
    lower, upper = C.getJointLimits()
    while True:
        q = home + rng.uniform(-1.0, 1.0, len(home))
        q = np.where(upper > lower, np.clip(q, lower + 0.05, upper - 0.05), q)
        if depth(C, q) == 0.0 and all(position[2] > 0.75 for position in grippers(np, C, robot, q)):
            return q


def isBlocked(np, C, start, end):
    return any(depth(C, start + s * (end - start)) > MOST_DEPTH for s in np.linspace(0, 1, 33))


def drawWay(ry, np, rng, kind):
    """Returns a problem, or None if the drawn obstacles do not suit."""
    robot, phases, slices = KINDS[kind]
    C = loadScene(ry, robot)
    home = C.getJointState()
    stops = [home + rng.uniform(-0.2, 0.2, len(home))] + [
        randomConfiguration(np, rng, C, robot, home) for _ in range(phases)
    ]
    problem = {"kind": kind, "robot": robot, "phases": phases, "slices": slices, "obstacles": []}
    for i in range(3 if phases > 1 else int(rng.integers(1, 4))):
        leg = int(rng.integers(phases))
        places = grippers(np, C, robot, 0.5 * (stops[leg] + stops[leg + 1]))
        place = places[rng.integers(len(places))] + (0.03 if i == 0 else 0.1) * rng.standard_normal(3)
        problem["obstacles"].append(randomObstacle(np, rng, place))
        addObstacle(ry, C, f"obstacle{i}", problem["obstacles"][-1])
    if any(depth(C, q) > 0.0 for q in stops):
        return None
    if sum(isBlocked(np, C, a, b) for a, b in pairwise(stops)) < (BLOCKED if phases > 1 else 1):
        return None
    problem["goals"] = [
        {"time": i + 1.0, "gripper": name, "position": np.round(position, 4).tolist()}
        for i, q in enumerate(stops[1:])
        for name, position in zip(SCENES[robot][1], grippers(np, C, robot, q))
    ]
    return problem | {"start": np.round(stops[0], 4).tolist(), "acceleration": float(rng.choice([0.1, 1.0]))}


def drawSwitches(ry, np, rng, kind):
    """Returns a problem of pick and place with an obstacle between both places, or None."""
    robot, phases, slices = KINDS[kind]
    C = loadScene(ry, robot)
    box, place = rng.uniform([-0.45, 0.1], [0.45, 0.45], (2, 2))
    if np.linalg.norm(box - place) < 0.3:
        return None
    middle = [*(0.5 * (box + place)), 0.65 + rng.uniform(0.05, 0.25)]
    obstacle = randomObstacle(np, rng, np.array(middle))
    problem = {"kind": kind, "robot": robot, "phases": phases, "slices": slices, "obstacles": [obstacle], "goals": []}
    problem["start"] = np.round(C.getJointState(), 4).tolist()
    problem["box"], problem["place"] = [[*np.round(p, 4).tolist(), 0.67] for p in (box, place)]
    problem["acceleration"] = 0.1
    near = min(np.linalg.norm(np.array(middle[:2]) - p) for p in (box, place))
    C = makeScene(ry, problem)
    return problem if near > 0.15 and depth(C, problem["start"]) == 0.0 else None


def drawFamily(ry, np, task):
    problems = []
    for number, kind in enumerate(KINDS):
        rng = np.random.default_rng([task["seed"], number])
        draw = drawSwitches if kind == "switches" else drawWay
        made = 0
        while kind in task.get("kinds", KINDS) and made < task["count"]:
            problem = draw(ry, np, rng, kind)
            if problem:
                problems.append(problem)
                made += 1
    return {"problems": problems}


# --- tables ---------------------------------------------------------------------------------------------------------


def median(values, form):
    ordered = sorted(values)
    return form.format(0.5 * (ordered[len(ordered) // 2] + ordered[(len(ordered) - 1) // 2])) if ordered else "-"


def printRow(kind, solved, answers):
    mine = [(s, a) for s, a in zip(solved, answers) if a["kind"] == kind]
    counts = [a["evaluations"] for _, a in mine]
    print(
        f"{kind:12}{sum(s for s, _ in mine):6}/{len(mine):<6}{median(counts, '{:.1f}'):>8}{sum(counts) / len(counts):8.1f}"
        f"{max(counts):8}{median([1e3 * a['seconds'] for _, a in mine], '{:.2f}'):>10}"
        f"{median([1e3 * a['seconds'] / a['evaluations'] for _, a in mine], '{:.3f}'):>10}"
        f"{median([a['cost'] for s, a in mine if s], '{:.4g}'):>10}"
    )


def printComparison(title, solved, answers, before_solved, before):
    """Compares problem by problem; the first of each pair is the newer one or Kinegraph's."""
    print(
        f"\n{title}\n{'':12}{'gained':>8}{'lost':>6}{'evaluations':>13}{'cost':>8}{'lower':>7}{'higher':>8}{'time':>8}"
    )
    pairs = list(zip(solved, answers, before_solved, before))
    for kind in dict.fromkeys(a["kind"] for a in answers):
        mine = [p for p in pairs if p[1]["kind"] == kind]
        both = [(a, b) for s, a, t, b in mine if s and t]
        gained, lost = sum(s and not t for s, _, t, _ in mine), sum(t and not s for s, _, t, _ in mine)
        costs = [(a["cost"] + 1e-6) / (b["cost"] + 1e-6) for a, b in both]
        print(
            f"{kind:12}{gained:8}{lost:6}"
            f"{sum(a['evaluations'] for _, a, _, _ in mine):7}/{sum(b['evaluations'] for *_, b in mine):<5}"
            f"{median(costs, '{:.4f}'):>8}{sum(c < 0.99 for c in costs):7}{sum(c > 1.01 for c in costs):8}"
            f"{median([a['seconds'] / b['seconds'] for _, a, _, b in mine], '{:.3f}'):>8}"
        )


HEADER = f"{'':12}{'solved':>9}{'evals':>12}{'mean':>8}{'most':>8}{'ms':>10}{'ms each':>10}{'cost':>10}"


def main():
    import numpy as np

    import robotic as ry

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10, help="problems of each kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS), help="separated by commas")
    parser.add_argument("--save", type=Path)
    parser.add_argument("--against", type=Path)
    options = parser.parse_args()
    kinds = options.kinds.split(",")
    if unknown := set(kinds) - set(KINDS):
        parser.error(f"there is no kind '{min(unknown)}'; there are {', '.join(KINDS)}")
    problems = drawFamily(ry, np, {"seed": options.seed, "count": options.count, "kinds": kinds})["problems"]
    answers = solveFamily(ry, np, {"problems": problems})["answers"]
    solved = checkFamily(ry, np, {"problems": problems, "answers": answers})["solved"]
    print("command: ", " ".join(["python", *sys.argv]))
    print(HEADER)
    for kind in dict.fromkeys(p["kind"] for p in problems):
        printRow(kind, solved, answers)
    if options.save:
        options.save.write_text(json.dumps({"solved": solved, "answers": answers}))
    if options.against:
        kept = json.loads(options.against.read_text())
        printComparison("now against before:", solved, answers, kept["solved"], kept["answers"])


if __name__ == "__main__":
    main()
