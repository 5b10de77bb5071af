#!/usr/bin/env python3
"""Counts the starts, of 20, that lead to a solution of motion problems, for Kinegraph and for the package `robotic`.

    python benchmarks/komo_problems.py [--reference PATH_TO_REFERENCE_PYTHON] [--starts 20] [--only NAME,NAME]

Ten motion problems of manipulation, from inverse kinematics to pick-and-place along a path. The first start is the
default one. The others are random: uniform in the middle 80 % of the bounds for one slice, the default plus noise of
0.1 for paths.

A start is solved within 1e-3 (1e-6) if no equality and no inequality is violated by more, regardless of the solver's
status. Residuals are evaluated outside of the solver. Kinegraph's solver has its defaults for 1e-3 and
`stopTolerance=1e-6` for 1e-6. The reference has its defaults for 1e-3, and for 1e-6 its best settings, damping 0.01 and
stopTolerance 1e-3. `restarts` is the share that Kinegraph solves within 1e-3 if failed starts are followed by others,
at most ten.

In `grasp 6cm` and `pick 6cm` the housing of the wrist camera penetrates the box by at least 3.0 mm. These problems have
no solution, and the table counts how often the solver reports that.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from time import process_time

RESTARTS = 10


# --- the problems; `ry` is either package ---------------------------------------------------------------------------


def panda(ry):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def box(ry, C, name, position, size):
    return C.addFrame(name).setPosition(position).setShape(ry.ST.ssBox, [*size, 0.005]).setContact(1)


def marker(ry, C, name, position):
    return C.addFrame(name).setPosition(position).setShape(ry.ST.marker, [0.1])


def ikPosition(ry):
    C = panda(ry)
    marker(ry, C, "target", [0.3, 0.3, 1.0])
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    return C, komo


def ikPose(ry):
    C = panda(ry)
    marker(ry, C, "target", [0.3, 0.3, 1.0]).setQuaternion([0.0, 1.0, 0.3, 0.1])
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    komo.addObjective([], ry.FS.quaternionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    return C, komo


def jointLimits(ry):
    """A cost that pulls the joints beyond several limits."""
    C = panda(ry)
    marker(ry, C, "target", [-0.6, 0.2, 1.0])
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointLimits()[0] - 0.3)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1e1])
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    komo.addObjective([], ry.FS.vectorZ, ["l_gripper"], ry.OT.sos, [1e0], [0, 0, 1])
    return C, komo


def grasp(ry, size):
    """A box in free space, and an obstacle on the straight path to it."""
    C = panda(ry)
    box(ry, C, "box", [-0.25, 0.1, 1.0], [size] * 3)
    box(ry, C, "obst", [-0.15, 0.05, 1.2], [0.1, 0.4, 0.1])
    komo = ry.KOMO(C, 1, 1, 0, True)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [1e1])
    komo.addObjective([], ry.FS.scalarProductXX, ["l_gripper", "box"], ry.OT.eq, [1e1], [0])
    komo.addObjective([], ry.FS.scalarProductXZ, ["l_gripper", "box"], ry.OT.eq, [1e1], [0])
    komo.addObjective([], ry.FS.distance, ["l_palm", "box"], ry.OT.ineq, [1e1])
    return C, komo


def dualArm(ry):
    """Two arms that hold one stick."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    box(ry, C, "stick", [0.0, 0.3, 1.1], [0.5, 0.04, 0.04])
    for name, x in (("endL", 0.22), ("endR", -0.22)):
        C.addFrame(name, "stick").setRelativePosition([x, 0, 0]).setShape(ry.ST.marker, [0.1])
    komo = ry.KOMO(C, 1, 1, 0, True)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq)
    for gripper, end in (("l_gripper", "endL"), ("r_gripper", "endR")):
        komo.addObjective([], ry.FS.positionDiff, [gripper, end], ry.OT.eq, [1e1])
        komo.addObjective([], ry.FS.scalarProductXX, [gripper, "stick"], ry.OT.eq, [1e1])
    return C, komo


def pathObjectives(ry, komo):
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])


def pathObstacle(ry):
    C = panda(ry)
    marker(ry, C, "way", [0.4, 0.4, 0.9])
    box(ry, C, "obst", [0.2, 0.38, 0.95], [0.06, 0.06, 0.6])
    komo = ry.KOMO(C, 1, 32, 2, True)
    pathObjectives(ry, komo)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1e0])
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "way"], ry.OT.eq, [1e1])
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [1e0], [], 1)
    return C, komo


MOBILE = """
base_origin: { X: [0, 0, .2] }
base (base_origin): { joint: transXYPhi, limits: [-10,-10,-4,10,10,4], shape: ssCylinder, size: [.1, .3, .02], contact: 1 }
Include: <PANDA>
Edit panda_base (base): { joint: rigid, Q: "t(0 0 .05) d(90 0 0 1)" }
"""


def mobileBase(ry):
    """An arm on a base with wheels that drives around a pillar."""
    C = ry.Config()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "mobile.g"
        file.write_text(MOBILE.replace("PANDA", os.path.abspath(ry.raiPath("panda/panda.g"))))
        C.addFile(str(file))
    marker(ry, C, "goal", [2.5, 0.5, 0.8])
    C.addFrame("pillar").setPosition([1.2, -0.05, 0.8]).setShape(ry.ST.ssBox, [0.3, 0.3, 1.6, 0.02]).setContact(1)
    komo = ry.KOMO(C, 1, 32, 2, True)
    pathObjectives(ry, komo)
    komo.addObjective([1.0], ry.FS.positionDiff, ["gripper", "goal"], ry.OT.eq, [1e1])
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [1e0], [], 1)
    return C, komo


def boxScene(ry, size):
    C = panda(ry)
    box(ry, C, "box", [-0.3, 0.2, 0.65 + size / 2], [size] * 3)
    marker(ry, C, "goal", [0.3, 0.3, 0.65 + size / 2])
    return C


def pickAndPlace(ry, komo):
    komo.addModeSwitch([1.0, 2.0], ry.SY.stable, ["l_gripper", "box"], True)
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [1e1])
    komo.addObjective([1.0], ry.FS.scalarProductXZ, ["l_gripper", "box"], ry.OT.eq, [1e1])
    komo.addObjective([1.0], ry.FS.scalarProductXX, ["l_gripper", "box"], ry.OT.eq, [1e1])
    komo.addModeSwitch([2.0, -1.0], ry.SY.stableOn, ["table", "box"], False)
    komo.addObjective([2.0], ry.FS.positionDiff, ["box", "goal"], ry.OT.eq, [[1e1, 0, 0], [0, 1e1, 0]])


def pickWaypoints(ry, size):
    C = boxScene(ry, size)
    komo = ry.KOMO(C, 3, 1, 1, True)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 1, 1e-1)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1e0])
    komo.addQuaternionNorms()
    komo.addObjective([3.0], ry.FS.jointState, [], ry.OT.eq, [1e0], C.getJointState())
    pickAndPlace(ry, komo)
    return C, komo


def pickPath(ry, size):
    C = boxScene(ry, size)
    komo = ry.KOMO(C, 2, 16, 2, True)
    pathObjectives(ry, komo)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1e0])
    komo.addQuaternionNorms()
    komo.addObjective([2.0], ry.FS.jointState, [], ry.OT.eq, [1e0], [], 1)
    pickAndPlace(ry, komo)
    komo.addObjective([1.5], ry.FS.position, ["box"], ry.OT.ineq, [[0, 0, -1e1]], [0, 0, 0.9])
    return C, komo


PROBLEMS = {
    "ik position": ikPosition,
    "ik pose": ikPose,
    "joint limits": jointLimits,
    "grasp 4cm": lambda ry: grasp(ry, 0.04),
    "dual arm": dualArm,
    "path obstacle": pathObstacle,
    "mobile base": mobileBase,
    "pick waypoints 4cm": lambda ry: pickWaypoints(ry, 0.04),
    "pick path 4cm": lambda ry: pickPath(ry, 0.04),
    "grasp 6cm": lambda ry: grasp(ry, 0.06),
    "pick waypoints 6cm": lambda ry: pickWaypoints(ry, 0.06),
    "pick path 6cm": lambda ry: pickPath(ry, 0.06),
}
INFEASIBLE = [name for name in PROBLEMS if name.endswith("6cm")]


def start(np, komo, lower, upper, seed):
    """Returns the same start for both packages; it depends on `seed` only."""
    x = np.concatenate([np.array(own, float).ravel() for own in komo.getPath_qAll()])
    bounded = upper > lower
    if seed > 0:
        rng = np.random.default_rng(seed)
        noise, uniform = rng.normal(0.0, 0.1, x.shape), rng.uniform(0.1, 0.9, x.shape)
        limited = bounded & (upper - lower < 50.0)
        x = np.where(limited, lower + uniform * (upper - lower), x + noise) if komo.getT() == 1 else x + noise
    return np.where(bounded, np.clip(x, lower, upper), x)


def solveFrom(ry, np, build, seed, options):
    """Returns the outcome of one start: evaluations, s, cost, largest violation, and the solver's message."""
    _, komo = build(ry)
    nlp = komo.nlp()
    lower, upper = np.array(nlp.getBounds()).reshape(2, -1)
    x = start(np, komo, lower, upper, seed)
    solver = ry.NLP_Solver(nlp, verbose=0)
    solver.setOptions(verbose=0, **options)
    solver.setInitialization(x)
    begin = process_time()
    answer = solver.solve()
    seconds = process_time() - begin
    phi, _ = nlp.evaluate(answer.x)
    kinds = [str(kind).split(".")[-1] for kind in nlp.getTypes()]
    violations = [abs(v) if kind == "eq" else max(v, 0.0) for v, kind in zip(phi, kinds) if kind in ("eq", "ineq")]
    cost = sum(v * v if kind == "sos" else v for v, kind in zip(phi, kinds) if kind in ("sos", "f"))
    says = str(getattr(answer, "status", "")).split(".")[-1]
    return {"evaluations": answer.evals, "seconds": seconds, "cost": cost, "violation": max(violations), "says": says}


# --- one process ------------------------------------------------------------------------------------------------------


def worker(options):
    import numpy as np

    import robotic as ry

    ours = hasattr(ry, "solveIk")
    settings = {"1e-3": {}, "1e-6": {"stopTolerance": 1e-6} if ours else {"damping": 1e-2, "stopTolerance": 1e-3}}
    build = PROBLEMS[options.only]
    report = {"version": getattr(ry, "__version__", None) or ry.version()}
    for name, chosen in settings.items():
        if name == "1e-6" and options.only in INFEASIBLE:
            continue
        report[name] = [solveFrom(ry, np, build, seed, chosen) for seed in range(options.starts)]
    if ours and options.only not in INFEASIBLE:
        report["attempts"] = [attempts(ry, np, build, seed, first) for seed, first in enumerate(report["1e-3"])]
    Path(options.out).write_text(json.dumps(report))
    sys.stdout.flush()
    os._exit(0)  # skips the destructors of the reference


def attempts(ry, np, build, seed, first):
    """Returns the number of starts until the problem is solved; 0 if more than allowed."""
    if first["violation"] <= 1e-3:
        return 1
    for attempt in range(1, RESTARTS):
        if solveFrom(ry, np, build, 1000 * (seed + 1) + attempt, {})["violation"] <= 1e-3:
            return attempt + 1
    return 0


def runWorker(python, name, folder, starts, is_reference):
    out = Path(folder) / "report.json"
    out.unlink(missing_ok=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", KINEGRAPH_HEADLESS="1")
    if is_reference:
        environment.pop("PYTHONPATH", None)  # it may point to Kinegraph's `robotic`
    command = [python, os.path.abspath(__file__), "--worker", "--out", str(out)]
    command += ["--only", name, "--starts", str(starts)]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=1800)
    if not out.exists():
        sys.exit(f"{python} failed with status {done.returncode}:\n{done.stderr[-2000:]}")
    return json.loads(out.read_text())


def solved(runs, tolerance):
    return [run for run in runs if run["violation"] <= tolerance]


def median(values, factor=1.0, form="{:.0f}"):
    return form.format(factor * statistics.median(values)) if values else "-"


def printRow(name, reports, starts):
    cells = [f"{name:20}"]
    for runs in reports.values():
        loose = runs["1e-3"]
        tight = f"{len(solved(runs['1e-6'], 1e-6))}" if "1e-6" in runs else "-"
        cells.append(f"{len(solved(loose, 1e-3)):4} {tight:>4} {median([r['evaluations'] for r in loose]):>6}")
        cells.append(f"{median([r['seconds'] for r in loose], 1e3, '{:.2f}'):>9}")
        cells.append(f"{median([r['cost'] for r in solved(loose, 1e-3)], 1.0, '{:.4g}'):>9}")
    ours = reports["kinegraph"]
    if "attempts" in ours:
        share = sum(a > 0 for a in ours["attempts"]) / starts
        cells.append(f"{100 * share:5.0f} % (at most {max(ours['attempts'])} starts)")
    else:
        least = 1e3 * min(run["violation"] for run in ours["1e-3"])
        count = sum(run["says"] == "infeasible" for run in ours["1e-3"])
        cells.append(f"infeasible {count}, least violation {least:.2f} mm")
    print(" ".join(cells), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--ours", default=sys.executable, help="a Python with Kinegraph (default: this one)")
    parser.add_argument("--starts", type=int, default=20)
    parser.add_argument("--only", help="names of problems, separated by commas")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options)
    names = options.only.split(",") if options.only else list(PROBLEMS)
    for name in names:
        if name not in PROBLEMS:
            parser.error(f"there is no problem '{name}'; there are {', '.join(PROBLEMS)}")

    pythons = {"reference": os.path.abspath(options.reference)} if options.reference else {}
    pythons["kinegraph"] = os.path.abspath(options.ours)
    print("command: ", " ".join(["python", *sys.argv]))
    columns = " ".join(f"{'1e-3 1e-6':>9} {'evals':>6} {'ms':>9} {'cost':>9}" for _ in pythons)
    print(f"{'':20} " + " ".join(f"{who:^36}" for who in pythons))
    print(f"{'of ' + str(options.starts) + ' starts':20} {columns} with restarts")
    worse = []
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            reports = {w: runWorker(p, name, folder, options.starts, w == "reference") for w, p in pythons.items()}
            printRow(name, reports, options.starts)
            counts = {who: len(solved(runs["1e-3"], 1e-3)) for who, runs in reports.items()}
            if counts["kinegraph"] < counts.get("reference", 0):
                worse.append(name)
    print("fewer starts solved than by the reference:", ", ".join(worse) or "nowhere")


if __name__ == "__main__":
    main()
