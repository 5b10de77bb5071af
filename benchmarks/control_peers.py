"""Runs the loops of benchmarks/control.py with mink, pink and placo: `control_peers.py NAME SCENE.json`.

The Panda is that of panda_peers.py. All use a 6D task of weight 1, a posture task of cost 1e-2 (placo: 1e-4 of the
square), damping 1e-6, limits of position and velocity, and pairs at least 10 mm apart (placo: no pairs). Prints
processor times of each step as JSON.
"""

import json
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import panda_peers

DT = 0.005


def target(kind, home, t):
    """Returns the position of the target: a figure of eight, a circle through the table, or a path out of reach; about
    0.3 m/s.
    """
    if kind == "free":
        return home + np.array([0.2 * np.sin(1.5 * t), 0, 0.1 * np.sin(3 * t)])
    if kind == "dip":
        turn = 0.3 / 0.33 * t
        return np.array([0.25 * np.sin(turn), home[1] + 0.1, 0.95 + 0.33 * np.cos(turn)])
    return home + np.array([0.6 * np.sin(0.5 * t), 0.3 * np.sin(0.5 * t), 0])


def minkStep(scene, q):
    import mink
    import mujoco

    model = mujoco.MjModel.from_xml_string(panda_peers.mujocoText(scene))
    model.jnt_limited[:] = 1
    model.jnt_range[:] = np.array(scene["limits"]).T
    ids = [tuple(sorted((model.geom(a).id, model.geom(b).id))) for a, b in scene["pairs"]]

    class Avoid(mink.CollisionAvoidanceLimit):
        def _construct_geom_id_pairs(self, _):
            return ids

    state = mink.Configuration(model)
    state.update(q)
    frame = mink.FrameTask("tip", "body", position_cost=1.0, orientation_cost=1.0, lm_damping=0.0)
    posture = mink.PostureTask(model, cost=1e-2)
    posture.set_target(q)
    rotation = state.get_transform_frame_to_world("tip", "body").rotation()
    fastest = {joint["name"]: v for joint, v in zip(scene["joints"], scene["velocity"])}
    limits = [
        mink.ConfigurationLimit(model),
        mink.VelocityLimit(model, fastest),
        Avoid(model, [], minimum_distance_from_collisions=0.01, collision_detection_distance=0.1, gain=0.85),
    ]

    def step(position):
        frame.set_target(mink.SE3.from_rotation_and_translation(rotation, position))
        velocity = mink.solve_ik(state, [frame, posture], DT, "daqp", damping=1e-6, limits=limits)
        state.integrate_inplace(velocity, DT)
        return state.q

    return step


def pinkStep(scene, q, pairs=10):
    import pink
    import pinocchio as pin
    from pink.barriers import SelfCollisionBarrier

    model, _, geometry = panda_peers.pinocchioModels(scene)
    model.lowerPositionLimit, model.upperPositionLimit = map(np.array, scene["limits"])
    model.velocityLimit = np.array(scene["velocity"])
    state = pink.Configuration(
        model, model.createData(), q, collision_model=geometry, collision_data=pin.GeometryData(geometry)
    )
    frame = pink.tasks.FrameTask("tip", position_cost=1.0, orientation_cost=1.0, lm_damping=0.0)
    posture = pink.tasks.PostureTask(cost=1e-2)
    posture.set_target(q)
    rotation = state.get_transform_frame_to_world("tip").rotation.copy()
    barriers = [SelfCollisionBarrier(pairs, gain=20.0, safe_displacement_gain=0.0, d_min=0.01)]

    def step(position):
        frame.set_target(pin.SE3(rotation, position))
        velocity = pink.solve_ik(
            state, [frame, posture], DT, "daqp", damping=1e-6, barriers=barriers, safety_break=False
        )
        state.integrate_inplace(velocity, DT)
        return state.q

    return step


def urdf(scene):
    text = lambda numbers: " ".join(f"{number:.17g}" for number in numbers)  # noqa: E731
    weight = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    lines = ["<robot name='panda'>", f"<link name='base'>{weight}</link>"]
    for i, joint in enumerate(scene["joints"]):
        above = "base" if joint["parent"] < 0 else f"link{joint['parent']}"
        place = text(panda_peers.offset(scene, joint["parent"], joint["position"]))
        low, high = scene["limits"][0][i], scene["limits"][1][i]
        lines.append(
            f"<link name='link{i}'>{weight}</link><joint name='{joint['name']}' type='revolute'><parent link='{above}'/>"
            f"<child link='link{i}'/><origin xyz='{place}'/><axis xyz='{text(joint['axis'])}'/>"
            f"<limit lower='{low}' upper='{high}' velocity='{scene['velocity'][i]}' effort='100'/></joint>"
        )
    link = scene["tip"]["link"]
    place = text(panda_peers.offset(scene, link, scene["tip"]["position"]))
    lines.append(
        f"<link name='tip'/><joint name='tip_joint' type='fixed'><parent link='link{link}'/><child link='tip'/>"
        f"<origin xyz='{place}'/></joint></robot>"
    )
    return "\n".join(lines)


def placoStep(scene, q):
    import placo

    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "robot.urdf").write_text(urdf(scene))
        robot = placo.RobotWrapper(folder, placo.Flags.ignore_collisions)
    solver = placo.KinematicsSolver(robot)
    solver.mask_fbase(True)
    names = [joint["name"] for joint in scene["joints"]]
    for name, value in zip(names, q):
        robot.set_joint(name, value)
    robot.update_kinematics()
    pose = robot.get_T_world_frame("tip").copy()
    frame = solver.add_frame_task("tip", pose)
    frame.configure("tip", "soft", 1.0, 1.0)
    posture = solver.add_joints_task()
    posture.set_joints(dict(zip(names, map(float, q))))
    posture.configure("posture", "soft", 1e-4)
    solver.enable_joint_limits(True)
    solver.enable_velocity_limits(True)
    solver.dt = DT
    solver.add_regularization_task(1e-6)

    def step(position):
        pose[:3, 3] = position
        frame.T_world_frame = pose
        solver.solve(True)
        robot.update_kinematics()
        return [robot.get_joint(name) for name in names]

    return step


STEPS = {"mink": minkStep, "pink": pinkStep, "placo": placoStep}


def main():
    name, file = sys.argv[1:]
    scene = json.loads(Path(file).read_text())
    q, home = np.array(scene["q"]), np.array(scene["home"])
    step = STEPS[name](scene, q)
    seconds, path = [], []
    for i in range(scene["steps"]):
        position = target(scene["loop"], home, (i + 1) * DT)
        begun = time.thread_time()
        q = step(position)
        seconds.append(time.thread_time() - begun)
        path.append(list(map(float, q)))
    print(json.dumps({"seconds": seconds, "path": path}))


if __name__ == "__main__":
    main()
