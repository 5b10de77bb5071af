#!/usr/bin/env python3
"""Compares `solveIk` with inverse kinematics with restarts by the package `robotic`, at equal accuracy.

    python benchmarks/solve_ik.py --reference PATH_TO_REFERENCE_PYTHON [--rounds 3] [--ours PATH_TO_PYTHON]

Each round starts one process per package, in turns, on one thread. Targets are poses of the Panda's gripper at random
joint states within the limits (collision-free for `free`). The first attempt starts at home, the others at random:

    1mm     pose within 1 mm and 1 mrad; the reference solves a KOMO without regularization, at most 20 attempts
    1e-6    within 1e-6 m and rad; the reference with stop tolerances of 1e-7
    free    1 mm and no collision; the reference with accumulatedCollisions as an equality
    batch   1mm for 4096 targets in one call; the reference in a loop, over fewer of them, one attempt each

Times are processor times, which a busy machine disturbs less. Both respect the joint limits. The scene itself judges
each answer, outside of the time. The exit status is 0 if Kinegraph solves at least as many as the reference everywhere.
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from time import process_time

Q_HOME = [0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]
QUANTITIES = {"1mm": 1e-3, "1e-6": 1e-6, "free": 1e-3, "batch": 1e-3}
ATTEMPTS = 20


# --- the part that both packages run --------------------------------------------------------------------------------


def worker(options):
    import numpy as np

    import robotic as ry

    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    target = C.addFrame("target")
    limits = np.asarray(C.getJointLimits())
    rng = np.random.default_rng(options.seed)
    solvers = kinegraphSolvers(ry) if hasattr(ry, "solveIk") else referenceSolvers(ry, np, target, limits)
    report = {"module": os.path.dirname(ry.__file__), "version": getattr(ry, "__version__", None) or ry.version()}
    for quantity, tolerance in QUANTITIES.items():
        count = {"1e-6": options.targets // 4, "batch": 4096}.get(quantity, options.targets)
        if quantity == "batch" and not hasattr(ry, "solveIk"):
            count = options.targets
        poses = np.array([randomPose(C, np, rng, limits, quantity == "free") for _ in range(count)])
        C.setJointState(Q_HOME)
        answers, times = solvers[quantity](C, poses)
        good = sum(isGood(C, np, q, pose, tolerance, quantity == "free") for q, pose in zip(answers, poses))
        report[quantity] = {"times": times, "mean": sum(times) / len(answers), "solved": good / count}
    Path(options.out).write_text(json.dumps(report))
    sys.stdout.flush()
    os._exit(0)  # skips the destructors of the reference


def randomPose(C, np, rng, limits, free):
    while True:
        C.setJointState(limits[0] + rng.random(limits.shape[1]) * (limits[1] - limits[0]))
        if free:
            C.computeCollisions()
        if not free or C.coll_totalViolation() <= 0.0:
            return np.asarray(C.getFrame("l_gripper").getPose())


def isGood(C, np, q, pose, tolerance, free):
    if q is None:
        return False
    before = C.getJointState()
    C.setJointState(q)
    reached = np.asarray(C.getFrame("l_gripper").getPose())
    chord = min(np.linalg.norm(reached[3:] - pose[3:]), np.linalg.norm(reached[3:] + pose[3:]))
    good = np.linalg.norm(reached[:3] - pose[:3]) <= 1.01 * tolerance and 2 * chord <= 1.01 * tolerance
    if good and free:
        C.computeCollisions()
        good = C.coll_totalViolation() <= 1e-3
    C.setJointState(before)
    return bool(good)


def kinegraphSolvers(ry):
    def oneByOne(**given):
        def solve(C, poses):
            answers, times = [], []
            for pose in poses:
                start = process_time()
                result = ry.solveIk(C, {"l_gripper": pose}, **given)
                times.append(process_time() - start)
                answers.append(result.q if result.feasible else None)
            return answers, times

        return solve

    def allAtOnce(C, poses):
        start = process_time()
        results = ry.solveIk(C, {"l_gripper": poses}, tolerance=1e-3, collisions=False)
        return list(results.q), [process_time() - start]

    return {
        "1mm": oneByOne(tolerance=1e-3, collisions=False),
        "1e-6": oneByOne(tolerance=1e-6, collisions=False),
        "free": oneByOne(tolerance=1e-3),
        "batch": allAtOnce,
    }


def referenceSolvers(ry, np, target, limits):
    rng = np.random.default_rng(7)

    def solver(quantity, attempts):
        tolerance, free = QUANTITIES[quantity], quantity == "free"

        def attempt(C, q):
            C.setJointState(q)
            komo = ry.KOMO(C, 1, 1, 0, free)
            if quantity == "1e-6":
                komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-2], q)
            if free:
                komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])
            komo.addObjective([], ry.FS.poseDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
            method = ry.NLP_Solver(komo.nlp(), verbose=0)
            if quantity == "1e-6":
                method.setOptions(verbose=0, stopTolerance=1e-7, stopFTolerance=1e-7, stopGTolerance=1e-7, muMax=1e8)
            method.solve()
            return komo.getPath()[0]

        def solve(C, poses):
            answers, times = [], []
            for pose in poses:
                target.setPose(pose)
                seconds, answer = 0.0, None
                for i in range(attempts):
                    q = np.array(Q_HOME) if i == 0 else limits[0] + rng.random(7) * (limits[1] - limits[0])
                    start = process_time()
                    answer = attempt(C, q)
                    seconds += process_time() - start
                    if isGood(C, np, answer, pose, tolerance, free):
                        break
                answers.append(answer)
                times.append(seconds)
            return answers, times

        return solve

    return {quantity: solver(quantity, 1 if quantity == "batch" else ATTEMPTS) for quantity in QUANTITIES}


# --- the processes, in turns ----------------------------------------------------------------------------------------


def runWorker(python, folder, targets, seed, is_reference):
    out = Path(folder) / "report.json"
    out.unlink(missing_ok=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", KINEGRAPH_HEADLESS="1")
    if is_reference:
        environment.pop("PYTHONPATH", None)  # it may point to Kinegraph's `robotic`
    command = [python, os.path.abspath(__file__), "--worker", "--out", str(out), "--targets", str(targets)]
    done = subprocess.run(
        [*command, "--seed", str(seed)], cwd=folder, env=environment, capture_output=True, text=True, timeout=1800
    )
    if not out.exists():
        sys.exit(f"{python} failed with status {done.returncode}:\n{done.stderr[-2000:]}")
    return json.loads(out.read_text())


def printTable(reports):
    heads = f"{'reference':>24}{'kinegraph':>24}{'reference / kinegraph':>26}{'over the rounds':>22}"
    print(f"{'':8}{heads}")
    print(f"{'':8}{'mean µs':>12}{'solved':>12}{'mean µs':>12}{'solved':>12}{'of means':>26}")
    equal = True
    for quantity in QUANTITIES:
        means = {who: [run[quantity]["mean"] for run in runs] for who, runs in reports.items()}
        solved = {who: statistics.fmean(run[quantity]["solved"] for run in runs) for who, runs in reports.items()}
        ratios = [r / k for r, k in zip(means["reference"], means["kinegraph"])]
        row = ""
        for who in reports:
            row += f"{1e6 * statistics.median(means[who]):12.1f}{100 * solved[who]:10.2f} %"
        print(f"{quantity:8}{row}{statistics.median(ratios):26.1f}{f'{min(ratios):.1f} ... {max(ratios):.1f}':>22}")
        equal = equal and solved["kinegraph"] >= solved["reference"]
    return equal


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--ours", default=sys.executable, help="a Python with Kinegraph (default: this one)")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--targets", type=int, default=200, help="targets per round")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    parser.add_argument("--seed", type=int, default=0, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options)
    if not options.reference:
        parser.error("--reference is needed: the python of an environment with the package `robotic`")

    pythons = {"reference": os.path.abspath(options.reference), "kinegraph": os.path.abspath(options.ours)}
    reports = {who: [] for who in pythons}
    with tempfile.TemporaryDirectory() as folder:  # the reference writes a log file to its working directory
        for index in range(options.rounds):
            for who in list(pythons) if index % 2 == 0 else list(pythons)[::-1]:
                reports[who].append(runWorker(pythons[who], folder, options.targets, index, who == "reference"))

    print("command:  python", *sys.argv)
    print(f"machine:  {platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
    for who, runs in reports.items():
        print(f"{who}: {runs[0]['version']} in {runs[0]['module']}")
    print(f"rounds:   {options.rounds}, {options.targets} targets each\n")
    equal = printTable(reports)
    print("\nsolved:", "as many as the reference, or more" if equal else "FEWER than the reference")
    sys.exit(0 if equal else 1)


if __name__ == "__main__":
    main()
