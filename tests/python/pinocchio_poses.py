"""Compares the scene of a URDF file with Pinocchio's model."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pinocchio as pin

import kinegraph as ry


def mimicRules(urdf: str) -> dict[str, tuple[str, float, float]]:
    """The joints of a URDF file that mimic another one: name -> (source, multiplier, offset)."""
    joints = {joint.get("name"): joint for joint in ElementTree.parse(urdf).getroot().findall("joint")}
    rules = {}
    for name, joint in joints.items():
        mimic = joint.find("mimic")
        if mimic is not None and mimic.get("joint") in joints:
            rules[name] = (mimic.get("joint"), float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))
    return rules


def jointFrame(config: ry.Config, joint: str) -> str:
    """The frame of a URDF joint: of its name, or with `_joint` behind it if a link has that name."""
    renamed = f"{joint}_joint"
    return renamed if renamed in config and config.getFrame(renamed).getJointType() != ry.JT.none else joint


class Comparison:
    """A scene and Pinocchio's model of a URDF file."""

    def __init__(self, urdf: str, config: ry.Config, seed: int) -> None:
        self.config, self.random = config, np.random.default_rng(seed)
        self.model = pin.buildModelFromUrdf(urdf)
        self.data = self.model.createData()
        self.mimics = mimicRules(urdf)
        index = {name: i for i, name in reversed(list(enumerate(config.getFrameNames())))}
        self.joints = [(index[jointFrame(config, name)], i) for i, name in enumerate(self.model.names) if i > 0]
        named = {
            pin.FrameType.BODY: lambda name: name,
            pin.FrameType.FIXED_JOINT: lambda name: jointFrame(config, name),
        }
        self.frames = [
            (index[named[frame.type](frame.name)], i)
            for i, frame in enumerate(self.model.frames)
            if frame.type in named and frame.name in index
        ]

    def drawState(self) -> np.ndarray:
        """Draws a state, sets it in the scene, and returns it as Pinocchio wants it: a mimic is a joint like others to
        it."""
        values = {}
        for name, joint in zip(list(self.model.names)[1:], self.model.joints[1:]):
            values[name] = self.drawJoint(name, joint)
        q = pin.neutral(self.model)
        for name, joint in zip(list(self.model.names)[1:], self.model.joints[1:]):
            value = self.valueOf(name, values)
            q[joint.idx_q : joint.idx_q + joint.nq] = {
                1: value,
                2: [np.cos(value[0]), np.sin(value[0])],
                7: [*value[:3], *value[4:], *value[3:4]],
            }[joint.nq]
        return q

    def drawJoint(self, name: str, joint: pin.JointModel) -> list[float]:
        if joint.nq == 7:
            rotation = self.random.normal(size=4)
            value = [*self.random.normal(size=3), *(rotation / np.linalg.norm(rotation))]
        elif joint.nq == 1:
            low = max(self.model.lowerPositionLimit[joint.idx_q], -2.0)
            value = [self.random.uniform(low, max(low, min(self.model.upperPositionLimit[joint.idx_q], 2.0)))]
        else:
            value = [self.random.uniform(-3, 3)]
        if name not in self.mimics:
            self.config.setJointState(value, [jointFrame(self.config, name)])
        return value

    def valueOf(self, name: str, values: dict[str, list[float]]) -> list[float]:
        if name not in self.mimics:
            return values.get(name, [0.0])  # a fixed joint has no value
        source, multiplier, offset = self.mimics[name]
        return [multiplier * self.valueOf(source, values)[0] + offset]

    def difference(self) -> float:
        """Sets a random state in both; the largest difference of any pose, in m or rad."""
        pin.framesForwardKinematics(self.model, self.data, self.drawState())
        poses = self.config.getFrameState()
        expected = [(i, self.data.oMi[k]) for i, k in self.joints] + [(i, self.data.oMf[k]) for i, k in self.frames]
        worst = 0.0
        for i, placement in expected:
            w, x, y, z = poses[i, 3:]
            rotation = pin.Quaternion(w, x, y, z).toRotationMatrix()
            position_error = np.abs(poses[i, :3] - placement.translation).max()
            worst = max(worst, position_error, np.abs(rotation - placement.rotation).max())
        return worst


def largestDifference(urdf: str, config: ry.Config, seed: int, samples: int) -> float:
    """The largest difference of the poses of joints, links and fixed joints at random states, in m or rad."""
    comparison = Comparison(urdf, config, seed)
    assert len(comparison.joints) + len(comparison.frames) >= config.getJointDimension()
    return max(comparison.difference() for _ in range(samples))


def assertSameNumbers(urdf: str, config: ry.Config) -> None:
    """The total mass, and the limits of joints that do not mimic others, are Pinocchio's; beyond 1e15 there is none."""
    model = pin.buildModelFromUrdf(urdf)
    mass = sum(inertia.mass for inertia in model.inertias)
    assert abs(sum(frame.getMass() for frame in config) - mass) <= 1e-6 * max(1, mass)
    mimics, limits = mimicRules(urdf), config.getJointLimits()
    for name, joint in zip(list(model.names)[1:], model.joints[1:], strict=True):
        if joint.nq != 1 or name in mimics:
            continue
        given = np.array([model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q]])
        given[np.abs(given) > 1e15] *= np.inf
        np.testing.assert_allclose(limits[:, config.getFrame(jointFrame(config, name)).getJointQIndex()], given)
