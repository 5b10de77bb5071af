"""Records poses that Pinocchio computes, for test_robots.py: python tests/python/record_robots.py FOLDER_OF_ROBOTS

FOLDER_OF_ROBOTS is .../share/example-robot-data/robots of the package example-robot-data 6.0.0; needs the packages pin
and kinegraph.
"""

import json
import sys
import warnings
from pathlib import Path

import numpy as np
import pinocchio as pin

import kinegraph as ry
from pinocchio_poses import Comparison, jointFrame

DATA = Path(__file__).parent.parent / "data" / "robots_pinocchio.json"
ROBOTS = [
    *("panda_description/urdf/panda", "ur_description/urdf/ur5_robot", "kinova_description/robots/kinova"),
    *("xarm_description/urdf/xarm7", "pr2_description/urdf/pr2", "tiago_description/robots/tiago"),
    *("talos_data/robots/talos_full_v2", "romeo_description/urdf/romeo", "icub_description/robots/icub"),
    *("baxter_description/urdf/baxter", "anymal_c_simple_description/urdf/anymal", "human_description/robots/human"),
    *("g1_description/urdf/g1_29dof_rev_1_0", "solo_description/robots/solo12", "iris_description/robots/iris"),
    *("allegro_hand_description/urdf/allegro_right_hand", "so_arm_description/urdf/so101"),
    *("double_pendulum_description/urdf/double_pendulum_continuous", "hyq_description/robots/hyq_no_sensors"),
]


def record(file: Path) -> dict:
    config = ry.Config()
    config.addFile(file)
    comparison = Comparison(str(file), config, seed=0)
    model, data = comparison.model, comparison.data
    pin.forwardKinematics(model, data, comparison.drawState())
    q = {}
    for joint in config.getJoints():
        if not joint.asDict().get("mimic"):
            q[joint.name] = np.round(joint.getJointState(), 11).tolist()
    poses = {}
    for i, name in list(enumerate(model.names))[1:]:
        rotation = pin.Quaternion(data.oMi[i].rotation)
        numbers = [*data.oMi[i].translation, rotation.w, rotation.x, rotation.y, rotation.z]
        poses[jointFrame(config, name)] = np.round(numbers, 11).tolist()
    return {"q": q, "poses": poses}


DYNAMIC = ["panda_description/urdf/panda", "ur_description/urdf/ur5_robot", "icub_description/robots/icub"]


def recordDynamics(file: Path) -> list[dict]:
    """Forces of some motions by joint; a joint that mimics another counts for that one."""
    config = ry.Config()
    config.addFile(file)
    comparison = Comparison(str(file), config, seed=1)
    model, data, mimics = comparison.model, comparison.data, comparison.mimics
    owners = {}  # joint -> (the joint whose dof moves it, factor)
    for name in list(model.names)[1:]:
        owner, factor = name, 1.0
        while owner in mimics:
            factor *= mimics[owner][1]
            owner = mimics[owner][0]
        owners[name] = (jointFrame(config, owner), factor)
    frames = list(dict.fromkeys(frame for frame, _ in owners.values()))
    projection = np.zeros((model.nv, len(frames)))
    for name, joint in zip(list(model.names)[1:], model.joints[1:]):
        frame, factor = owners[name]
        projection[joint.idx_v, frames.index(frame)] = factor
    motions = []
    for _ in range(3):
        q = comparison.drawState()
        speed, push = np.round(comparison.random.normal(size=(2, len(frames))), 3)
        v, a = projection @ speed, projection @ push
        force = projection.T @ pin.rnea(model, data, q, v, a)
        bias = projection.T @ pin.rnea(model, data, q, v, 0 * a)
        center = pin.centerOfMass(model, data, q)
        state = [config.getJointState([frame])[0] for frame in frames]
        columns = {"q": state, "velocity": speed, "acceleration": push, "force": force, "bias": bias}
        motion = {key: dict(zip(frames, np.round(column, 12).tolist())) for key, column in columns.items()}
        motions.append({**motion, "center": np.round(center, 12).tolist()})
    return motions


def main(folder: Path) -> None:
    warnings.simplefilter("ignore", ry.KinegraphWarning)
    source = f"Poses of joints in the world, and forces at joints, by Pinocchio {pin.__version__}, robots of example-robot-data 6.0.0; record_robots.py"
    robots = {name: record(folder / f"{name}.urdf") for name in ROBOTS}
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(robot)}" for name, robot in robots.items())
    dynamics = json.dumps({name: recordDynamics(folder / f"{name}.urdf") for name in DYNAMIC})
    DATA.write_text(f'{{"source": {json.dumps(source)},\n"robots": {{\n{lines}\n}},\n"dynamics": {dynamics}}}\n')


if __name__ == "__main__":
    main(Path(sys.argv[1]))
