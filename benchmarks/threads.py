#!/usr/bin/env python3
"""Measures the speedup of 8 motion problems on 2 threads.

    python benchmarks/threads.py [--slices 64] [--problems 8] [--threads 2] [--rounds 5]

A Panda reaches 8 targets, each by a path of its own. Each round runs in turns: `solve` in a loop, `solve` in a pool of
Python threads (which helps only if the interpreter lock is released), and `solveAll`. Times are wall-clock times on a
quiet machine. The benchmark fails unless all give the same bits. The goal is less than 0.65 of the loop's time on 2
threads.
"""

import argparse
import concurrent.futures
import os
import statistics
from time import perf_counter

import numpy as np

import kinegraph as ry


def problem(C: ry.Config, target, slices: int) -> ry.KOMO:
    komo = ry.KOMO(C, 1, slices, 2, False)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1.0)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1.0])
    komo.addObjective([1.0], ry.FS.position, ["l_gripper"], ry.OT.eq, [10.0], target)
    return komo


def solve(komo: ry.KOMO) -> ry.SolverReturn:
    return ry.NLP_Solver(komo.nlp(), verbose=0).solve()


def inLoop(komos, threads):
    return [solve(komo) for komo in komos]


def inPool(komos, threads):
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        return list(pool.map(solve, komos))


def together(komos, threads):
    return ry.solveAll(komos, threads=threads).results


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, default in (("slices", 64), ("problems", 8), ("threads", 2), ("rounds", 5)):
        parser.add_argument(f"--{name}", type=int, default=default)
    options = parser.parse_args()
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    rng = np.random.default_rng(0)
    targets = np.array([0.3, 0.3, 1.1]) + rng.uniform(-0.2, 0.2, (options.problems, 3))
    ways = {"loop": inLoop, "pool": inPool, "solveAll": together}
    times: dict[str, list[float]] = {name: [] for name in ways}
    reference = None
    for _ in range(options.rounds):
        for name, way in ways.items():
            komos = [problem(C, target, options.slices) for target in targets]
            start = perf_counter()
            results = way(komos, options.threads)
            times[name].append(perf_counter() - start)
            x = np.array([ret.x for ret in results])
            reference = x if reference is None else reference
            if not np.array_equal(x, reference):
                print(f"{name} gives other paths")
                return 1
    feasible = sum(ret.feasible for ret in results)
    print(
        f"{options.problems} paths of {options.slices} slices, {feasible} feasible; {os.cpu_count()} processors, medians of {options.rounds} rounds"
    )
    for name, seconds in times.items():
        ratios = sorted(a / b for a, b in zip(seconds, times["loop"]))
        print(
            f"{name:10s} {1e3 * statistics.median(seconds):8.1f} ms   {statistics.median(ratios):.2f} of the loop ({ratios[0]:.2f} to {ratios[-1]:.2f})"
        )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
