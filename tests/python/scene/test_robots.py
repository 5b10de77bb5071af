"""A sample of the robots of the package example-robot-data against recorded poses; test_urdf.py compares all with
Pinocchio."""

import os
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from conftest import recorded

FOLDERS = [
    Path(share) / "example-robot-data" / "robots"
    for share in os.environ.get("KINEGRAPH_PACKAGE_PATH", "").split(os.pathsep)
]
ROBOTS = [folder for folder in FOLDERS if folder.is_dir()]
RECORDED = recorded("robots_pinocchio")["robots"]
DYNAMICS = recorded("robots_pinocchio")["dynamics"]
needs_robots = pytest.mark.skipif(not ROBOTS, reason="needs robots: pip install example-robot-data==6.0.0")


def load(name: str) -> ry.Config:
    C = ry.Config()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)  # meshes that the collection itself lacks
        C.addFile(ROBOTS[0] / f"{name}.urdf")
    return C


@needs_robots
@pytest.mark.parametrize("name", RECORDED)
def test_robots_of_the_collection_stand_as_in_pinocchio(name: str) -> None:
    C = load(name)
    for joint, q in RECORDED[name]["q"].items():
        C.setJointState(q, [joint])
    for frame, pose in RECORDED[name]["poses"].items():
        found = C.getFrame(frame).getPose()
        sign = np.sign(np.dot(found[3:], pose[3:]))
        np.testing.assert_allclose(found * [1, 1, 1, sign, sign, sign, sign], pose, atol=1e-9)
    assert len(RECORDED[name]["poses"]) >= len(C.getJoints())


@needs_robots
@pytest.mark.parametrize("name", DYNAMICS)
def test_motions_of_robots_need_the_forces_that_pinocchio_says(name: str) -> None:
    C = load(name)
    names = C.getJointNames()[: C.getJointDimension()]  # behind them those of joints that mimic others
    for motion in DYNAMICS[name]:
        q, velocity, acceleration, force, bias = (
            np.array([motion[key][joint] for joint in names])
            for key in ("q", "velocity", "acceleration", "force", "bias")
        )
        C.setJointState(q)
        M, F = C.dyn_MF(velocity)
        np.testing.assert_allclose(F, bias, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(M @ acceleration + F, force, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(C.inverseDynamics(velocity, acceleration), force, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(C.getCenterOfMass()[1], motion["center"], atol=1e-9)
