"""Runs other packages on the problems of families a to d: roboplan, MPlib, and Descartes of tesseract-robotics.

    pip install roboplan==0.7.0 mplib==0.2.1 tesseract-robotics==0.5.1

Each gets the scene as a URDF file without shapes. roboplan and MPlib get the start configuration of the certificate,
too: they do not look for one. Descartes finds a branch itself, by the closed form of UR arms; other arms are left out.
Its motion has no times: the time parameterizations of the package cannot be called from Python. A function takes a
problem and its scene, and returns times and joint values, or None, and the processor time.
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


def rotation_angles(R):
    """Roll, pitch and yaw of a rotation matrix."""
    return np.arctan2(R[2, 1], R[2, 2]), np.arcsin(np.clip(-R[2, 0], -1, 1)), np.arctan2(R[1, 0], R[0, 0])


def ur10_end(q):
    """The pose of the last frame of a UR10 by its Denavit-Hartenberg parameters, as its closed form has it."""
    T = np.diag([-1.0, -1.0, 1.0, 1.0])
    lengths_along = [0.1273, 0.0, 0.0, 0.163941, 0.1157, 0.0922]
    lengths_across = [0.0, -0.612, -0.5723, 0.0, 0.0, 0.0]
    twists = [np.pi / 2, 0.0, 0.0, np.pi / 2, -np.pi / 2, 0.0]
    for angle, d, a, twist in zip(q, lengths_along, lengths_across, twists, strict=True):
        c, s, ct, st = np.cos(angle), np.sin(angle), np.cos(twist), np.sin(twist)
        T = T @ [[c, -s * ct, s * st, a * c], [s, c * ct, -c * st, a * s], [0, st, ct, d], [0, 0, 0, 1]]
    return T


def homogeneous(pose):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = matrix(pose[None, 3:])[0], pose[:3]
    return T


def tesseract_scene(C, folder):
    """An environment of tesseract with the closed form of a UR10, and the pose of its end in the frame of the tool."""
    import tesseract_robotics
    from tesseract_robotics.tesseract_common import GeneralResourceLocator
    from tesseract_robotics.tesseract_environment import Environment

    q = C.getJointState()
    to_end = np.linalg.inv(homogeneous(C.getFrame("tool").getPose())) @ ur10_end(q)
    text, rpy = urdf(C), rotation_angles(to_end)
    origin = f'xyz="{" ".join(map(str, to_end[:3, 3]))}" rpy="{" ".join(map(str, rpy))}"'
    joint = f'<parent link="tool"/><child link="end"/><origin {origin}/>'
    text = text.replace("</robot>", f'<link name="end"/><joint name="to_end" type="fixed">{joint}</joint></robot>')
    base, libraries = root_link(text), Path(tesseract_robotics.__path__[0]).parent / "tesseract_robotics.libs"
    needed = ("tesseract_kinematics_ur_factory", "tesseract_kinematics_kdl_factories")
    files = [next(libraries.glob(f"lib{name}-*")).name[3:].removesuffix(".so") for name in needed]
    chain = f"base_link: {base}, tip_link: end"

    def solver(kind, name, settings):
        plugin = f"{name}: {{class: {name}Factory, config: {{{settings}}}}}"
        return f"  {kind}:\n    arm:\n      default: {name}\n      plugins:\n        {plugin}\n"

    plugins = Path(folder) / "plugins.yaml"
    plugins.write_text(
        f"kinematic_plugins:\n  search_paths: [{libraries}]\n  search_libraries: [{', '.join(files)}]\n"
        + solver("fwd_kin_plugins", "KDLFwdKinChain", chain)
        + solver("inv_kin_plugins", "URInvKin", f"{chain}, model: UR10")
    )
    group = f'<group name="arm"><chain base_link="{base}" tip_link="end"/></group>'
    settings = f'{group}<kinematics_plugin_config filename="{plugins}"/>'
    name = ET.fromstring(text).get("name")
    environment = Environment()
    environment.init(text, f'<robot name="{name}" version="1.0.0">{settings}</robot>', GeneralResourceLocator())
    return environment, base, to_end


def descartes(problem, C):
    """A ladder graph over a pose every 5 mm; the times are those of the speed asked, without ramps."""
    if problem["robot"] != "ur10":
        return None, 0.0
    from tesseract_robotics import tesseract_command_language as commands
    from tesseract_robotics.tesseract_common import Isometry3d, ManipulatorInfo
    from tesseract_robotics.tesseract_motion_planners import PlannerRequest
    from tesseract_robotics.tesseract_motion_planners_descartes import (
        DescartesDefaultPlanProfileD,
        DescartesMotionPlannerD,
        cast_DescartesPlanProfileD,
    )

    with tempfile.TemporaryDirectory() as folder:
        environment, base, to_end = tesseract_scene(C, folder)
    arm = ManipulatorInfo()
    arm.manipulator, arm.working_frame, arm.tcp_frame, arm.manipulator_ik_solver = "arm", base, "end", "URInvKin"
    program = commands.CompositeInstruction("DEFAULT")
    program.setManipulatorInfo(arm)
    poses = poses_of(problem)
    for pose in poses:
        waypoint = commands.CartesianWaypointPoly_wrap_CartesianWaypoint(
            commands.CartesianWaypoint(Isometry3d(pose @ to_end))
        )
        move = commands.MoveInstruction(waypoint, commands.MoveInstructionType_LINEAR, "DEFAULT")
        program.appendMoveInstruction(commands.MoveInstructionPoly_wrap_MoveInstruction(move))
    profile = DescartesDefaultPlanProfileD()
    profile.allow_collision, profile.enable_collision, profile.enable_edge_collision = True, False, False
    profiles = commands.ProfileDictionary()
    profiles.addProfile("Descartes", "DEFAULT", cast_DescartesPlanProfileD(profile))
    request = PlannerRequest()
    request.instructions, request.env, request.profiles = program, environment, profiles
    planner = DescartesMotionPlannerD("Descartes")
    begin = process_time()
    response = planner.solve(request)
    ms = 1e3 * (process_time() - begin)
    if not response.successful:
        return None, ms
    moves = [commands.InstructionPoly_as_MoveInstructionPoly(move) for move in response.results.flatten()]
    states = [commands.WaypointPoly_as_StateWaypointPoly(move.getWaypoint()) for move in moves]
    order = [list(states[0].getNames()).index("j_" + name) for name in C.getJointNames()]
    Q = np.array([np.ravel(state.getPosition())[order] for state in states])
    length = lengths(problem["paths"][0])[-1]
    return (np.linspace(0, length / problem["speed"], len(Q)), Q), ms


PEERS = {"roboplan": roboplan, "mplib": mplib, "descartes": descartes}
UNTIMED = {"descartes"}  # their times are made up
