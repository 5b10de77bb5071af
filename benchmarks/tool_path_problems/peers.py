"""Runs other packages on the problems of families a to d: roboplan, MPlib.

    pip install roboplan==0.7.0 mplib==0.2.1

Each gets the scene as a URDF file without shapes, and the start configuration of the certificate: none of them looks
for one. A function takes a problem and its scene, and returns times and joint values, or None, and the processor time.

tesseract-robotics 0.5.1 is not among them: its Descartes planner needs plugin files for the kinematics of each arm, and
its time parameterization cannot be called from Python.
"""

import tempfile
import warnings
import xml.etree.ElementTree as ET
from pathlib import Path
from time import process_time

import numpy as np

from tool_path_problems.curves import at, lengths, matrix

STEP = 5e-3  # m between the poses that planners get


def urdf(C):
    """The kinematics of a scene as URDF text: joint J of q is named j_J, and the others are fixed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        root = ET.fromstring(C.writeURDF())
    names = set(C.getJointNames())
    for link in root.iter("link"):
        for part in ("visual", "collision"):
            for shape in link.findall(part):
                link.remove(shape)
    for joint in root.iter("joint"):
        joint.set("name", "j_" + joint.get("name"))
        if joint.get("name")[2:] in names:
            continue
        joint.set("type", "fixed")
        for part in ("axis", "limit", "mimic", "dynamics"):
            for element in joint.findall(part):
                joint.remove(element)
    return ET.tostring(root, encoding="unicode")


def root_link(text):
    root = ET.fromstring(text)
    children = {joint.find("child").get("link") for joint in root.iter("joint")}
    return next(link.get("name") for link in root.iter("link") if link.get("name") not in children)


def poses_of(problem):
    """Homogeneous poses along the path, STEP apart."""
    rows = problem["paths"][0]
    S = lengths(rows)
    P = at(rows, S, np.linspace(0, S[-1], max(2, int(np.ceil(S[-1] / STEP)) + 1)))
    T = np.tile(np.eye(4), (len(P), 1, 1))
    T[:, :3, :3], T[:, :3, 3] = matrix(P[:, 3:]), P[:, :3]
    return T


def resampled(t, Q):
    """Even steps of 1 ms, by cubic Hermite pieces through samples and their differences."""
    t, Q = np.asarray(t), np.asarray(Q)
    keep = np.r_[True, np.diff(t) > 1e-9]
    t, Q = t[keep], Q[keep]
    times = np.arange(t[0], t[-1], 1e-3)
    slope = np.gradient(Q, t, axis=0)
    k = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 2)
    h = (t[k + 1] - t[k])[:, None]
    u = (times - t[k])[:, None] / h
    return times, (
        (1 + 2 * u) * (1 - u) ** 2 * Q[k]
        + u * (1 - u) ** 2 * h * slope[k]
        + u * u * (3 - 2 * u) * Q[k + 1]
        + u * u * (u - 1) * h * slope[k + 1]
    )


def roboplan(problem, C):
    """Cartesian planner in its mode "bounded"."""
    from roboplan import cartesian_planning, core

    text = urdf(C)
    scene = core.Scene("scene", core.loadUrdfSceneDescriptionFromXml(text))
    names = ["j_" + name for name in C.getJointNames()]
    base = root_link(text)
    scene.addGroup("arm", names)
    options = cartesian_planning.CartesianPlannerOptions(
        group_name="arm", max_linear_speed=problem["speed"], max_linear_acceleration=2.0
    )
    planner = cartesian_planning.CartesianPathPlanner(scene, options)
    path = core.CartesianPath([base], ["tool"], [list(poses_of(problem))])
    start = np.array(problem["certificate"][0])
    scene.setJointPositions(start)
    begin = process_time()
    try:
        motion = planner.plan(path, core.JointConfiguration(names, start))
    except RuntimeError:
        return None, 1e3 * (process_time() - begin)
    ms = 1e3 * (process_time() - begin)
    return (np.array(motion.times), np.array(motion.positions)), ms


def mplib(problem, C):
    """plan_screw, for straight lines."""
    if problem["family"] not in "abc":
        return None, 0.0
    from mplib import Planner, Pose

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.urdf"
        file.write_text(urdf(C))
        (Path(folder) / "scene.srdf").write_text(f'<robot name="{ET.fromstring(urdf(C)).get("name")}"/>')
        names = ["j_" + name for name in C.getJointNames()]
        planner = Planner(
            str(file),
            "tool",
            srdf=str(Path(folder) / "scene.srdf"),
            user_joint_names=names,
            joint_vel_limits=np.array(C.getVelocityLimits()),
            joint_acc_limits=np.full(len(names), 6.0),
        )
    end = problem["paths"][0][-1]
    begin = process_time()
    result = planner.plan_screw(Pose(end[:3], end[3:]), np.array(problem["certificate"][0]), time_step=0.01)
    ms = 1e3 * (process_time() - begin)
    if result["status"] != "Success":
        return None, ms
    return (result["time"], result["position"]), ms


PEERS = {"roboplan": roboplan, "mplib": mplib}
