"""The links of a scene, named as in its URDF, and their transforms."""

from __future__ import annotations

import warnings
from collections.abc import Container, Sequence
from xml.etree import ElementTree

import numpy as np

from .._core import JT, Config
from ..errors import KinegraphWarning

Transforms = list[tuple[str, str, np.ndarray]]
ROOT = "world"


def _relative(parents: np.ndarray, children: np.ndarray) -> np.ndarray:
    """Returns the poses of children in their parents, (N, 7) each."""
    inverse = parents[:, 3:] * [1.0, -1.0, -1.0, -1.0]
    return np.hstack(
        [_rotated(inverse, children[:, :3] - parents[:, :3]), _product(inverse, children[:, 3:])],
    )


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    w = a[:, :1] * b[:, :1] - np.sum(a[:, 1:] * b[:, 1:], axis=1, keepdims=True)
    return np.hstack([w, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])])


def _rotated(a: np.ndarray, v: np.ndarray) -> np.ndarray:
    t = 2.0 * np.cross(a[:, 1:], v)
    return np.asarray(v + a[:, :1] * t + np.cross(a[:, 1:], t))


def frameNamed(names: Container[str], link: str) -> str:
    """Returns the name of the frame of a link, which is named as in the URDF of its scene; "" if there is none.

    Args:
        names: Names of the frames of the scene.
        link: Name of the link.
    """
    found = link if link in names else link.removesuffix("_link")
    return found if found in names else ""


def isFree(config: Config, name: str) -> bool:
    """Returns whether a frame has a pose of its own, as objects have: it is a root, or has a rigid joint.

    Args:
        config: The scene.
        name: Name of the frame.
    """
    frame = config.getFrame(name)
    return name != ROOT and (frame.getParent() is None or frame.getJointType() == JT.rigid)


class Links:
    """The tree of links of a scene: those of its URDF, and other frames as children of the world."""

    def __init__(self, config: Config):
        """Reads the scene.

        Args:
            config: The scene.
        """
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", KinegraphWarning)  # about shapes that URDF cannot express
            self.urdf = str(config.writeURDF())
        tree = ElementTree.fromstring(self.urdf)
        frames = config.getFrameNames()
        self.count = len(frames)
        index = {name: number for number, name in enumerate(frames)}
        parent_of: dict[str, str] = {}
        moving: set[str] = set()
        urdf_joints = {joint.get("name") for joint in tree.iter("joint")}
        self.joints: list[str] = []  # all joints with one value, fingers included
        for joint in tree.iter("joint"):
            parent, child = joint.find("parent"), joint.find("child")
            if parent is None or child is None:
                continue
            parent_of[child.get("link", "")] = parent.get("link", "")
            if joint.get("type") != "fixed":
                moving.add(child.get("link", ""))
                if joint.get("name") in index and joint.get("type") in ("revolute", "continuous", "prismatic"):
                    self.joints.append(str(joint.get("name")))
        in_q = set(config.getJointNames())
        self.fingers = [name for name in self.joints if name not in in_q]  # joints that are not part of q
        links = [str(link.get("name")) for link in tree.iter("link")]
        known = urdf_joints.union(links)
        links += [f for f in frames if f not in known and f + "_link" not in known and isFree(config, f)]
        self.names = [name for name in links if frameNamed(index, name) and name != ROOT]
        self.parents = [parent_of.get(name, ROOT) for name in self.names]
        self._children = np.array([index[frameNamed(index, name)] for name in self.names], int)
        self._parents = np.array([index.get(frameNamed(index, parent), -1) for parent in self.parents], int)
        free = [name in index and isFree(config, name) for name in self.names]
        self._moving = np.array([name in moving for name in self.names], bool) | np.array(free, bool)
        self._last: np.ndarray | None = None

    def read(self, config: Config) -> tuple[Transforms, Transforms]:
        """Returns the transforms of the links that move, and, in the first call, those of the others.

        A link that changes its place counts as moving from then on.

        Args:
            config: The scene.
        """
        world = config.getFrameState()
        origin = np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
        world = np.vstack([world, origin])  # index -1: the world
        poses = _relative(world[self._parents], world[self._children])
        first = self._last is None
        if self._last is not None:
            self._moving |= np.abs(poses - self._last).max(axis=1) > 1e-6
        self._last = poses
        moving = [(self.parents[i], self.names[i], poses[i]) for i in np.flatnonzero(self._moving)]
        resting = [(self.parents[i], self.names[i], poses[i]) for i in np.flatnonzero(~self._moving)] if first else []
        return moving, resting


class JointStates:
    """The states of all joints: those of q, and others, such as fingers."""

    def __init__(self, joints: Sequence[str]):
        """Begins.

        Args:
            joints: Names of the joints of q.
        """
        self._joints = list(joints)
        self._last: tuple[float, np.ndarray] | None = None

    def read(
        self, time: float, config: Config, links: Links, q: np.ndarray, velocity: np.ndarray
    ) -> tuple[list[str], np.ndarray, np.ndarray]:
        """Returns names, positions and velocities of all joints; velocities of others are differences of positions.

        Args:
            time: s.
            config: The scene in its present state.
            links: Its links.
            q, velocity: State of the joints of q.
        """
        others = [name for name in links.joints if name not in self._joints]
        if not others:
            return self._joints, q, velocity
        values = np.array([config.getFrame(name).getJointState()[0] for name in others])
        speeds = np.zeros(len(others))
        if self._last is not None and time > self._last[0] and len(self._last[1]) == len(others):
            speeds = (values - self._last[1]) / (time - self._last[0])
        self._last = (time, values)
        return [*self._joints, *others], np.append(q, values), np.append(velocity, speeds)
