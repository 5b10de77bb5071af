#!/usr/bin/env python3
"""Measures collision queries against the number of shapes.

    python benchmarks/collisions.py [--shapes 100 1000 10000] [--reference PATH_TO_REFERENCE_PYTHON] [--rounds 5]

Boxes, balls, capsules and cylinders fill a space that grows with their number, so that each touches equally many
others. A Panda stands among them. Times are per call, the fastest of the rounds:

    compile     the first query after the scene was created, with all preparations
    walk        setJointState to a configuration near the last one, and getCollisions
    jump        setJointState to a random configuration, and getCollisions
    edit        setPosition of one obstacle, and getCollisions
    violation   as jump, coll_totalViolation
    feature     as jump, eval of accumulatedCollisions with its Jacobian
    valid       a configuration of isValid, which takes 256 random ones in one call
    motion      checkMotion between two random configurations

With --reference, the package `robotic` answers `jump` for 100 and 1000 shapes. For more shapes its list of pairs
exceeds the memory.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from tutorial_ratio import machine, versions


def scene(ry, np, count):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    random = np.random.default_rng(0)
    side = 0.25 * count ** (1 / 3)
    kinds = [
        ("sphere", [0.05]),
        ("capsule", [0.1, 0.03]),
        ("ssBox", [0.1, 0.06, 0.08, 0.01]),
        ("cylinder", [0.1, 0.04]),
    ]
    for i in range(count):
        shape, size = kinds[i % len(kinds)]
        frame = C.addFrame(f"obstacle{i}")
        frame.setShape(getattr(ry.ST, shape), size)
        frame.setPosition((random.random(3) * [2 * side, 2 * side, side] - [side, side, -0.4]).tolist())
        frame.setQuaternion(random.normal(size=4).tolist())
        frame.setContact(1)
    return C


def least(function, rounds):
    times = []
    for _ in range(rounds):
        start = perf_counter()
        calls = function()
        times.append((perf_counter() - start) / calls)
    return 1e6 * min(times)


def measure(ry, np, count, rounds, everything):
    C = scene(ry, np, count)
    limits = np.asarray(C.getJointLimits())
    random = np.random.default_rng(1)
    Q = limits[0] + random.random((256, limits.shape[1])) * (limits[1] - limits[0])
    obstacle = C.getFrame("obstacle0")
    few = 20 if count >= 10000 else 100

    def loop(steps, ask):
        def run():
            for q in steps:
                C.setJointState(q)
                ask()
            return len(steps)

        return run

    def edit():
        for i in range(few):
            obstacle.setPosition([0.01 * (i % 50), 1.0, 1.0])
            C.getCollisions()
        return few

    start = perf_counter()
    pairs = len(C.getCollisions())
    row = {"shapes": count, "near": pairs, "compile": 1e6 * (perf_counter() - start)}
    row["jump"] = least(loop(Q[:few], C.getCollisions), rounds)
    if not everything:
        return row
    near = Q[0] + np.cumsum(random.normal(scale=0.002, size=(few, Q.shape[1])), axis=0)
    row["walk"] = least(loop(near, C.getCollisions), rounds)
    row["edit"] = least(edit, rounds)
    row["violation"] = least(loop(Q[:few], C.coll_totalViolation), rounds)
    row["feature"] = least(loop(Q[:few], lambda: C.eval(ry.FS.accumulatedCollisions)), rounds)
    row["valid"] = least(lambda: len(C.isValid(Q)), rounds)
    row["motion"] = least(lambda: [C.checkMotion(Q[i], Q[i + 1]) for i in range(5)] and 5, rounds)
    return row


def worker(options):
    import numpy as np

    import robotic as ry

    ours = hasattr(ry.Config, "isValid")
    rows = [measure(ry, np, n, options.rounds, ours) for n in options.shapes]
    Path(options.out).write_text(json.dumps({"rows": rows, "versions": versions(ry)}))


def runWorker(python, options, shapes, folder):
    out = Path(folder) / "rows.json"
    command = [python, str(Path(__file__).resolve()), "--worker", "--out", str(out), "--rounds", str(options.rounds)]
    done = subprocess.run([*command, "--shapes", *map(str, shapes)], cwd=folder, capture_output=True, text=True)
    if not out.exists():
        sys.exit(f"{python} failed with status {done.returncode}:\n{done.stderr[-2000:]}")
    return json.loads(out.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shapes", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--reference", help="a Python with the reference package as `robotic`")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker:
        worker(options)
        return
    with tempfile.TemporaryDirectory() as folder:
        ours = runWorker(sys.executable, options, options.shapes, folder)
        shapes = [n for n in options.shapes if n <= 1000]
        reference = runWorker(options.reference, options, shapes, folder) if options.reference and shapes else None
    print("command: ", " ".join(["python", *sys.argv]))
    print("machine: ", machine())
    print(
        "package: ",
        ours["versions"]["version"],
        *(["reference:", reference["versions"]["version"]] if reference else []),
    )
    names = ["shapes", "near", "compile", "walk", "jump", "edit", "violation", "feature", "valid", "motion"]
    print(f"\nµs{'':8}" + "".join(f"{name:>11}" for name in names) + (f"{'ref jump':>11}" if reference else ""))
    for i, row in enumerate(ours["rows"]):
        print(
            f"{'':10}"
            + "".join(
                f"{row[name]:11.0f}" if row[name] >= 100 or name in ("shapes", "near") else f"{row[name]:11.1f}"
                for name in names
            ),
            end="",
        )
        print(f"{reference['rows'][i]['jump']:11.0f}" if reference and i < len(reference["rows"]) else "")


if __name__ == "__main__":
    main()
