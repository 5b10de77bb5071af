"""How planMotion does on MotionBenchMaker.

    python benchmarks/planning.py [--robot panda] [--indices 1 2 3] [--seeds 0] [--tries 4] [--shapes meshes]
    python benchmarks/planning.py --indices $(seq 100) --seeds 0 1 2 3 4    # all of it

Says, for each kind of scene and for all: how many problems are solved, how many answers are truly free (an independent look: distances of all
pairs at postures every milliradian of the path, and every 5 ms of the timed motion), median and 95th percentile of the time of each stage, ms (`first` is the call
up to the first path; stages are wall time, `all` is processor time of the call but for the timing of the motion), the path's length as a multiple of the
straight line's, the motion's duration, s, and the path's least clearance, mm. Of each problem, times are the least of the rounds.
"""

import argparse
import itertools
import time

import motion_bench_maker
import numpy as np

import kinegraph as ry

STAGES = ["ends", "search", "shorten", "tighten", "verify", "time"]


def isFree(C, Q, tolerance=1e-9):
    """By a call that knows nothing of motions. Pairs whose distance never changes are of parts that no joint moves apart."""
    D = C.getDistances(Q)
    return bool((D[:, np.ptp(D, axis=0) > 1e-9] >= -tolerance).all())


def along(path, step=1e-3):
    """Postures of a polyline, every `step`."""
    rows = [path[:1]]
    for a, b in itertools.pairwise(path):
        count = max(1, int(np.ceil(np.linalg.norm(b - a) / step)))
        rows.append(a + (np.arange(1, count + 1) / count)[:, None] * (b - a))
    return np.concatenate(rows)


def timed(C, problem, options):
    """A plan, and what it took, ms."""
    wall, processor = time.perf_counter(), time.process_time()
    plan = ry.planMotion(C, problem.goal, problem.start, **options)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    times = {stage["name"]: 1e3 * stage["seconds"] for stage in plan.stages}
    later = sum(times.get(stage, 0.0) for stage in STAGES[2:])
    return plan, times | {"first": 1e3 * wall - later, "all": 1e3 * processor - times.get("time", 0.0)}


def ours(problem, options, rounds=1):
    C = problem.config()
    C.isValid([problem.start])  # compiles the scene
    runs = [timed(C, problem, options) for _ in range(rounds)]
    plan = runs[0][0]
    row = {
        "scene": problem.scene,
        "valid": bool(C.isValid([problem.start, problem.goal]).all()),
        "solved": plan.feasible,
        "message": plan.message,
    }
    row |= {key: min(times[key] for _, times in runs) for key in runs[0][1]}
    if plan.feasible:
        motion = np.array([plan.at(t)[0] for t in np.arange(0, plan.duration, 5e-3)])
        row["free"] = isFree(C, along(plan.path)) and isFree(C, motion)
        row["ratio"] = plan.length / np.linalg.norm(problem.goal - problem.start)
        row["duration"] = plan.duration
        row["clearance"] = 1e3 * plan.clearance()
    return row


def table(title, rows):
    solved = [row for row in rows if row["solved"]]
    print(f"\n{title}: {len(solved)} of {len(rows)} solved, {sum(row['free'] for row in solved)} truly free")
    for scene in [*motion_bench_maker.SCENES, "all"]:
        of = [row for row in rows if scene in (row["scene"], "all")]
        done = [row for row in of if row["solved"]]
        if not done:
            continue
        words = [f"{scene:17} {len(done):4}/{len(of):<4} free {100 * np.mean([row['free'] for row in done]):5.1f} %"]
        for key in ["first", *STAGES, "all"]:
            values = [row[key] for row in done if key in row]
            if values:
                words.append(f"{key} {np.median(values):.2f}/{np.percentile(values, 95):.1f}")
        for key, title in [("ratio", "length"), ("duration", "s"), ("clearance", "mm")]:
            words.append(f"{title} {np.median([row[key] for row in done]):.3f}")
        print("  ".join(words))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", choices=motion_bench_maker.ROBOTS, default="panda")
    parser.add_argument("--shapes", choices=["meshes", "spheres"], default="meshes")
    parser.add_argument("--scenes", nargs="+", choices=motion_bench_maker.SCENES, default=motion_bench_maker.SCENES)
    parser.add_argument("--indices", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--seeds", type=int, nargs="+", default=[0])
    parser.add_argument("--tries", type=int, default=4)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--margin", type=float, default=0.0)
    parser.add_argument("--optimize", default="length")
    arguments = parser.parse_args()
    robot = motion_bench_maker.Robot(arguments.robot, arguments.shapes)
    problems = list(robot.problems(arguments.scenes, arguments.indices))
    for seed in arguments.seeds:
        options = {"seed": seed, "tries": arguments.tries, "margin": arguments.margin, "optimize": arguments.optimize}
        rows = [ours(problem, options, arguments.rounds) for problem in problems]
        table(f"planMotion, {arguments.robot}, {arguments.shapes}, seed {seed}; ms, median/95th percentile", rows)
        for problem, row in zip(problems, rows, strict=True):
            if not row["solved"]:
                print(f"  {problem.scene} {problem.index}: {row['message']}")


if __name__ == "__main__":
    main()
