#!/usr/bin/env python3
"""Measures the speed of `retime`, its distance to the least duration, and its limits. Compares toppra, ruckig and an LP
reference.

    python benchmarks/retiming.py [--paths 70] [--seed 1] [--references 3] [--only jerk]

Random paths of seven dofs have 3 to 11 points spread along a line and moved by 0.2 rad. They use the Panda's limits of
velocity and acceleration ("full"), or a quarter of the accelerations and jerks of ten times that per second ("gentle").
All packages get the same cubic spline. Times are processor times, medians. The bound is `retime` with 4000 intervals,
and for the first paths also toppra's with as many. Missing packages are skipped (toppra==0.6.10, ruckig==0.19.4,
scipy).

With limits of the jerk, `retime`, toppra and ruckig take turns, path by path, within equal limits of velocity and
acceleration. ruckig also limits the jerk and stops at each point (waypoints are not in its free version). toppra does
not limit the jerk. Durations are compared with the least one, that of `retime` with 3200 intervals. For the first paths
there is a reference as well: a sequence of linear programs over s'^2 on 200 and 800 equal intervals, with linearized
constraints, by scipy's HiGHS. It is slow, and was written independently of the library. Its limits hold at its
gridpoints only, so that it may be faster than possible. Limits are checked on 20,000 samples.
"""

import argparse
import itertools
import statistics
from time import process_time

import numpy as np

import kinegraph as ry

V = np.array([2.175] * 4 + [2.61] * 3)
A = np.array([15, 7.5, 10, 12.5, 15, 20, 20.0])
MODES = {"full": (A, 500 * A), "gentle": (A / 4, 10 * A / 4)}
LOW = np.array([-2.8, -1.7, -2.8, -3.0, -2.8, 0.0, -2.8])
HIGH = np.array([2.8, 1.7, 2.8, -0.1, 2.8, 3.7, 2.8])


def random_path(rng):
    count = rng.integers(3, 12)
    at = (np.arange(count) + np.r_[0, rng.uniform(-0.35, 0.35, count - 2), 0]) / (count - 1)
    moved = rng.normal(size=(count, 7)) * 0.2
    moved[[0, -1]] = 0
    a, b = rng.uniform(LOW, HIGH), rng.uniform(LOW, HIGH)
    return a + at[:, None] * (b - a) + moved


def timed(q, *limits, repeat=5, **options):
    best, result = np.inf, None
    for _ in range(repeat):
        start = process_time()
        result = ry.retime(q, V, *limits, **options)
        best = min(best, process_time() - start)
    return result, best * 1e6


def excess(motion, acceleration, jerk=None):
    t = np.linspace(0, motion.duration, 20001)
    _, qd, qdd = motion.eval(t)
    found = [np.max(np.abs(qd) / V), np.max(np.abs(qdd) / acceleration)]
    if jerk is not None:
        found.append(np.max(np.abs(np.diff(qdd, axis=0)) / ((t[1] - t[0]) * jerk)))
    return max(found) - 1


def chords(q):
    return np.r_[0, np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))]


def toppra_durations(q, acceleration, intervals):
    import toppra as ta
    import toppra.algorithm as algo
    import toppra.constraint as con

    ta.setup_logging("ERROR")
    L = chords(q)
    limits = [
        con.JointVelocityConstraint(np.stack([-V, V], 1)),
        con.JointAccelerationConstraint(np.stack([-acceleration, acceleration], 1)),
    ]
    grid = np.linspace(0, 1, intervals + 1)
    instance = algo.TOPPRA(
        limits, ta.SplineInterpolator(L / L[-1], q), gridpoints=grid, parametrizer="ParametrizeConstAccel"
    )
    start = process_time()
    trajectory = instance.compute_trajectory(0, 0)
    return trajectory.duration, (process_time() - start) * 1e6


def ruckig_duration(q, acceleration, jerk):
    """Returns the duration of rest-to-rest motions along each line."""
    import ruckig

    start, total = process_time(), 0.0
    generator = ruckig.Ruckig(7)
    for a, b in itertools.pairwise(q):
        ask = ruckig.InputParameter(7)
        ask.current_position, ask.target_position = a.tolist(), b.tolist()
        ask.max_velocity, ask.max_acceleration, ask.max_jerk = V.tolist(), acceleration.tolist(), jerk.tolist()
        ask.synchronization = ruckig.Synchronization.Phase
        trajectory = ruckig.Trajectory(7)
        generator.calculate(ask, trajectory)
        total += trajectory.duration
    return total, (process_time() - start) * 1e6


def jerk_reference(q, acceleration, jerk, intervals=200, rounds=30):
    """Returns the least duration over b = s'^2 at equal gridpoints, by linear programs around the previous solution."""
    import scipy.sparse as sp
    from scipy.interpolate import CubicSpline
    from scipy.optimize import linprog

    L = chords(q)
    curve = CubicSpline(L, q)
    n, s = intervals + 1, np.linspace(0, L[-1], intervals + 1)
    h = s[1]
    d1, d2, d3 = curve(s, 1), curve(s, 2), curve(s, 3)
    first = sp.diags([-np.ones(n - 1), np.ones(n - 1)], [-1, 1], shape=(n, n)).tolil() / (2 * h)
    second = sp.diags([np.ones(n - 1), -2 * np.ones(n), np.ones(n - 1)], [-1, 0, 1], shape=(n, n)).tolil() / h**2
    first[0], first[-1], second[0], second[-1] = 0, 0, 0, 0
    first, second = first.tocsr(), second.tocsr()
    cap = np.min((V / np.maximum(np.abs(d1), 1e-9)) ** 2, axis=1)
    inner = slice(1, n - 1)

    def used(b):
        root = np.sqrt(np.maximum(b, 0))[:, None]
        a = d1 * (first @ b)[:, None] / 2 + d2 * b[:, None]
        j = root * (d3 * b[:, None] + 1.5 * d2 * (first @ b)[:, None] + d1 * (second @ b)[:, None] / 2)
        return max(
            np.sqrt(np.max(b / cap)),
            np.sqrt(np.max(np.abs(a[inner]) / acceleration)),
            np.cbrt(np.max(np.abs(j[inner]) / jerk)),
        )

    def duration(b):
        root = np.sqrt(np.maximum(b, 0))
        ends = 3 * h / root[1] + 3 * h / root[-2]  # at rest b grows with s^(4/3)
        return ends + np.sum(2 * h / (root[1:-2] + root[2:-1]))

    b = np.sin(np.pi * s / L[-1]) ** (4 / 3)
    b /= used(b) ** 2
    trust = 0.5
    for _ in range(rounds):
        root = np.sqrt(np.maximum(b, 1e-12))
        rows, sides = [], []
        for k in range(q.shape[1]):
            accelerates = (sp.diags(d1[:, k] / 2) @ first + sp.diags(d2[:, k]))[inner]
            linear = sp.diags(d3[:, k]) + sp.diags(1.5 * d2[:, k]) @ first + sp.diags(d1[:, k] / 2) @ second
            value = linear @ b
            jerks = (sp.diags(root) @ linear + sp.diags(value / (2 * root)))[inner]
            shift = (value * b / (2 * root))[inner]
            rows += [accelerates, -accelerates, jerks, -jerks]
            sides += [np.full(n - 2, acceleration[k])] * 2 + [jerk[k] + shift, jerk[k] - shift]
        low, high = b * (1 - trust), np.minimum(cap, b * (1 + trust) + 1e-9)
        low[[0, -1]] = high[[0, -1]] = 0
        cost = np.zeros(n)
        cost[inner] = -h / (2 * root[inner] ** 3)
        cost[[1, -2]] *= 1 + 3 / 2
        answer = linprog(
            cost / np.abs(cost).max(), sp.vstack(rows).tocsr(), np.concatenate(sides), bounds=np.stack([low, high], 1)
        )
        moved = answer.x / max(1.0, used(answer.x)) ** 2 if answer.status == 0 else None
        if moved is not None and duration(moved) < duration(b) * (1 - 1e-6):
            b = moved
        else:
            trust /= 2
            if trust < 1e-3:
                break
    return duration(b)


def has(package):
    import importlib.util

    return importlib.util.find_spec(package) is not None


def line(name, values):
    print(
        f"  {name:<48} median {statistics.median(values):10.4g}   p95 {np.percentile(values, 95):10.4g}   max {max(values):10.4g}"
    )


def without_jerk(paths, acceleration, options):
    bounds = [ry.retime(q, V, acceleration, corners="spline", intervals=4000).duration for q in paths]
    for intervals in (50, 100, 200):
        found = [timed(q, acceleration, corners="spline", intervals=intervals) for q in paths]
        line(f"{intervals} intervals: us", [us for _, us in found])
        line("    duration / bound", [m.duration / b for (m, _), b in zip(found, bounds)])
        line("    limits exceeded by", [excess(m, acceleration) for m, _ in found])
    for corners in ("blend", "stop"):
        found = [timed(q, acceleration, corners=corners, tolerance=0.05) for q in paths]
        line(f"{corners}: us", [us for _, us in found])
        line("    limits exceeded by", [excess(m, acceleration) for m, _ in found])
    if has("toppra"):
        found = [toppra_durations(q, acceleration, 200) for q in paths]
        line("toppra, 200 intervals: us", [us for _, us in found])
        line("    duration / bound", [d / b for (d, _), b in zip(found, bounds)])
        fine = [toppra_durations(q, acceleration, 4000)[0] for q in paths[: options.references]]
        line("    with 4000 intervals: duration / bound", [d / b for d, b in zip(fine, bounds)])


def with_jerk(paths, acceleration, jerk, references):
    """Compares `retime`, toppra and ruckig in turns."""
    peers = {
        "toppra, no limits of the jerk": lambda q: toppra_durations(q, acceleration, 100),
        "ruckig, from point to point": lambda q: ruckig_duration(q, acceleration, jerk),
    }
    peers = {name: peer for name, peer in peers.items() if has(name.split(",")[0])}
    least = [ry.retime(q, V, acceleration, jerk, corners="spline", intervals=3200).duration for q in paths]
    motions, times = [], []
    of_peers = {name: ([], []) for name in peers}
    for q, best in zip(paths, least):
        motion, us = timed(q, acceleration, jerk, corners="spline")
        motions.append(motion)
        times.append(us)
        for name, peer in peers.items():
            turns = [peer(q) for _ in range(5)]
            of_peers[name][0].append(turns[0][0] / best)
            of_peers[name][1].append(min(us for _, us in turns))
    line("with jerk: us", times)
    line("    duration / least", [m.duration / best for m, best in zip(motions, least)])
    bounds = [ry.retime(q, V, acceleration, corners="spline", intervals=4000).duration for q in paths]
    line("    duration / bound without limits of the jerk", [m.duration / b for m, b in zip(motions, bounds)])
    line("    limits exceeded by", [excess(m, acceleration, jerk) for m in motions])
    for name, (durations, us) in of_peers.items():
        line(f"{name}: us", us)
        line("    duration / least", durations)
    if has("scipy") and references:
        for intervals in (200, 800):
            found = [jerk_reference(q, acceleration, jerk, intervals) for q in paths[:references]]
            line(f"duration / reference by LPs, {intervals} places", [m.duration / r for m, r in zip(motions, found)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--paths", type=int, default=70)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--references", type=int, default=3, help="paths for which slow references are computed")
    parser.add_argument("--only", choices=["jerk"])
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    paths = [random_path(rng) for _ in range(options.paths)]
    for mode, (acceleration, jerk) in MODES.items():
        print(f"{mode}: {len(paths)} paths")
        if not options.only:
            without_jerk(paths, acceleration, options)
        with_jerk(paths, acceleration, jerk, options.references)


if __name__ == "__main__":
    main()
