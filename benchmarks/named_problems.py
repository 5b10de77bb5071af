#!/usr/bin/env python3
"""Counts the starts, of 20, that lead to a solution of the named motion problems, for Kinegraph and the package
`robotic`.

    python benchmarks/named_problems.py [--reference PATH_TO_REFERENCE_PYTHON] [--starts 20]

The problems are those of `make_NLP_Problem` and `OptBench_*`. The first start is the initial point of the problem. The
others add noise of 0.1, within the bounds. A start is solved within 1e-3 (1e-6) if no constraint is violated by more,
evaluated outside of the solver. The solver has its defaults for 1e-3, and `stopTolerance=1e-6` for 1e-6 (the reference:
damping 0.01 and stopTolerance 1e-3). `restarts` is the share that Kinegraph solves within 1e-3 if failed starts are
followed by others, at most ten. The reference lacks a scene for the problems of skeletons.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

NAMED = ["IK", "IKobstacle", "PushToReach", "StableSphere", "MinimalConvexCore"]
SKELETONS = ["Pick _sequence", "Pick _path", "Handover _sequence", "Handover _path", "StackAndBalance _sequence"]
RESTARTS = 10


def make(ry, name):
    """Returns the problem, and the object that keeps it alive in the reference."""
    if name in NAMED:
        return ry.make_NLP_Problem(name), None
    kind, word = name.split()
    maker = getattr(ry, f"OptBench_Skeleton_{kind}")(getattr(ry, word))
    return maker.get(), maker


def run(ry, np, name, seed, options):
    nlp, _keep = make(ry, name)
    lower, upper = np.array(nlp.getBounds()).reshape(2, -1)
    x = np.array(nlp.getInitializationSample())
    if seed > 0:
        x += 0.1 * np.random.default_rng(seed).standard_normal(len(x))
    x = np.where(lower <= upper, np.clip(x, lower, upper), x)
    solver = ry.NLP_Solver(nlp, verbose=0)
    solver.setOptions(verbose=0, **options)
    solver.setInitialization(x)
    answer = solver.solve()
    phi, _ = nlp.evaluate(answer.x)
    kinds = [str(kind).split(".")[-1] for kind in nlp.getTypes()]
    violation = max(abs(v) if kind == "eq" else max(v, 0.0) if kind == "ineq" else 0.0 for v, kind in zip(phi, kinds))
    cost = sum(v * v if kind == "sos" else v for v, kind in zip(phi, kinds) if kind in ("sos", "f"))
    return {"violation": float(violation), "cost": float(cost), "evaluations": answer.evals, "variables": len(x)}


def worker(name, starts, out):
    import numpy as np

    import robotic as ry

    ours = hasattr(ry, "solveIk")
    tight = {"stopTolerance": 1e-6} if ours else {"damping": 1e-2, "stopTolerance": 1e-3}
    report = {
        "1e-3": [run(ry, np, name, seed, {}) for seed in range(starts)],
        "1e-6": [run(ry, np, name, seed, tight) for seed in range(starts)],
    }
    if ours:
        report["restarts"] = [
            first["violation"] <= 1e-3
            or any(
                run(ry, np, name, 1000 * (seed + 1) + again, {})["violation"] <= 1e-3 for again in range(1, RESTARTS)
            )
            for seed, first in enumerate(report["1e-3"])
        ]
    with open(out, "w") as file:
        json.dump(report, file)
    sys.stdout.flush()
    os._exit(0)  # skips the destructors of the reference


def runWorker(python, name, starts, is_reference):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "report.json")
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", KINEGRAPH_HEADLESS="1")
        if is_reference:
            environment.pop("PYTHONPATH", None)  # it may point to Kinegraph's `robotic`
        command = [python, os.path.abspath(__file__), "--worker", name, "--out", out, "--starts", str(starts)]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=1800)
        if not os.path.exists(out):
            sys.exit(f"{python} failed with status {done.returncode}:\n{done.stderr[-2000:]}")
        with open(out) as file:
            return json.load(file)


def cells(report):
    loose, tight = ([r for r in report[key] if r["violation"] <= float(key)] for key in ("1e-3", "1e-6"))
    least = f"{min(r['cost'] for r in loose):.4g}" if loose else "-"
    evaluations = statistics.median(r["evaluations"] for r in report["1e-3"])
    violation = statistics.median(r["violation"] for r in report["1e-3"])
    return f"{len(loose):4} {len(tight):4} {evaluations:6.0f} {least:>9} {violation:9.1e}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--starts", type=int, default=20)
    parser.add_argument("--worker", help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options.worker, options.starts, options.out)
    head = "1e-3 1e-6  evals      cost violation"
    print(
        f"{'of ' + str(options.starts) + ' starts':28} {'Kinegraph ' + head} restarts"
        + (f"  robotic {head}" if options.reference else "")
    )
    for name in [*NAMED, *SKELETONS]:
        ours = runWorker(sys.executable, name, options.starts, False)
        share = 100 * sum(ours["restarts"]) / options.starts
        line = f"{name:28} {ours['1e-3'][0]['variables']:9} {cells(ours)} {share:6.0f} %"
        if options.reference and name in NAMED:
            line += f"          {cells(runWorker(options.reference, name, options.starts, True))}"
        print(line, flush=True)


if __name__ == "__main__":
    main()
