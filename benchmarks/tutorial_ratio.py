#!/usr/bin/env python3
"""Compares Kinegraph with the package `robotic` on the steps of the tutorial, at equal accuracy.

    python benchmarks/tutorial_ratio.py --reference PATH_TO_REFERENCE_PYTHON [--rounds 7] [--ours PATH_TO_PYTHON]

Each round starts one process per package, in turns, and both run the same script (`--worker` below) on one thread:

    ik      one pass of the tutorial's loop: move the target, build the KOMO, solve, read the path, set the joints
    eval    setJointState, then C.eval of the gripper's position with its Jacobian
    load    an empty Config and addFile of the package's own scenarios/pandaSingle.g
    load=   the same for one and the same file, Kinegraph's
    import  `import robotic`, after numpy

Ratios are taken within a round, so that a busy machine disturbs both sides alike. The exit status is 0 if Kinegraph's
answers are feasible and as accurate as the reference's.
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
from time import perf_counter

Q_HOME = [0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]
QUANTITIES = ["ik", "eval", "load", "load=", "import"]


# --- the part that both packages run --------------------------------------------------------------------------------


def worker(options):
    import numpy as np

    start = perf_counter()
    import robotic as ry

    times = {"import": [perf_counter() - start]}
    scene = ry.raiPath("scenarios/pandaSingle.g")
    report = {"times": times, "scene": os.path.abspath(scene), "versions": versions(ry), "numpy": np.__version__}
    if options.worker != "describe":
        times["load"] = timeLoads(ry, scene, 8)
        times["load="] = timeLoads(ry, options.scene, 8)
        times["eval"] = timeEvaluations(ry, np, scene)
        times["ik"], report["accuracy"] = timeInverseKinematics(ry, np, scene, options.targets)
    Path(options.out).write_text(json.dumps(report))
    sys.stdout.flush()
    os._exit(0)  # skips the destructors of the reference


def versions(ry):
    version = getattr(ry, "__version__", None) or ry.version()
    return {"version": version, "module": os.path.dirname(ry.__file__), "python": platform.python_version()}


def timeLoads(ry, scene, count):
    times = []
    for _ in range(count):
        start = perf_counter()
        C = ry.Config()
        C.addFile(scene)
        times.append(perf_counter() - start)
    return times


def timeEvaluations(ry, np, scene, batches=30, batch=50):
    C = ry.Config()
    C.addFile(scene)
    limits = np.asarray(C.getJointLimits())
    q = limits[0] + np.random.default_rng(1).random((batch, limits.shape[1])) * (limits[1] - limits[0])
    times = []
    for _ in range(batches):
        start = perf_counter()
        for row in q:
            C.setJointState(row)
            C.eval(ry.FS.position, ["l_gripper"])
        times.append((perf_counter() - start) / batch)
    return times


def timeInverseKinematics(ry, np, scene, count):
    C = ry.Config()
    C.addFile(scene)
    target = C.addFrame("target", "table")
    target.setShape(ry.ST.marker, [0.1])
    target.setRelativePosition([0.0, 0.3, 0.3])
    center = np.array(target.getPosition())
    rng = np.random.default_rng(0)
    position = center.copy()
    times, errors, costs, feasible = [], [], [], 0
    for _ in range(count):
        position = center + 0.98 * (position - center) + 0.02 * rng.standard_normal(3)
        start = perf_counter()
        target.setPosition(position)
        q0 = C.getJointState()
        komo = ry.KOMO(C, 1, 1, 0, False)
        komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], q0)
        komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], Q_HOME)
        komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
        answer = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
        q = komo.getPath()[0]
        C.setJointState(q)
        times.append(perf_counter() - start)
        errors.append(float(np.linalg.norm(np.asarray(C.getFrame("l_gripper").getPosition()) - position)))
        costs.append(float(0.01 * (np.sum((q - q0) ** 2) + np.sum((q - np.array(Q_HOME)) ** 2))))
        feasible += bool(answer.feasible)
    accuracy = {"median": statistics.median(errors), "max": max(errors), "cost": statistics.fmean(costs)}
    return times, accuracy | {"feasible": feasible, "of": count}


# --- the processes, in turns ----------------------------------------------------------------------------------------


def runWorker(python, role, folder, scene="", targets=0, is_reference=False):
    out = Path(folder) / "report.json"
    out.unlink(missing_ok=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", KINEGRAPH_HEADLESS="1")
    if is_reference:
        environment.pop("PYTHONPATH", None)  # it may point to Kinegraph's `robotic`
    command = [python, os.path.abspath(__file__), "--worker", role, "--out", str(out)]
    command += ["--scene", scene, "--targets", str(targets)]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=600)
    if not out.exists():
        sys.exit(f"{python} failed with status {done.returncode}:\n{done.stderr[-2000:]}")
    return json.loads(out.read_text())


def machine():
    cpu = platform.processor() or platform.machine()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        cpu = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{cpu}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"


def printTable(reports):
    print(f"{'µs':8}{'reference':>20}{'kinegraph':>22}{'reference / kinegraph':>26}{'over the rounds':>20}")
    print(f"{'':8}{'min':>10}{'median':>10}{'min':>12}{'median':>10}{'of mins':>14}{'of medians':>12}{'':>20}")
    for quantity in QUANTITIES:
        samples = {who: [r["times"][quantity] for r in runs] for who, runs in reports.items()}
        low = {who: 1e6 * min(min(s) for s in runs) for who, runs in samples.items()}
        middle = {who: 1e6 * statistics.median(statistics.median(s) for s in runs) for who, runs in samples.items()}
        pairs = zip(samples["reference"], samples["kinegraph"])
        ratios = [statistics.median(r) / statistics.median(k) for r, k in pairs]
        columns = f"{low['reference']:10.1f}{middle['reference']:10.1f}"
        columns += f"{low['kinegraph']:12.1f}{middle['kinegraph']:10.1f}"
        of_mins = low["reference"] / low["kinegraph"]
        spread = f"{min(ratios):.2f} ... {max(ratios):.2f}"
        print(f"{quantity:8}{columns}{of_mins:14.2f}{statistics.median(ratios):12.2f}{spread:>20}")


def printAccuracy(reports):
    """Prints the accuracy of the answers of `ik`, and returns whether Kinegraph's are as good as the reference's."""
    worst = {}
    for who, runs in reports.items():
        of = [r["accuracy"] for r in runs]
        worst[who] = {key: max(a[key] for a in of) for key in ("median", "max", "cost")}
        worst[who]["feasible"] = min(a["feasible"] / a["of"] for a in of)
        w = worst[who]
        print(f"{who:10} gripper off by {1e3 * w['median']:.5f} mm (median), {1e3 * w['max']:.5f} mm (worst); ", end="")
        print(f"mean cost {w['cost']:.6f}; feasible {100 * w['feasible']:.1f} %")
    ours, reference = worst["kinegraph"], worst["reference"]
    good = ours["median"] <= reference["median"] and ours["max"] <= reference["max"]
    good = good and ours["feasible"] >= reference["feasible"] and ours["cost"] <= 1.01 * reference["cost"]
    print("accuracy:", "equal or better" if good else "WORSE than the reference: the times do not compare")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--ours", default=sys.executable, help="a Python with Kinegraph (default: this one)")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--targets", type=int, default=300, help="targets of the inverse kinematics per round")
    for internal in ("--worker", "--out", "--scene"):
        parser.add_argument(internal, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options)
    if not options.reference:
        parser.error("--reference is needed: the python of an environment with the package `robotic`")
    if options.rounds < 1 or options.targets < 1:
        parser.error("--rounds and --targets must be at least 1")

    pythons = {"reference": os.path.abspath(options.reference), "kinegraph": os.path.abspath(options.ours)}
    reports = {who: [] for who in pythons}
    with tempfile.TemporaryDirectory() as folder:  # the reference writes a log file to its working directory
        about = {w: runWorker(p, "describe", folder, is_reference=w == "reference") for w, p in pythons.items()}
        for round_index in range(options.rounds):
            order = list(pythons) if round_index % 2 == 0 else list(pythons)[::-1]
            for who in order:
                scene = about["kinegraph"]["scene"]
                run = runWorker(pythons[who], "measure", folder, scene, options.targets, who == "reference")
                reports[who].append(run)

    print("command: ", " ".join(["python", *sys.argv]))
    print("machine: ", machine())
    for who in pythons:
        described = about[who]["versions"]
        print(f"{who}: {described['version']} (python {described['python']}, numpy {about[who]['numpy']})")
    if about["kinegraph"]["versions"]["module"] == about["reference"]["versions"]["module"]:
        print("NOTE: both pythons import the same package; every ratio should be 1")
    print(f"rounds:   {options.rounds}, {options.targets} targets each\n")
    printTable(reports)
    print()
    sys.exit(0 if printAccuracy(reports) else 1)


if __name__ == "__main__":
    main()
