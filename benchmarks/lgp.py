"""Counts the problems that LGP_Tool solves, and measures its effort.

    python benchmarks/lgp.py [--problems kitchen_single,bimanual] [--first 0] [--seeds 20] [--jitter 0.02] [--threads 1]

The problems are those of tests/data/lgp: recorded ones, and those of the tutorial (kitchen_single, kitchen_handover). A
seed samples the starts, and moves each object by up to --jitter (m) along x and y. For each problem the table has the
number of seeds with a plan and waypoints, then medians of solved starts and evaluations, and the processor time. It
continues with the number of feasible motions over all actions (by our rule, in all slices), and the processor time of
plan and motion, median and maximum.
"""

from __future__ import annotations

import argparse
import statistics
import time
from pathlib import Path

import numpy as np

import kinegraph as ry

DATA = Path(__file__).parent.parent / "tests" / "data" / "lgp"
# The folders of scenes whose name differs from that of the problem.
SCENES = {"kitchen_single": "panda_unblock", "kitchen_handover": "bimanual"}
PROBLEMS = ["unblock", "tower", "pose", "gantry", "gantry_placebox", "panda_unblock", "handover", *SCENES]


def scene(name: str, seed: int, jitter: float) -> ry.Config:
    C = ry.Config()
    C.addFile(DATA / f"{SCENES.get(name, name)}.g")
    rng = np.random.default_rng(seed)
    for frame in C.getFrames():
        if "is_object" in str(frame.asDict().get("logical", "")):
            offset = rng.uniform(-jitter, jitter, 2)
            frame.setRelativePosition(frame.getRelativePosition() + np.append(offset, 0.0))
    return C


def run(name: str, seeds: range, jitter: float, threads: int) -> str:
    plans, motions = 0, 0
    solves, evaluations, first, whole = [], [], [], []
    for seed in seeds:
        C = scene(name, seed, jitter)
        ry.rnd_seed(seed)
        start = time.process_time()
        lgp = ry.LGP_Tool(C, ry.default_LGP_TAMP_Abstraction(C, DATA / f"{name}.lgp"), threads=threads)
        found = lgp.solve(0)
        first.append(time.process_time() - start)
        plans += found
        motions += bool(found and lgp.solveFullMotion(0).feasible)
        whole.append(time.process_time() - start)
        solves.append(lgp.solves)
        evaluations.append(lgp.evaluations)
    took = f"{1e3 * statistics.median(first):8.1f} ms {motions:6} {1e3 * statistics.median(whole):8.1f} ms {1e3 * max(whole):8.1f} ms"
    return f"{name:18} {plans:5} {statistics.median(solves):7.0f} {statistics.median(evaluations):11.0f} {took}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problems", default=",".join(PROBLEMS))
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--jitter", type=float, default=0.02)
    parser.add_argument("--threads", type=int, default=1)
    given = parser.parse_args()
    print(
        f"{given.seeds} seeds from {given.first} on, objects moved by up to {given.jitter} m, threads: {given.threads}"
    )
    print(
        f"{'problem':18} {'plans':>5} {'starts':>7} {'evaluations':>11} {'took':>11} {'motions':>6} {'took':>10} {'most':>11}"
    )
    for name in given.problems.split(","):
        print(run(name, range(given.first, given.first + given.seeds), given.jitter, given.threads), flush=True)


if __name__ == "__main__":
    main()
