#!/usr/bin/env python3
"""Compares Kinegraph's motion problems (KOMO) with those of the package `robotic`, at equal accuracy.

    python benchmarks/komo.py --reference PATH_TO_REFERENCE_PYTHON [--rounds 5] [--ours PATH_TO_PYTHON] [--quick]
                              [--family 5] [--seed 1]

Each round starts one process per package, in turns, and both run the same script (`--worker` below) on one thread:

    ik            one pass of the tutorial's loop: move the target, build the KOMO, solve, read the path, set the joints
    ik free       the same with `accumulatedCollisions` as a constraint
    kept          the problem of `ik` kept: move the target, `updateRootObjects`, solve from the last solution, read the
                  path. It is compared with `ik`, because scripts for the reference follow a target by that loop
    ... ~         the same row, Kinegraph with the tolerances EQUAL below, so that its accuracy equals the reference's
                  (last column) instead of being a hundred times higher
    reach T       from home to a position behind a sphere on the straight path: one phase of T slices, order 2, no
                  collisions in any slice; 20 problems for T = 32
    slice T       the time of `reach T` per evaluation and slice, that is, of one Newton step for one slice
    10 phases     ten positions, one after the other, 32 slices each
    ... to 1 mm   `reach 32`, the reference with `stopTolerance` 1e-3; with its default, many of its paths miss 1 mm
    build         a KOMO of 1000 slices with three objectives, and its NLP

The last columns count answers within 1 mm of the target and without collisions deeper than 1 mm in any slice, and show
the largest miss in mm. Times of `ik` and `kept` are wall times, the others processor times. Ratios are taken within a
round, so that a busy machine disturbs both sides alike. The reference, if there is one, checks the paths of `reach` and
`10 phases` outside of the time. At the end both packages solve the random problems of `komo_family.py` with their
defaults: `--family` of each kind, drawn by `--seed`. The exit status is 0 if Kinegraph's answers are good wherever the
reference's are.
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
from time import perf_counter, process_time

import komo_family

Q_HOME = [0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]
LENGTHS = [8, 16, 32, 64, 128, 256, 512]
PHASES = 10
EQUAL = {"stopTolerance": 1e-2, "stopGTolerance": 3e-3}


# --- the part that both packages run --------------------------------------------------------------------------------


def worker(options):
    import numpy as np

    import robotic as ry

    task = json.loads(Path(options.task).read_text()) if options.task else {}
    report = {"version": getattr(ry, "__version__", None) or ry.version(), "module": os.path.dirname(ry.__file__)}
    report |= {"python": platform.python_version(), "numpy": np.__version__}
    roles = {"describe": lambda *_: {}, "problems": makeProblems, "measure": measure, "check": checkPaths}
    roles |= {"draw": komo_family.drawFamily, "family": komo_family.solveFamily, "judge": komo_family.checkFamily}
    report |= roles[options.worker](ry, np, task)
    Path(options.out).write_text(json.dumps(report))
    sys.stdout.flush()
    os._exit(0)  # skips the destructors of the reference


def reachScene(ry):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("goal").setShape(ry.ST.marker, [0.1])
    C.addFrame("ball").setShape(ry.ST.sphere, [0.08]).setContact(1)
    C.setJointState(Q_HOME)
    return C


def place(C, problem):
    C.getFrame("goal").setPosition(problem["goal"])
    C.getFrame("ball").setPosition(problem["ball"])


def depth(C, q):
    """Returns the sum of all penetrations, m."""
    C.setJointState(q)
    C.computeCollisions()
    return C.coll_totalViolation()


def makeProblems(ry, np, task):
    """Returns reachable positions, each with a ball on the straight path in joint space."""
    C = reachScene(ry)
    base = np.array(C.getFrame("l_panda_link0").getPosition())
    start = np.array(C.getFrame("l_gripper").getPosition())
    rng = np.random.default_rng(task["seed"])
    problems = []
    while len(problems) < task["count"]:
        way = rng.standard_normal(3)
        way *= rng.uniform(0.35, 0.55) / np.linalg.norm(way)
        goal = start + way
        seen = goal - base
        if seen[2] < 0.1 or np.linalg.norm(seen - [0, 0, 0.33]) > 0.75 or np.linalg.norm(seen[:2]) < 0.3:
            continue
        problem = {"goal": goal.tolist(), "ball": (start + 0.55 * way).tolist()}
        place(C, problem)
        if depth(C, Q_HOME) > 0.0:
            continue
        C.setJointState(Q_HOME)
        komo = ry.KOMO(C, 1, 1, 0, True)
        komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], Q_HOME)
        komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq)
        komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "goal"], ry.OT.eq, [1e1])
        q = np.array(ry.NLP_Solver(komo.nlp(), verbose=0).solve().x)
        missed = np.linalg.norm(np.array(C.getFrame("l_gripper").getPosition()) - goal) if depth(C, q) < 1e-3 else 1.0
        hits = [depth(C, np.array(Q_HOME) + s * (q - Q_HOME)) > 1e-3 for s in np.linspace(0, 1, 33)]
        if missed < 1e-3 and any(hits):
            problems.append(problem)
    return {"problems": problems}


def measure(ry, np, task):
    times, counts = {}, {}
    is_kinegraph = hasattr(ry, "solveIk")
    exact = {} if is_kinegraph else {"stopTolerance": 1e-3}
    equal = EQUAL if is_kinegraph else {}
    times["ik"], counts["ik"] = timeTutorial(ry, np, task["targets"], False, {})
    times["ik ~"], counts["ik ~"] = timeTutorial(ry, np, task["targets"], False, equal)
    times["ik free"], counts["ik free"] = timeTutorial(ry, np, task["targets"], True, {})
    times["ik free ~"], counts["ik free ~"] = timeTutorial(ry, np, task["targets"], True, equal)
    if is_kinegraph:
        times["kept"], counts["kept"] = timeKept(ry, np, task["targets"], {})
        times["kept ~"], counts["kept ~"] = timeKept(ry, np, task["targets"], EQUAL)
    paths, evaluations = [], {}
    C = reachScene(ry)

    def keepReach(row, problems, slices, options):
        runs = [timeReach(ry, C, problem, slices, options) for problem in problems]
        times[row] = [r["time"] for r in runs]
        evaluations[row] = [r["evaluations"] for r in runs]
        paths.extend({"row": row, "path": r["path"], **p} for r, p in zip(runs, problems))
        return runs

    def keepPhases(row):
        run = timePhases(ry, np, C, task["problems"][0])
        times[row], evaluations[row] = [run["time"]], [run["evaluations"]]
        paths.append({"row": row, "path": run["path"], "goals": run["goals"], **task["problems"][0]})

    for slices in task["lengths"]:
        problems = task["problems"] if slices == 32 else task["problems"][: 4 if slices <= 128 else 2]
        runs = keepReach(f"reach {slices}", problems, slices, {})
        times[f"slice {slices}"] = [r["time"] / r["evaluations"] / slices for r in runs]
    keepReach("reach 32 to 1 mm", task["problems"], 32, exact)
    keepPhases("10 phases")
    times["build"], megabytes = timeBuild(ry, C)
    return {"times": times, "evaluations": evaluations, "paths": paths, "megabytes": megabytes, "quality": counts}


def tutorialKomo(ry, C, q0, free):
    komo = ry.KOMO(C, 1, 1, 0, free)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], q0)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], Q_HOME)
    if free:
        komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    return komo


def tutorialTargets(ry, np, count):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    target = C.addFrame("target", "table")
    target.setShape(ry.ST.marker, [0.1])
    target.setRelativePosition([0.0, 0.3, 0.3])
    center = np.array(target.getPosition())
    rng = np.random.default_rng(0)
    positions = [center]
    for _ in range(count):
        positions.append(center + 0.98 * (positions[-1] - center) + 0.02 * rng.standard_normal(3))
    return C, target, positions[1:]


def timeTutorial(ry, np, count, free, options):
    C, target, positions = tutorialTargets(ry, np, count)
    times, misses = [], []
    for position in positions:
        start = perf_counter()
        target.setPosition(position)
        q0 = C.getJointState()
        komo = tutorialKomo(ry, C, q0, free)
        solver = ry.NLP_Solver(komo.nlp(), verbose=0)
        if options:
            solver.setOptions(verbose=0, **options)
        solver.solve()
        q = komo.getPath()[0]
        C.setJointState(q)
        times.append(perf_counter() - start)
        misses.append(float(np.linalg.norm(np.array(C.getFrame("l_gripper").getPosition()) - position)))
    return times, quality(misses)


def quality(misses):
    """Returns the number of answers within 1 mm, their total, and the largest miss in mm."""
    return [sum(miss < 1e-3 for miss in misses), len(misses), 1e3 * max(misses)]


def timeKept(ry, np, count, options):
    C, target, positions = tutorialTargets(ry, np, count)
    komo = tutorialKomo(ry, C, C.getJointState(), False)
    solver = ry.NLP_Solver(komo.nlp(), verbose=0)
    if options:
        solver.setOptions(verbose=0, **options)
    solver.solve()
    times, misses = [], []
    for position in positions:
        start = perf_counter()
        target.setPosition(position)
        komo.updateRootObjects(C)
        solver.solve()
        q = komo.getPath()[0]
        times.append(perf_counter() - start)
        C.setJointState(q)
        misses.append(float(np.linalg.norm(np.array(C.getFrame("l_gripper").getPosition()) - position)))
    return times, quality(misses)


def pathKomo(ry, C, phases, slices):
    komo = ry.KOMO(C, phases, slices, 2, True)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1e0)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1e0])
    komo.addObjective([float(phases)], ry.FS.jointState, [], ry.OT.eq, [1e0], [], order=1)
    return komo


def timeReach(ry, C, problem, slices, options):
    place(C, problem)
    C.setJointState(Q_HOME)
    start = process_time()
    komo = pathKomo(ry, C, 1, slices)
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "goal"], ry.OT.eq, [1e1])
    solver = ry.NLP_Solver(komo.nlp(), verbose=0)
    if options:
        solver.setOptions(verbose=0, **options)
    answer = solver.solve()
    path = komo.getPath()
    return {"time": process_time() - start, "evaluations": answer.evals, "path": path.tolist()}


def timePhases(ry, np, C, problem):
    place(C, problem)
    C.setJointState(Q_HOME)
    gripper = np.array(C.getFrame("l_gripper").getPosition())
    goals = [gripper + np.array([0.15 * np.sin(i), 0.1 * np.cos(2 * i), -0.15 * (i % 2)]) for i in range(PHASES)]
    start = process_time()
    komo = pathKomo(ry, C, PHASES, 32)
    for i, goal in enumerate(goals):
        komo.addObjective([i + 1.0], ry.FS.position, ["l_gripper"], ry.OT.eq, [1e1], goal)
    answer = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    path = komo.getPath()
    seconds = process_time() - start
    return {"time": seconds, "evaluations": answer.evals, "path": path.tolist(), "goals": [g.tolist() for g in goals]}


def timeBuild(ry, C, count=20):
    """Returns seconds of each, and MB of a problem after its evaluation."""

    def build():
        komo = ry.KOMO(C, 1, 1000, 2, True)
        komo.addControlObjective([], 2, 1.0)
        komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1.0])
        komo.addObjective([1.0], ry.FS.position, ["l_gripper"], ry.OT.eq, [1e1], [0.3, 0.3, 1.0])
        return komo, komo.nlp()

    before = residentMegabytes()
    komo, nlp = build()
    nlp.evaluate(komo.getPath().ravel())
    megabytes = residentMegabytes() - before
    del komo, nlp
    times = []
    for _ in range(count):
        start = process_time()
        kept = build()
        times.append(process_time() - start)
        del kept
    return times, megabytes


def residentMegabytes():
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmRSS"))


def checkPaths(ry, np, task):
    """Returns the number of good paths per row of the table."""
    C = reachScene(ry)
    good = {}
    for entry in task["paths"]:
        place(C, entry)
        path = np.array(entry["path"])
        goals = entry.get("goals") or [C.getFrame("goal").getPosition()]
        missed, deepest = 0.0, 0.0
        for q in path:
            deepest = max(deepest, depth(C, q))
        for i, goal in enumerate(goals):
            C.setJointState(path[(i + 1) * len(path) // len(goals) - 1])
            missed = max(missed, float(np.linalg.norm(np.array(C.getFrame("l_gripper").getPosition()) - goal)))
        counts = good.setdefault(entry["row"], [0, 0, 0.0])
        counts[0] += missed < 1e-3 and deepest < 1e-3
        counts[1] += 1
        counts[2] = max(counts[2], 1e3 * missed)
    return {"good": good}


# --- the processes, in turns ----------------------------------------------------------------------------------------


def runWorker(python, role, folder, task, is_reference=False):
    out, task_file = Path(folder) / "report.json", Path(folder) / "task.json"
    out.unlink(missing_ok=True)
    task_file.write_text(json.dumps(task))
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", KINEGRAPH_HEADLESS="1")
    if is_reference:
        environment.pop("PYTHONPATH", None)  # it may point to Kinegraph's `robotic`
    command = [python, os.path.abspath(__file__), "--worker", role, "--out", str(out), "--task", str(task_file)]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=1200)
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


def printTable(reports, good):
    print(
        f"\n{'µs':18}{'reference':>12}{'kinegraph':>12}{'ratio':>8}{'over the rounds':>18}{'evaluations':>14}"
        f"{'within 1 mm':>18}{'largest miss':>18}"
    )
    for row in [*reports["kinegraph"][0]["times"]]:
        values = {}
        for who, runs in reports.items():
            key = row if row in runs[0]["times"] else "ik"  # `kept` has none
            values[who] = [statistics.median(r["times"][key]) for r in runs]
        line = f"{row:18}"
        middle = {who: 1e6 * statistics.median(v) for who, v in values.items()}
        line += f"{middle['reference']:12.1f}" if "reference" in middle else f"{'':12}"
        line += f"{middle['kinegraph']:12.1f}"
        if "reference" in values:
            ratios = [r / k for r, k in zip(values["reference"], values["kinegraph"])]
            spread = f"{min(ratios):.1f} ... {max(ratios):.1f}"
            line += f"{statistics.median(ratios):8.1f}{spread:>18}"
        else:
            line += f"{'':26}"
        medians = [
            f"{statistics.median(r[0]['evaluations'][row]):.0f}" for r in reports.values() if row in r[0]["evaluations"]
        ]
        line += f"{' / '.join(medians):>14}"
        counts = [g[row] for g in good.values() if row in g]
        counts += [runs[0]["quality"][row] for runs in reports.values() if row in runs[0]["quality"]]
        line += f"{', '.join(f'{c[0]}/{c[1]}' for c in counts):>18}"
        print(line + f"{', '.join(f'{c[2]:.2g}' for c in counts):>18}")
    megabytes = [f"{who} {statistics.median(r['megabytes'] for r in runs):.1f} MB" for who, runs in reports.items()]
    print("memory of `build`, evaluated once:", ", ".join(megabytes))


def runFamily(run, pythons, options):
    """Prints the table of random problems. Returns the kinds of which Kinegraph solves fewer than the reference."""
    problems = run("kinegraph", "draw", {"seed": options.seed, "count": options.family})["problems"]
    answers = {who: [] for who in pythons}
    kinds = list(dict.fromkeys(p["kind"] for p in problems))
    for kind in kinds:  # in turns
        task = {"problems": [p for p in problems if p["kind"] == kind]}
        for who in pythons:
            answers[who] += run(who, "family", task)["answers"]
    tasks = {who: {"problems": problems, "answers": answers[who]} for who in pythons}
    solved = {who: run(next(iter(pythons)), "judge", task)["solved"] for who, task in tasks.items()}
    print(f"\n{options.family} random problems of each kind, seed {options.seed}")
    for who in pythons:
        print(f"\n{who}:\n{komo_family.HEADER}")
        for kind in kinds:
            komo_family.printRow(kind, solved[who], answers[who])
    if "reference" not in pythons:
        return []
    pairs = [side for who in ("kinegraph", "reference") for side in (solved[who], answers[who])]
    komo_family.printComparison("kinegraph against reference:", *pairs)
    count = {(who, p["kind"]): 0 for who in pythons for p in problems}
    for who in pythons:
        for problem, is_solved in zip(problems, solved[who]):
            count[who, problem["kind"]] += is_solved
    return [kind for kind in kinds if count["kinegraph", kind] < count["reference", kind]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--ours", default=sys.executable, help="a Python with Kinegraph (default: this one)")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--targets", type=int, default=300, help="targets of the inverse kinematics per round")
    parser.add_argument("--quick", action="store_true", help="five problems, paths of at most 64 slices")
    parser.add_argument("--family", type=int, default=5, help="random problems of each kind; 0: none")
    parser.add_argument("--seed", type=int, default=1, help="of the random problems")
    for internal in ("--worker", "--out", "--task"):
        parser.add_argument(internal, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options)
    if options.rounds < 1 or options.targets < 1:
        parser.error("--rounds and --targets must be at least 1")

    pythons = {"reference": os.path.abspath(options.reference)} if options.reference else {}
    pythons["kinegraph"] = os.path.abspath(options.ours)
    reports = {who: [] for who in pythons}
    with tempfile.TemporaryDirectory() as folder:  # the reference writes a log file to its working directory

        def run(who, role, task):
            return runWorker(pythons[who], role, folder, task, who == "reference")

        about = {who: run(who, "describe", {}) for who in pythons}
        judge = next(iter(pythons))
        problems = run(judge, "problems", {"seed": 11, "count": 5 if options.quick else 20})["problems"]
        lengths = [n for n in LENGTHS if n <= 64 or not options.quick]
        task = {"problems": problems, "lengths": lengths, "targets": options.targets}
        for i in range(options.rounds):
            for who in list(pythons) if i % 2 == 0 else list(pythons)[::-1]:
                reports[who].append(run(who, "measure", task))
        print("command: ", " ".join(["python", *sys.argv]))
        print("machine: ", machine())
        for who in pythons:
            print(f"{who}: {about[who]['version']} (python {about[who]['python']}, numpy {about[who]['numpy']})")
        print(f"rounds:   {options.rounds}, {options.targets} targets each; paths judged by: {judge}")
        family_worse = runFamily(run, pythons, options) if options.family else []
        good = {who: run(judge, "check", {"paths": runs[0]["paths"]})["good"] for who, runs in reports.items()}

    printTable(reports, good)
    reference, ours = good.get("reference", {}), good["kinegraph"]
    worse = [row for row in ours if ours[row][0] < reference.get(row, [0])[0]] + family_worse
    print(
        "answers:", f"WORSE than the reference in {', '.join(worse)}" if worse else "as good as the reference or better"
    )
    sys.exit(1 if worse else 0)


if __name__ == "__main__":
    main()
