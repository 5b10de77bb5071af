#!/usr/bin/env python3
"""Measures poses, Jacobians and distances of a Panda, one configuration at a time and many in one call.

    python benchmarks/kinematics.py [--reference PATH_TO_REFERENCE_PYTHON] [--peers PATH_TO_PYTHON] [--rounds 5]
        [--threads 2]

Times are per configuration, on random joint vectors within the limits, in the scenarios/pandaSingle.g of both packages:

    position    the gripper's position and its Jacobian (3, n)
    pose        the gripper's position and quaternion and their Jacobian (7, n)
    frame       the gripper's pose
    contacts    the colliding pairs (Kinegraph's batch: the distances of all pairs)
    distances   the distances of all pairs, with nearest points and normals (coal: computeDistances)
    valid       within limits and without collision?

"single" is setJointState and the query, in a Python loop. "batch" is one call for all configurations, and "threads" the
same on several threads, which a busy machine disturbs. With --reference, each round runs a process per package, in
turns. Ratios are those within a round: the loop of `robotic` over Kinegraph's loop, and over its batch.

Pinocchio (with coal) and MuJoCo take part if they are installed, in this Python or in that of --peers. They have
Kinegraph's Panda, and answer with one or two of their own closest calls: for Jacobians one of 6 rows, for collisions of
the same pairs contacts without distances. Positions and numbers of valid configurations are compared.

Finally, position of the tip and Jacobian are measured for chains of 10, 100 and 1000 joints, single, in Kinegraph.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

import panda_peers
from tutorial_ratio import machine, versions

QUESTIONS = ["position", "pose", "frame", "contacts", "distances", "valid"]
CHAINS = [10, 100, 1000]
TIP = "l_gripper"


# --- the part that both packages run --------------------------------------------------------------------------------


def worker(options):
    import numpy as np

    import robotic as ry

    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    limits = np.asarray(C.getJointLimits())
    Q = configurations(limits, options.count)
    questions = singles(ry, C, limits)
    times = {f"{name} single": timeLoop(C.setJointState, single, Q[:100]) for name, single in questions.items()}
    report = {"times": times, "versions": versions(ry), "numpy": np.__version__}
    if hasattr(C, "evalBatch"):
        for threads, kind in ((1, "batch"), (options.threads, "threads")):
            for name, batch in batches(ry, C, Q, threads).items():
                times[f"{name} {kind}"] = timeCalls(batch, len(Q))
        for joints in CHAINS:
            times[f"chain {joints}"] = timeChain(ry, joints, np.zeros((20, joints)))
        C.setJointState(Q[0])
        report["answers"] = {
            "tip": C.eval(ry.FS.position, [TIP])[0].tolist(),
            "valid": int(C.isValid(Q[:100]).sum()),
            "distances": C.getNearestPoints()[0].tolist(),
        }
        report["scene"] = panda_peers.describe(ry, C, TIP)
    Path(options.out).write_text(json.dumps(report))
    sys.stdout.flush()
    os._exit(0)  # skips the destructors of the reference


def peerWorker(options):
    import numpy as np

    questions = panda_peers.load(options.worker, options.scene)
    limits = np.array(json.loads(Path(options.scene).read_text())["limits"])
    Q = configurations(limits, options.count)
    times = {f"{name} single": timeLoop(lambda q: None, single, Q[:100]) for name, single in questions.items()}
    answers = {"tip": list(questions["position"](Q[0])[0]), "valid": sum(map(questions["valid"], Q[:100]))}
    if "distances" in questions:
        answers["distances"] = [result.min_distance for result in questions["distances"](Q[0])]
    Path(options.out).write_text(json.dumps({"times": times, "answers": answers}))


def configurations(limits, count):
    import numpy as np

    return limits[0] + np.random.default_rng(1).random((count, limits.shape[1])) * (limits[1] - limits[0])


def timeChain(ry, joints, Q):
    C = ry.Config()
    links = [f'link{i + 1}(link{i}): {{ pre: "t(.01 0 0)", joint: hingeZ }}' for i in range(joints)]
    C.addText("\n".join(["link0: {}", *links, f"tip(link{joints}): {{ Q: [.01 0 0] }}"]))
    return timeLoop(C.setJointState, lambda q: C.eval(ry.FS.position, ["tip"]), Q, 10)


def singles(ry, C, limits):
    gripper = C.getFrame(TIP)
    collisions = C.getCollisions

    def valid(q):
        return bool((q >= limits[0]).all() and (q <= limits[1]).all()) and not collisions()

    nearest = {"distances": lambda q: C.getNearestPoints()} if hasattr(C, "getNearestPoints") else {}
    return nearest | {
        "position": lambda q: C.eval(ry.FS.position, [TIP]),
        "pose": lambda q: C.eval(ry.FS.pose, [TIP]),
        "frame": lambda q: gripper.getPose(),
        "contacts": lambda q: collisions(),
        "valid": valid,
    }


def batches(ry, C, Q, threads):
    return {
        "position": lambda: C.evalBatch(ry.FS.position, [TIP], Q, threads=threads),
        "pose": lambda: C.evalBatch(ry.FS.pose, [TIP], Q, threads=threads),
        "frame": lambda: C.getFramePoses(Q, [TIP], threads=threads),
        "contacts": lambda: C.getDistances(Q, threads=threads),
        "distances": lambda: C.getNearestPoints(Q, threads=threads),
        "valid": lambda: C.isValid(Q, threads=threads),
    }


def timeLoop(setJoints, single, Q, repeats=20):
    times = []
    for _ in range(repeats):
        start = perf_counter()
        for q in Q:
            setJoints(q)
            single(q)
        times.append((perf_counter() - start) / len(Q))
    return times


def timeCalls(batch, count, repeats=10):
    times = []
    for _ in range(repeats):
        start = perf_counter()
        batch()
        times.append((perf_counter() - start) / count)
    return times


# --- the processes, in turns ----------------------------------------------------------------------------------------


def runWorker(python, folder, options, worker="package", is_reference=False):
    out = Path(folder) / "report.json"
    out.unlink(missing_ok=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", KINEGRAPH_HEADLESS="1")
    if is_reference:
        environment.pop("PYTHONPATH", None)  # it may point to Kinegraph's `robotic`
    command = [
        python,
        os.path.abspath(__file__),
        "--worker",
        worker,
        "--out",
        str(out),
        "--scene",
        str(Path(folder) / "scene.json"),
    ]
    command += ["--count", str(options.count), "--threads", str(options.threads)]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=600)
    if not out.exists():
        sys.exit(f"{worker} in {python} failed with status {done.returncode}:\n{done.stderr[-2000:]}")
    return json.loads(out.read_text())


def findPeers(python):
    """Returns the versions of the peers in a Python."""
    code = "import json, panda_peers; print(json.dumps(panda_peers.installed()))"
    environment = dict(os.environ, PYTHONPATH=os.path.dirname(os.path.abspath(__file__)))
    done = subprocess.run([python, "-c", code], env=environment, capture_output=True, text=True, timeout=120)
    return json.loads(done.stdout.splitlines()[-1]) if done.returncode == 0 else {}


def compareAnswers(ours, peers):
    for name, runs in peers.items():
        error = max(abs(a - b) for a, b in zip(ours["answers"]["tip"], runs[0]["answers"]["tip"]))
        print(
            f"{name}: the gripper is within {error:.1e} m of Kinegraph's; valid of 100: {runs[0]['answers']['valid']}, Kinegraph {ours['answers']['valid']}"
        )
        if not error < 1e-6:
            sys.exit(f"{name} has another robot")
        if "distances" in runs[0]["answers"]:
            pairs = zip(ours["answers"]["distances"], runs[0]["answers"]["distances"])
            print(
                f"{name}: distances of pairs that are apart differ by at most {max(abs(a - b) for a, b in pairs if b > 0):.1e} m"
            )


def printTable(reports):
    ours, reference = reports["kinegraph"], reports.get("reference", [])
    peers = [name for name in panda_peers.PEERS if name in reports]
    print(
        f"{'µs, min':12}"
        + "".join(
            f"{heading:>12}"
            for heading in [
                "reference",
                *peers,
                "single",
                "batch",
                "threads",
                "ref/single",
                "ref/batch",
                *(f"{p[:4]}/single" for p in peers),
            ]
        )
    )
    for name in QUESTIONS:
        columns = [least(runs, name, "single") for runs in (reference, *(reports[peer] for peer in peers))]
        columns += [least(ours, name, kind) for kind in ("single", "batch", "threads")]
        ratios = [medianRatio(reference, ours, name, kind) for kind in ("single", "batch")]
        ratios += [medianRatio(reports[peer], ours, name, "single") for peer in peers]
        print(
            f"{name:12}"
            + "".join(cell(number, 3) for number in columns)
            + "".join(cell(number, 1) for number in ratios)
        )
    for joints in CHAINS:
        best = min(min(r["times"][f"chain {joints}"]) for r in ours)
        print(f"a chain of {joints} joints: {1e6 * best:.2f} µs, {1e9 * best / joints:.1f} ns per joint")


def cell(number, digits):
    return f"{'-':>12}" if number is None else f"{number:12.{digits}f}"


def least(runs, name, kind):
    """Returns the least time in µs, or None without an answer."""
    times = [r["times"].get(f"{name} {kind}") for r in runs]
    return 1e6 * min(min(t) for t in times) if times and all(times) else None


def medianRatio(others, ours, name, kind):
    """Returns the median over the rounds of the other package's loop time over our `kind`, medians in each round."""
    if least(others, name, "single") is None:
        return None
    rounds = zip(others, ours)
    middle = statistics.median
    return middle(middle(r["times"][f"{name} single"]) / middle(k["times"][f"{name} {kind}"]) for r, k in rounds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument(
        "--peers", default=sys.executable, help="a Python that may have Pinocchio or MuJoCo (default: this one)"
    )
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--count", type=int, default=4096, help="configurations in a batch, 100 or more")
    parser.add_argument("--threads", type=int, default=2, help="threads of the column of that name")
    for hidden in ("--worker", "--out", "--scene"):
        parser.add_argument(hidden, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options) if options.worker == "package" else peerWorker(options)
        return
    if options.rounds < 1 or options.count < 100 or options.threads < 1:
        parser.error("--rounds and --threads must be at least 1, --count at least 100")

    pythons = {"kinegraph": sys.executable}
    if options.reference:
        pythons["reference"] = os.path.abspath(options.reference)
    peers = findPeers(options.peers)
    reports = {who: [] for who in (*pythons, *peers)}
    with tempfile.TemporaryDirectory() as folder:  # the reference writes a log file to its working directory
        scene = runWorker(sys.executable, folder, options)["scene"]
        (Path(folder) / "scene.json").write_text(json.dumps(scene))
        for round_index in range(options.rounds):
            for who in list(reports)[:: 1 if round_index % 2 == 0 else -1]:
                run = ("package", who == "reference") if who in pythons else (who,)
                reports[who].append(runWorker(pythons.get(who, options.peers), folder, options, *run))

    print("command: ", " ".join(["python", *sys.argv]))
    print("machine: ", machine())
    for who in pythons:
        described = reports[who][0]["versions"]
        print(f"{who}: {described['version']} (python {described['python']}, numpy {reports[who][0]['numpy']})")
    for who, version in peers.items():
        print(f"{who}: {version}")
    print(
        f"rounds:   {options.rounds}, batches of {options.count}, {options.threads} threads in the column of that name"
    )
    compareAnswers(reports["kinegraph"][0], {who: reports[who] for who in peers})
    print()
    printTable(reports)


if __name__ == "__main__":
    main()
