"""Measures planMotion on MotionBenchMaker, and compares it with VAMP and OMPL.

    python benchmarks/planning.py [--robot panda] [--indices 1 2 3] [--seeds 0] [--restarts 4] [--shapes meshes]
    python benchmarks/planning.py --all --seeds 0 1 2 3 4  # all problems
    python benchmarks/planning.py --all --beside vamp=PYTHON mplib=PYTHON  # and other planners, in a Python with them

For each kind of scene and for all, it prints these figures. Times of a problem are the least of the rounds.

- The number of solved problems, and of those solved within a second of processor time.
- The number of answers that are truly collision-free: an independent check of the path and of configurations every 5 ms
  of the timed motion, see `leastDistance`.
- Median and 95th percentile of the time of each stage, ms. `first` is the call up to the first path. Stages are wall
  times; `all` is processor time of the call without the timing of the motion.
- The length of the path as a multiple of the straight line, the duration of the motion, s, and the least clearance, mm.

Other planners get the same problems (see planning_peers.py). Their answers are checked in the same way, with the meshes
of the robot and with the shapes of the planner.
"""

import argparse
import itertools
import json
import subprocess
import tempfile
import time
import warnings
from pathlib import Path

import motion_bench_maker
import numpy as np

import kinegraph as ry

STAGES = ["endpoints", "search", "shortcut", "rope_shortcut", "verify", "timing"]
REACH = 1.5  # m/rad: of these robots, no joint moves a point faster
STEP = 1e-3  # rad or m: least step between checked configurations


class Look:
    """Checks paths of one scene by a call that knows nothing of motions: distances of all pairs at configurations.

    Between two configurations no pair comes nearer than half of its distances at both, less the motion of its joints.
    If this bound is insufficient, a configuration between them is checked, until they are a milliradian apart. Pairs of
    constant distance belong to parts that no joint moves apart, and do not count.
    """

    def __init__(self, C):
        self.C = C
        lower, upper = C.getJointLimits()
        random = np.random.default_rng(0).uniform(lower, upper, (16, len(lower)))
        self.moves = np.ptp(C.getDistances(random), axis=0) > 1e-9

    def distances(self, Q):
        return self.C.getDistances(Q)[:, self.moves].min(axis=1)

    def leastDistance(self, path):
        """Returns the least distance of all checked configurations of the path, m; ends early if it is negative."""
        a, b = path[:-1], path[1:]
        least = self.distances(path)
        of_a, of_b, least = least[:-1], least[1:], least.min()
        while least >= 0 and len(a):
            change = b - a
            rests = (of_a + of_b >= REACH * np.abs(change).sum(axis=1)) | (np.linalg.norm(change, axis=1) <= STEP)
            a, b, of_a, of_b = a[~rests], b[~rests], of_a[~rests], of_b[~rests]
            if not len(a):
                break
            middle = 0.5 * (a + b)
            of_middle = self.distances(middle)
            least = min(least, of_middle.min())
            a, b = np.concatenate([a, middle]), np.concatenate([middle, b])
            of_a, of_b = np.concatenate([of_a, of_middle]), np.concatenate([of_middle, of_b])
        return least

    def isFree(self, path, tolerance=1e-9):
        return bool(self.leastDistance(path) >= -tolerance)


def timed(C, problem, options):
    """Returns a plan and its times, ms."""
    wall, processor = time.perf_counter(), time.process_time()
    plan = ry.planMotion(C, problem.goal, problem.start, **options)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    times = {stage["name"]: 1e3 * stage["seconds"] for stage in plan.stages}
    later = sum(times.get(stage, 0.0) for stage in [*STAGES[2:], "smoothing"])
    own = {"first": 1e3 * wall - later, "call": 1e3 * processor, "all": 1e3 * processor - times.get("timing", 0.0)}
    return plan, times | own


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
        look = Look(C)
        motion = np.array([plan.eval(t)[0] for t in np.arange(0, plan.duration, 5e-3)])
        row["free"] = look.isFree(plan.path) and look.isFree(motion)
        row["ratio"] = plan.length / np.linalg.norm(problem.goal - problem.start)
        row["duration"] = plan.duration
        row["clearance"] = 1e3 * plan.clearance()
    if plan.feasible and options.get("slices"):
        row["faster"] = (
            plan.duration / ry.planMotion(C, problem.goal, problem.start, **options | {"slices": 0}).duration
        )
    return row


def length(path):
    return float(sum(np.linalg.norm(b - a) for a, b in itertools.pairwise(path)))


def others(name, python, robots, problems):
    """Returns the rows of another planner, which runs in a Python of its own."""
    pose = lambda frame: frame.getPose().tolist()  # noqa: E731
    questions = []
    for problem in problems:
        frames = [f for f in problem.config().getFrames() if f.name.startswith("obstacle ")]
        obstacles = [[str(f.getShapeType()).split(".")[-1], f.getSize().tolist(), pose(f)] for f in frames]
        ends = {"start": problem.start.tolist(), "goal": problem.goal.tolist()}
        questions.append({"scene": problem.scene, "obstacles": obstacles} | ends)
    robot = {
        "name": problems[0].robot.name,
        "folder": str(problems[0].robot.folder),
        "joints": problems[0].robot.joints,
    }
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "questions.json"
        file.write_text(json.dumps({"robot": robot, "problems": questions}))
        model = Path(__file__).with_name("planning_peers.py")
        subprocess.run([python, model, name, file], check=True)
        rows = json.loads(file.with_suffix(".answers").read_text())
    for problem, row in zip(problems, rows, strict=True):
        row["scene"] = problem.scene
        if not row["solved"]:
            continue
        path = np.array(row["path"])
        path[0], path[-1] = problem.start, problem.goal  # single precision
        looks = {shapes: Look(problem.config(robot)).leastDistance(path) for shapes, robot in robots.items()}
        row |= {
            "free": looks["meshes"] >= -1e-9,
            "own": looks[row["shapes"]] >= -1e-9,
            "depth": -1e3 * min(looks[row["shapes"]], 0),
            "ratio": length(path) / np.linalg.norm(problem.goal - problem.start),
        }
    return rows


def table(title, rows):
    solved = [row for row in rows if row["solved"]]
    count = lambda key: sum(bool(row.get(key)) for row in rows)  # noqa: E731
    soon = sum(row.get("call", 0) < 1e3 for row in solved)
    words = [
        f"{len(rows)} problems",
        f"{count('valid')} with valid ends",
        f"{len(solved)} solved",
        f"{soon} within 1 s",
    ]
    words.append(f"{count('free')} truly free")
    if any("own" in row for row in rows):
        deepest = max(row["depth"] for row in solved)
        words.append(f"{count('own')} by the shapes of that planner, to {deepest:.1f} mm deep")
    print(f"\n{title}: {', '.join(words)}")
    for scene in [*motion_bench_maker.SCENES, "all"]:
        of = [row for row in rows if scene in (row["scene"], "all")]
        done = [row for row in of if row["solved"]]
        if not done:
            continue
        words = [f"{scene:17} {len(done):4}/{len(of):<4} free {100 * np.mean([row['free'] for row in done]):5.1f} %"]
        for key in ["first", *STAGES, "smoothing", "own clock", "all"]:
            values = [row[key] for row in done if key in row]
            if values:
                words.append(f"{key} {np.median(values):.3g}/{np.percentile(values, 95):.3g}")
        for key, unit in [("ratio", "length"), ("duration", "s"), ("clearance", "mm")]:
            values = [row[key] for row in done if key in row]
            if values:
                words.append(f"{unit} {np.median(values):.3f}")
        ratios = [row["faster"] for row in done if "faster" in row]
        if ratios:
            words.append(f"duration / without KOMO {np.mean(ratios):.3f} (mean)")
        print("  ".join(words), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", choices=motion_bench_maker.ROBOTS, default="panda")
    parser.add_argument("--shapes", choices=["meshes", "spheres"], default="meshes")
    parser.add_argument("--scenes", nargs="+", choices=motion_bench_maker.SCENES, default=motion_bench_maker.SCENES)
    parser.add_argument("--indices", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--all", action="store_true", help="all 100 problems of each scene")
    parser.add_argument("--seeds", type=int, nargs="*", default=[0])
    parser.add_argument("--restarts", type=int, default=4)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--margin", type=float, default=0.0)
    parser.add_argument("--optimize", default="length")
    parser.add_argument("--slices", type=int, default=0, help="slices of KOMO as a further stage, with --optimize time")
    parser.add_argument("--beside", nargs="+", default=[], metavar="NAME=PYTHON")
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore", ".*at a constant relative pose")  # tables touch their legs
    robot = motion_bench_maker.Robot(arguments.robot, arguments.shapes)
    indices = range(1, 101) if arguments.all else arguments.indices
    problems = list(robot.problems(arguments.scenes, indices))
    everything = []
    names = ["restarts", "margin", "optimize", "slices", "threads"]
    for seed in arguments.seeds:
        options = {name: getattr(arguments, name) for name in names} | {"seed": seed}
        rows = [ours(problem, options, arguments.rounds) for problem in problems]
        everything += rows
        table(f"planMotion, {arguments.robot}, {arguments.shapes}, seed {seed}; ms, median/95th percentile", rows)
        for problem, row in zip(problems, rows, strict=True):
            if not row["solved"] or not row["free"]:
                why = "not free" if row["valid"] else "not free, since it begins or ends in contact"
                print(f"  {problem.scene} {problem.index}: {row['message'] or why}")
    if len(arguments.seeds) > 1:
        table(f"planMotion, {arguments.robot}, {arguments.shapes}, {len(arguments.seeds)} seeds", everything)
    both = {shapes: motion_bench_maker.Robot(arguments.robot, shapes) for shapes in ["meshes", "spheres"]}
    for name, python in (item.split("=") for item in arguments.beside):
        table(f"{name}, {arguments.robot}", others(name, python, both, problems))


if __name__ == "__main__":
    main()
