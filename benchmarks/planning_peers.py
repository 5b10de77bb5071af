"""Runs other planners on the problems of benchmarks/planning.py: `planning_peers.py NAME QUESTIONS.json`.

`vamp` (vamp-planner 0.6.4) is RRT-Connect with the settings of its own benchmark, and its simplification. Robots are
spheres. A cylinder is a capsule, or in the scene `box` a box, as in its own loader. `own clock` is its own report,
which starts after memory has been allocated. `mplib` (MPlib 0.2.1, scipy) is OMPL's RRTConnect and simplification over
FCL, with the convex hulls of the Panda's meshes. Times are processor times, ms; `first` is the call up to the first
path, `all` includes simplification. Answers are written to QUESTIONS.answers.
"""

import json
import shutil
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

RANGES = {"panda": 1.0, "ur5": 1.5, "fetch": 1.0}  # rad, from VAMP's own benchmark
HANDS = {"panda": "panda_hand", "ur5": "ee_link", "fetch": "gripper_link"}


def rotation(pose):
    w, x, y, z = pose[3:]
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def angles(R):
    """Returns the angles of R = Rz Ry Rx."""
    cosine = np.hypot(R[0, 0], R[1, 0])
    if cosine > 1e-9:
        return [np.arctan2(R[2, 1], R[2, 2]), np.arctan2(-R[2, 0], cosine), np.arctan2(R[1, 0], R[0, 0])]
    return [np.arctan2(-R[1, 2], R[1, 1]), np.arctan2(-R[2, 0], cosine), 0.0]


def vampWorld(vamp, problem):
    world = vamp.Environment()
    for kind, size, pose in problem["obstacles"]:
        place = [float(x) for x in pose[:3]], [float(x) for x in angles(rotation(pose))]
        if kind == "box":
            world.add_cuboid(vamp.Cuboid(*place, [0.5 * x for x in size[:3]]))
        elif problem["scene"] == "box":
            world.add_cuboid(vamp.Cuboid(*place, [size[1], size[1], 0.5 * size[0]]))
        else:
            world.add_capsule(vamp.Cylinder(*place, size[1], size[0]))
    return world


def withVamp(robot, problems):
    import vamp

    module = getattr(vamp, robot["name"])
    settings, simple = vamp.RRTCSettings(), vamp.SimplifySettings()
    settings.range = RANGES[robot["name"]]
    settings.max_iterations = settings.max_samples = 1000000
    for problem in problems:
        world = vampWorld(vamp, problem)
        valid = module.validate(problem["start"], world) and module.validate(problem["goal"], world)
        row = {"valid": bool(valid), "solved": False, "shapes": "spheres"}
        rng = module.halton()
        rng.reset()
        begin = time.process_time()
        found = module.rrtc(problem["start"], problem["goal"], world, settings, rng) if valid else None
        between = time.process_time()
        if found is not None and found.solved:
            short = module.simplify(found.path, world, simple, rng)
            both = time.process_time() - begin
            path = np.array(short.path.numpy()).tolist()
            row |= {"solved": True, "path": path, "first": 1e3 * (between - begin), "all": 1e3 * both}
            row |= {"call": row["all"], "own clock": 1e-6 * found.nanoseconds}
        yield row


def writeHull(file):
    """Writes the convex hull of an .obj as binary .stl, at the path that MPlib expects."""
    from scipy.spatial import ConvexHull

    points = np.array([line.split()[1:4] for line in file.read_text().splitlines() if line.startswith("v ")], float)
    hull = ConvexHull(points)
    triangles = np.zeros(len(hull.simplices), [("normal", "3<f4"), ("corners", "(3,3)<f4"), ("rest", "<u2")])
    outward = hull.equations[:, :3]
    corners = points[hull.simplices]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = np.einsum("ij,ij->i", across, outward) < 0
    corners[inward] = corners[inward][:, ::-1]
    triangles["normal"], triangles["corners"] = outward, corners
    header = bytes(80) + np.uint32(len(triangles)).tobytes()
    Path(f"{file}.convex.stl").write_bytes(header + triangles.tobytes())


def withMplib(robot, problems):
    import mplib
    import mplib.collision_detection.fcl as fcl

    with tempfile.TemporaryDirectory() as folder:
        source, name = Path(robot["folder"]), robot["name"]
        shutil.copytree(source / "meshes", Path(folder) / "meshes")
        for file in (Path(folder) / "meshes" / "collision").glob("*.obj"):
            writeHull(file)
        (Path(folder) / "robot.urdf").write_text((source / f"{name}.urdf").read_text().replace("package://", ""))
        shutil.copy(source / f"{name}.srdf", Path(folder) / "robot.srdf")
        files = str(Path(folder) / "robot.urdf"), HANDS[name]
        planner = mplib.Planner(*files, srdf=str(Path(folder) / "robot.srdf"), use_convex=True)
    for problem in problems:
        for i, (kind, size, pose) in enumerate(problem["obstacles"]):
            shape = fcl.Box(*size[:3]) if kind == "box" else fcl.Cylinder(size[1], size[0])
            at = np.eye(4)
            at[:3, :3], at[:3, 3] = rotation(pose), pose[:3]
            planner.planning_world.add_object(str(i), fcl.CollisionObject(shape, mplib.Pose(at)))
        start, goal = np.array(problem["start"]), np.array(problem["goal"])
        row = {"shapes": "meshes", "solved": False, "valid": True}
        for q in (start, goal):
            planner.robot.set_qpos(planner.pad_move_group_qpos(q), True)
            row["valid"] &= len(planner.planning_world.check_collision()) == 0
        if row["valid"]:
            planner.robot.set_qpos(planner.pad_move_group_qpos(start), True)
            question = {"start_state": start, "goal_states": [goal], "time": 20.0, "range": 1.0}
            begin = time.process_time()
            status, _ = planner.planner.plan(**question, simplify=False)
            between = time.process_time()
            row |= {"call": 1e3 * (between - begin), "first": 1e3 * (between - begin)}
            if status == "Exact solution":
                status, path = planner.planner.plan(**question, simplify=True)
                row |= {"solved": status == "Exact solution", "all": 1e3 * (time.process_time() - between)}
                row |= {"path": np.array(path).tolist()}
        for i in range(len(problem["obstacles"])):
            planner.planning_world.remove_object(str(i))
        yield row


def main():
    name, file = sys.argv[1], Path(sys.argv[2])
    asked = json.loads(file.read_text())
    rows = list({"vamp": withVamp, "mplib": withMplib}[name](asked["robot"], asked["problems"]))
    file.with_suffix(".answers").write_text(json.dumps(rows))


if __name__ == "__main__":
    main()
