"""Checks whether paths that KOMO reports as collision-free are so continuously. Random problems among boxes and walls
of 3 cm are solved twice: with collision constraints in slices only, and with `addFreeMotion`.

    python benchmarks/free_between_slices.py [--robot panda ur5] [--problems 100] [--slices 32] [--seed 1]
        [--start tree line] [--spline 16]

The initial guess is the straight line from start to goal, which collides, or a collision-free path found by a tree.
Answers are checked every 1e-3 rad, independently of the solver and the result. --spline solves for that number of
control points of a cubic spline (`SplineMotion`), and checks the spline. Times are processor times with the
construction of the KOMO, medians and 95th percentiles. UR5 comes from the package of the planning problems
(benchmarks/motion_bench_maker.py).
"""

import argparse
import functools
import itertools
from time import process_time

import numpy as np

import kinegraph as ry

STEP = 1e-3  # rad, of the independent check
MARGIN = 2e-3  # m
UR5_JOINTS = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
MOST = 4000  # growths of the trees


@functools.cache
def robot(name: str) -> ry.Config:
    C = ry.Config()
    if name == "ur5":
        import motion_bench_maker

        folder = motion_bench_maker.folder() / "ur5"
        C.addFile(str(folder / "ur5.urdf"))
        C.addFile(str(folder / "ur5.srdf"))
        C.selectJoints([f"{joint}_joint" for joint in UR5_JOINTS])
    else:
        C.addFile(ry.raiPath({"panda": "panda/panda_tight.g", "ur10": "ur10/ur10.g"}[name]))
    return C


def among_obstacles(name: str, rng: np.random.Generator) -> tuple[ry.Config, np.ndarray, np.ndarray]:
    """Returns a scene, a start and a goal, both with 1 cm of clearance; the straight line between them collides."""
    while True:
        C = robot(name).copy()
        for i in range(6):
            wall = i < 3
            size = [0.03, *rng.uniform(0.3, 0.8, 2)] if wall else list(rng.uniform(0.05, 0.25, 3))
            radius, angle, yaw = rng.uniform(0.35, 0.75), *rng.uniform(-np.pi, np.pi, 2)
            frame = C.addFrame(f"wall{i}" if wall else f"box{i}").setShape(ry.ST.box, size).setContact(1)
            frame.setPosition([radius * np.cos(angle), radius * np.sin(angle), rng.uniform(0.1, 0.9)])
            frame.setQuaternion([np.cos(yaw / 2), 0, 0, np.sin(yaw / 2)])
        lower, upper = np.maximum(C.getJointLimits()[0], -np.pi), np.minimum(C.getJointLimits()[1], np.pi)
        free = [q for q in rng.uniform(lower, upper, (60, len(lower))) if C.isValid(q[None], margin=0.01)[0]]
        for a in range(0, len(free) - 1, 2):
            start, goal = free[a], free[a + 1]
            if 1.5 < np.linalg.norm(goal - start) < 4.5 and not C.isMotionFree(start[None], goal[None])[0]:
                C.setJointState(start)
                return C, start, goal


def line(start: np.ndarray, goal: np.ndarray, count: int) -> np.ndarray:
    """Returns rows from start (excluded) to goal."""
    return start + np.linspace(1 / count, 1, count)[:, None] * (goal - start)


def branch(nodes: list[np.ndarray], parents: list[int], k: int = -1) -> list[np.ndarray]:
    """Returns the path from the root of a tree to its k-th node, by default the last one."""
    k %= len(nodes)
    nodes_above = [] if parents[k] < 0 else branch(nodes, parents, parents[k])
    return [*nodes_above, nodes[k]]


def tree_path(C: ry.Config, start: np.ndarray, goal: np.ndarray, rng: np.random.Generator) -> np.ndarray | None:
    """Returns a collision-free path by RRT-Connect with random shortcuts, or None if the trees do not meet."""
    lower, upper = np.maximum(C.getJointLimits()[0], -np.pi), np.minimum(C.getJointLimits()[1], np.pi)

    def is_free(a: np.ndarray, b: np.ndarray) -> bool:
        samples = line(a, b, int(np.linalg.norm(b - a) / 0.03) + 1)
        return bool(C.isValid(samples, margin=MARGIN).all() and C.isMotionFree(a[None], b[None], MARGIN)[0])

    trees = [([start], [-1]), ([goal], [-1])]
    for i in range(MOST):
        (here, parents), (there, parents_there) = trees[i % 2], trees[1 - i % 2]
        sample = rng.uniform(lower, upper)
        near = int(np.argmin(np.linalg.norm(np.array(here) - sample, axis=1)))
        way = sample - here[near]
        new = here[near] + way * min(1, 0.7 / np.linalg.norm(way))
        if not is_free(here[near], new):
            continue
        here.append(new)
        parents.append(near)
        at = int(np.argmin(np.linalg.norm(np.array(there) - new, axis=1)))
        if not is_free(there[at], new):
            continue
        path = branch(here, parents) + branch(there, parents_there, at)[::-1]
        path = path if i % 2 == 0 else path[::-1]
        for _ in range(60):
            a, b = sorted(rng.integers(0, len(path), 2))
            if b > a + 1 and is_free(path[a], path[b]):
                path = path[: a + 1] + path[b:]
        return np.array(path)
    return None


def resampled(path: np.ndarray, count: int) -> np.ndarray:
    along = np.concatenate([[0], np.linalg.norm(np.diff(path, axis=0), axis=1).cumsum()])
    at = np.linspace(0, along[-1], count + 1)[1:]
    return np.column_stack([np.interp(at, along, column) for column in path.T])


def make_komo(C: ry.Config, goal: np.ndarray, slices: int, at_all_times: bool) -> ry.KOMO:
    komo = ry.KOMO(C, 1, slices, 2, False)
    komo.addControlObjective([], 1, 0.1)
    komo.addControlObjective([], 2, 0.01)
    komo.addObjective([], ry.FS.jointLimits, [], ry.OT.ineq, [1.0])
    if at_all_times:
        komo.addFreeMotion(margin=MARGIN)
    else:
        komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0])
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [10.0], goal)
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [1.0], [], order=1)
    return komo


def is_truly_free(C: ry.Config, rows: np.ndarray) -> bool:
    dense = [line(a, b, int(np.abs(b - a).max() / STEP) + 1) for a, b in itertools.pairwise(rows)]
    limits = C.getJointLimits()  # the solver respects limits to 1e-4 rad; they are not measured here
    return bool(C.isValid(np.clip(np.vstack(dense), limits[0], limits[1])).all())


def solve(komo: ry.KOMO, points: int) -> tuple[ry.SolverReturn, np.ndarray]:
    """Returns the result, and rows of its motion from the start on, nearly straight between rows."""
    if points == 0:
        result = ry.NLP_Solver(komo.nlp()).solve()
        return result, np.vstack([komo.getConfiguration(-1).getJointState(), komo.getPath()])
    motion = ry.SplineMotion(komo, points)
    result = ry.NLP_Solver(motion.nlp()).solve()
    return result, motion.spline().eval(np.linspace(0, 1, 2000))


def measure(name: str, start_with: str, options: argparse.Namespace) -> None:
    rng = np.random.default_rng(options.seed)
    kinds = {"in slices only": False, "at all times": True}
    feasible, told, true, wrong = (dict.fromkeys(kinds, 0) for _ in range(4))
    seconds: dict[str, list[float]] = {kind: [] for kind in kinds}
    evaluations: dict[str, list[int]] = {kind: [] for kind in kinds}
    ratios, count = [], 0
    while count < options.problems:
        C, start, goal = among_obstacles(name, rng)
        path = np.array([start, goal]) if start_with == "line" else tree_path(C, start, goal, rng)
        if path is None:
            continue
        count += 1
        both_free = True
        for kind, at_all_times in kinds.items():
            begin = process_time()
            komo = make_komo(C, goal, options.slices, at_all_times)
            komo.initWithPath(resampled(path, options.slices))
            result, rows = solve(komo, options.spline)
            seconds[kind].append(process_time() - begin)
            evaluations[kind].append(result.evals)
            is_free = is_truly_free(C, rows)
            feasible[kind] += result.feasible
            told[kind] += bool(result.feasible and result.free)
            true[kind] += bool(result.feasible and is_free)
            wrong[kind] += bool(result.free and not is_free)
            both_free = both_free and result.feasible and is_free
        if both_free:
            ratios.append(seconds["at all times"][-1] / seconds["in slices only"][-1])
    points = f", {options.spline} control points" if options.spline else ""
    print(f"\n{name}, {count} problems, T = {options.slices}{points}, started with {start_with}")
    print(
        f"{'':16}{'feasible':>10}{'and free':>10}{'and truly':>11}{'free, wrongly':>15}{'ms':>8}{'p95':>8}{'evaluations':>13}"
    )
    for kind in kinds:
        ms = 1e3 * np.array(seconds[kind])
        row = f"{kind:16}{feasible[kind]:10}{told[kind]:10}{true[kind]:11}{wrong[kind]:15}"
        print(f"{row}{np.median(ms):8.1f}{np.percentile(ms, 95):8.1f}{np.median(evaluations[kind]):13.0f}")
    if ratios:
        print(
            f"where both are free, the time is {np.median(ratios):.2f} times that in slices only ({len(ratios)} problems)"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", nargs="+", default=["panda", "ur5"], choices=["panda", "ur5", "ur10"])
    parser.add_argument("--problems", type=int, default=100)
    parser.add_argument("--slices", type=int, default=32)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--spline", type=int, default=0, help="control points of a spline; 0: straight from slice to slice"
    )
    parser.add_argument("--start", nargs="+", default=["tree", "line"], choices=["tree", "line"])
    options = parser.parse_args()
    for name in options.robot:
        for start_with in options.start:
            measure(name, start_with, options)


if __name__ == "__main__":
    main()
