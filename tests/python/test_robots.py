"""A sample of the robots of the package example-robot-data against recorded poses; test_urdf.py compares all with Pinocchio."""

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


@pytest.mark.skipif(not ROBOTS, reason="needs robots: pip install example-robot-data==6.0.0")
@pytest.mark.parametrize("name", RECORDED)
def test_robots_of_the_collection_stand_as_in_pinocchio(name: str) -> None:
    C = ry.Config()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)  # meshes that the collection itself lacks
        C.addFile(ROBOTS[0] / f"{name}.urdf")
    for joint, q in RECORDED[name]["q"].items():
        C.setJointState(q, [joint])
    for frame, pose in RECORDED[name]["poses"].items():
        found = C.getFrame(frame).getPose()
        sign = np.sign(np.dot(found[3:], pose[3:]))
        np.testing.assert_allclose(found * [1, 1, 1, sign, sign, sign, sign], pose, atol=1e-9)
    assert len(RECORDED[name]["poses"]) >= len(C.getJoints())
