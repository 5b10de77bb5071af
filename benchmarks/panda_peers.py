"""Builds the Panda of benchmarks/kinematics.py in other libraries, from a description by Kinegraph.

`describe` runs with Kinegraph, `PEERS` with the other libraries; they share a JSON file. All have the same joints,
shapes (in MuJoCo a rounded box counts as a box) and pairs.
"""

import importlib
import json


def describe(ry, C, tip):
    """Returns joints with their poses at q = 0, shapes with their poses in the link, and collidable pairs."""
    import numpy as np

    C.setJointState(np.zeros(C.getJointDimension()))
    joints, link_of = [], {}
    for frame in C.getJoints():
        pose, axes = C.eval(
            lambda f: (
                f.getPose(),
                np.vstack([f.getPositionJacobian(), f.getAngularJacobian(), np.zeros(C.getJointDimension())]),
            ),
            [frame.name],
        )
        axis = axes[3:6, len(joints)]
        joints.append(
            {
                "name": frame.name,
                "position": pose[:3].tolist(),
                "axis": axis.tolist(),
                "parent": parentJoint(frame, link_of),
            }
        )
        link_of[frame.name] = len(joints) - 1
    names = C.getCollidablePairs()
    shapes = {}
    for name in sorted(set(names)):
        frame = C.getFrame(name)
        kind = str(frame.getShapeType()).split(".")[-1]
        size = frame.getSize()
        if kind not in ("capsule", "ssBox", "box", "sphere"):
            raise ValueError(f"'{name}' is a {kind}")
        shapes[name] = {
            "kind": kind,
            "size": list(size),
            "pose": list(frame.getPose()),
            "link": parentJoint(frame, link_of),
        }
    gripper = C.getFrame(tip)
    return {
        "joints": joints,
        "limits": np.asarray(C.getJointLimits()).tolist(),
        "shapes": shapes,
        "pairs": list(zip(names[::2], names[1::2])),
        "tip": {"position": list(gripper.getPosition()), "link": parentJoint(gripper, link_of)},
    }


def parentJoint(frame, link_of):
    """Returns the number of the joint that moves a frame (above it, for the frame of a joint); -1 for the world."""
    above = frame.getParent() if frame.name not in link_of else frame
    while above is not None and above.name not in link_of:
        above = above.getParent()
    return -1 if above is None else link_of[above.name]


def offset(scene, link, position):
    base = [0.0, 0.0, 0.0] if link < 0 else scene["joints"][link]["position"]
    return [p - b for p, b in zip(position, base)]


def pinocchioModels(scene):
    """Returns the joints, the number of the tip's frame, and the shapes with their pairs."""
    import coal
    import numpy as np
    import pinocchio as pin

    model = pin.Model()
    for joint in scene["joints"]:
        place = pin.SE3(np.eye(3), np.array(offset(scene, joint["parent"], joint["position"])))
        model.addJoint(joint["parent"] + 1, jointModel(pin, np.array(joint["axis"])), place, joint["name"])
    place = pin.SE3(np.eye(3), np.array(offset(scene, scene["tip"]["link"], scene["tip"]["position"])))
    tip = model.addFrame(pin.Frame("tip", scene["tip"]["link"] + 1, 0, place, pin.FrameType.OP_FRAME))
    geometry, ids = pin.GeometryModel(), {}
    for name, shape in scene["shapes"].items():
        size, pose = shape["size"], shape["pose"]
        kinds = {
            "capsule": lambda s: coal.Capsule(s[1], s[0]),
            "sphere": lambda s: coal.Sphere(s[0]),
            "ssBox": lambda s: roundedBox(coal, s),
            "box": lambda s: coal.Box(*s[:3]),
        }
        rotation = pin.Quaternion(pose[3], pose[4], pose[5], pose[6]).normalized().toRotationMatrix()
        place = pin.SE3(rotation, np.array(offset(scene, shape["link"], pose[:3])))
        ids[name] = geometry.addGeometryObject(
            pin.GeometryObject(name, shape["link"] + 1, place, kinds[shape["kind"]](size))
        )
    for a, b in scene["pairs"]:
        geometry.addCollisionPair(pin.CollisionPair(ids[a], ids[b]))
    return model, tip, geometry


def pinocchioQuestions(scene):
    """Returns the queries of Pinocchio, with coal for the shapes."""
    import numpy as np
    import pinocchio as pin

    model, tip, geometry = pinocchioModels(scene)
    data, geometry_data = model.createData(), geometry.createData()
    world, limits = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED, np.array(scene["limits"])

    def position(q):
        J = pin.computeFrameJacobian(model, data, q, tip, world)
        return data.oMf[tip].translation, J

    def frame(q):
        pin.forwardKinematics(model, data, q)
        return pin.updateFramePlacement(model, data, tip).translation

    def distances(q):
        pin.updateGeometryPlacements(model, data, geometry, geometry_data, q)
        pin.computeDistances(geometry, geometry_data)
        return geometry_data.distanceResults

    def valid(q):
        inside = bool((q >= limits[0]).all() and (q <= limits[1]).all())
        return inside and not pin.computeCollisions(model, data, geometry, geometry_data, q, True)

    return {
        "position": position,
        "pose": position,
        "frame": frame,
        "contacts": lambda q: pin.computeCollisions(model, data, geometry, geometry_data, q, False),
        "distances": distances,
        "valid": valid,
    }


def roundedBox(coal, size):
    box = coal.Box(*(side - 2 * size[3] for side in size[:3]))
    box.setSweptSphereRadius(size[3])
    return box


def jointModel(pin, axis):
    for unit, kind in (((1, 0, 0), pin.JointModelRX), ((0, 1, 0), pin.JointModelRY), ((0, 0, 1), pin.JointModelRZ)):
        if abs(axis @ unit - 1.0) < 1e-12:
            return kind()
    return pin.JointModelRevoluteUnaligned(*axis)


def mujocoQuestions(scene):
    """Returns the queries of MuJoCo, with explicit pairs."""
    import mujoco
    import numpy as np

    model = mujoco.MjModel.from_xml_string(mujocoText(scene))
    data = mujoco.MjData(model)
    body, limits = model.body("tip").id, np.array(scene["limits"])
    linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))

    def position(q):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_jacBody(model, data, linear, angular, body)
        return data.xpos[body], linear

    def frame(q):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        return data.xpos[body]

    def contacts(q):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        return data.ncon > 0

    def valid(q):
        return bool((q >= limits[0]).all() and (q <= limits[1]).all()) and not contacts(q)

    return {"position": position, "pose": position, "frame": frame, "contacts": contacts, "valid": valid}


def mujocoText(scene):
    text = lambda numbers: " ".join(f"{number:.17g}" for number in numbers)  # noqa: E731

    def geoms(link):
        for name, shape in scene["shapes"].items():
            if shape["link"] != link:
                continue
            s, pose = shape["size"], shape["pose"]
            half = [0.5 * x for x in s[:3]]
            size = [s[1], half[0]] if shape["kind"] == "capsule" else s[:1] if shape["kind"] == "sphere" else half
            kind = {"ssBox": "box"}.get(shape["kind"], shape["kind"])
            place = f'pos="{text(offset(scene, link, pose[:3]))}" quat="{text(pose[3:])}"'
            yield f'<geom name="{name}" type="{kind}" size="{text(size)}" {place} contype="0" conaffinity="0" mass="1"/>'
        if scene["tip"]["link"] == link:
            yield f'<body name="tip" pos="{text(offset(scene, link, scene["tip"]["position"]))}"/>'

    def bodies(parent):
        for i, joint in enumerate(scene["joints"]):
            if joint["parent"] != parent:
                continue
            yield f'<body pos="{text(offset(scene, parent, joint["position"]))}"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
            yield f'<joint name="{joint["name"]}" axis="{text(joint["axis"])}"/>'
            yield from geoms(i)
            yield from bodies(i)
            yield "</body>"

    pairs = "".join(f'<pair geom1="{a}" geom2="{b}"/>' for a, b in scene["pairs"])
    world = "".join([*geoms(-1), *bodies(-1)])
    return f"<mujoco><worldbody>{world}</worldbody><contact>{pairs}</contact></mujoco>"


PEERS = {"pinocchio": pinocchioQuestions, "mujoco": mujocoQuestions}


def installed():
    """Returns the PEERS that this Python can import, with their versions."""
    versions = {}
    for name in PEERS:
        try:
            versions[name] = importlib.import_module(name).__version__
        except ImportError:
            continue
    return versions


def load(name, path):
    with open(path) as file:
        return PEERS[name](json.load(file))
