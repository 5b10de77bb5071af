"""Measures the overhead of maps: engines in turns for items of 1 ms, IK with and without files, killed workers.

    python benchmarks/fleets.py [--seconds 30] [--workers 2] [--kill 60]

Only finished work counts, and the time of an engine starts with its first result. Ray needs the extra `ray`, files need
`fleets`.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import random
import shutil
import signal
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import kinegraph as ry


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    return C


def targets(count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform([0.2, -0.5, 0.2], [0.7, 0.5, 0.8], (count, 3))


def steadyRate(results: Iterator[int], seconds: float) -> float:
    """Returns items per second, from the hundredth on."""
    for _ in range(100):
        next(results)
    start, count = time.perf_counter(), 0
    while (spent := time.perf_counter() - start) < seconds:
        count += next(results)
    return count / spent


def compareEngines(engines: list[str], workers: int, seconds: float) -> None:
    """Compares engines on items of 500 IK targets, about 1 ms each."""
    C = panda()

    def solve(seed: int) -> int:
        rng = np.random.default_rng(seed)
        ry.solveIk(C, {"gripper": rng.uniform([0.2, -0.5, 0.2], [0.7, 0.5, 0.8], (500, 3))})
        return 1

    print(f"items of 500 inverse kinematics, {workers} workers, {seconds:g} s each")
    for engine in engines:
        results = ry.imap(solve, iter(range(1 << 40)), engine=engine, workers=workers)
        rate = steadyRate(results, seconds)
        results.close()
        print(f"  {engine:10} {rate:8.1f} items/s  {rate * 500:.4g} targets/s")


def compareWithPlainBatch(workers: int, seconds: float) -> None:
    """Compares one call with all targets, a map without files, and a map that writes each q."""
    import pyarrow as pa

    C, chunk = panda(), 20_000
    start, count = time.perf_counter(), 0
    while time.perf_counter() - start < seconds:
        ry.solveIk(C, {"gripper": targets(chunk, count)}, threads=workers)
        count += 1
    plain = count * chunk / (time.perf_counter() - start)
    items = max(workers * 4, count)

    def solve(seed: int) -> pa.Table:
        goal = targets(chunk, seed)
        found = ry.solveIk(C, {"gripper": goal})
        columns = {
            name: pa.FixedSizeListArray.from_arrays(pa.array(rows.ravel()), rows.shape[1])
            for name, rows in (("q", found.q), ("target", goal))
        }
        return pa.table({"feasible": found.feasible, **columns})

    def forget(seed: int) -> int:
        return int(np.count_nonzero(ry.solveIk(C, {"gripper": targets(chunk, seed)}).feasible))

    print(f"inverse kinematics, {workers} threads: one call per {chunk} targets {plain:.4g} targets/s")
    for name, function, out in (("map", forget, None), ("map with Parquet", solve, tempfile.mkdtemp())):
        results = ry.map(function, range(items), workers=workers, out=out)
        rate = items * chunk / results.seconds
        size = sum(f.stat().st_size for f in Path(out).glob("*.parquet")) / (items * chunk) if out else 0
        print(
            f"  {name:18} {rate:.4g} targets/s = {rate / plain:.2f} of the plain rate"
            + (f", {size:.0f} bytes a row" if out else "")
        )
        if out:
            shutil.rmtree(out)


def killWorkers(engine: str, workers: int, seconds: float) -> None:
    """Kills a worker about every second, and compares all results with those of an undisturbed run."""
    C = panda()

    def solve(index: int) -> tuple[int, bytes]:
        return os.getpid(), ry.solveIk(C, {"gripper": targets(500, index)}).q.tobytes()

    rng, start, kills, digest, last = random.Random(0), time.perf_counter(), 0, hashlib.sha256(), 0.0
    count = 0
    for pid, q in ry.imap(solve, iter(range(1 << 40)), engine=engine, workers=workers):
        digest.update(q)
        count += 1
        spent = time.perf_counter() - start
        if spent > seconds:
            break
        if spent - last > rng.uniform(0.5, 1.5):
            last = spent
            try:
                os.kill(pid, signal.SIGKILL)
                kills += 1
            except ProcessLookupError:
                pass  # the worker has ended
    expected = hashlib.sha256()
    for _, q in ry.imap(solve, range(count), engine="threads", workers=workers):
        expected.update(q)
    same = digest.digest() == expected.digest()
    print(
        f"{engine}: {kills} workers killed in {seconds:g} s, {count} items, {'same bits' if same else 'OTHER BITS'} as threads"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--seconds", type=float, default=30.0, help="per engine (default: 30)")
    parser.add_argument("--kill", type=float, default=60.0, help="seconds with workers that are killed (default: 60)")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    try:
        import ray  # noqa: F401

        engines = ["threads", "processes", "ray"]
    except ImportError:
        engines = ["threads", "processes"]
    compareEngines([*engines, "threads"], options.workers, options.seconds)
    compareWithPlainBatch(options.workers, options.seconds)
    for engine in engines[1:]:
        killWorkers(engine, options.workers, options.kill)


if __name__ == "__main__":
    main()
