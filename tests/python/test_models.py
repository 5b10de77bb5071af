"""The robots and scenes that come with the package: names and poses that scripts rely on."""

import importlib.util
import os
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

SHARE = [
    Path(folder)
    for folder in os.environ.get("KINEGRAPH_PACKAGE_PATH", "").split(os.pathsep)
    if folder and (Path(folder) / "example-robot-data").is_dir()
]
needs_robots = pytest.mark.skipif(not SHARE, reason="needs robots: pip install example-robot-data==6.0.0")


def model(name: str, prefix: str | None = None) -> ry.Config:
    C = ry.Config()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)  # meshes that the robot package itself lacks
        C.addFile(ry.raiPath(name), prefix)
    return C


def test_two_robots_of_one_file_stand_side_by_side():
    C = model("panda/panda.g", "l_")
    C.addFile(ry.raiPath("panda/panda.g"), "r_")
    C.getFrame("r_panda_base").setPosition([0, 1, 0])
    offset = C.getFrame("r_gripper").getPosition() - C.getFrame("l_gripper").getPosition()
    assert C.getJointDimension() == 14 and np.allclose(offset, [0, 1, 0])


# Recorded from the package robotic 0.4.2 at the pose that the file gives.
UR10 = {
    "ur_shoulder_lift_joint": [0.0, 0.2209, 0.1273, 0.9771, 0.0, -0.2130, 0.0],
    "ur_elbow_joint": [-0.2547, 0.0490, 0.6838, 0.9595, 0.0, 0.2815, 0.0],
    "ur_wrist_2_joint": [0.0545, 0.1639, 1.1654, 0.7385, 0.2590, 0.4742, 0.4034],
    "ur_ee_fixed_joint": [0.1275, 0.2138, 1.2841, 0.2369, 0.5184, 0.1521, 0.8074],
}


def test_the_ur10_stands_as_in_older_scripts():
    C = model("ur10/ur10.g")
    assert C.getJointNames() == [
        f"ur_{name}_joint" for name in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
    ]
    assert np.allclose(C.getJointState(), [0, -2, 1, -1, 1, 0])
    assert np.allclose(np.abs(C.getJointLimits()), 2 * np.pi)
    for name, pose in UR10.items():
        assert np.allclose(C.getFrame(name).getPose(), pose, atol=1e-4), name


def test_the_gripper_closes_symmetrically_and_its_pads_stay_parallel():
    C = model("robotiq/robotiq.g")
    assert C.getJointNames() == ["finger_joint"] and np.allclose(C.getJointState(), [0.2])
    assert np.allclose(C.getFrame("gripper").getPosition(), [0, 0, 1.14])
    gaps = []
    for q in (0.0, 0.4, 0.8):
        C.setJointState([q])
        left, right = (C.getFrame(f"{side}_inner_finger_pad_0") for side in ("left", "right"))
        assert np.allclose(left.getPosition() * [1, -1, 1], right.getPosition())
        assert np.allclose(np.abs(left.getRotationMatrix()), np.eye(3), atol=1e-9)
        gaps.append(right.getPosition()[1] - left.getPosition()[1] - 0.00635)
    assert gaps[0] == pytest.approx(0.085, abs=0.002) and gaps[0] > gaps[1] > gaps[2] > -0.01  # it is called 2F-85


@needs_robots
@pytest.mark.parametrize(
    "name, dofs, frame, position",
    [
        ("g1/g1.g", 29, "left_ankle_roll_joint", [0.0090, 0.1185, 0.0529]),
        ("g1/g1.yml", 29, "right_knee_joint", [0.0833, -0.1186, 0.3612]),
        ("allegro/allegro.g", 16, "tip1", [0.0957, 0.0479, 0.2490]),
        ("allegro/allegro.yml", 16, "tip4", [0.0875, 0.0817, 0.1681]),
    ],
)
def test_robots_of_the_other_package_stand_as_in_older_scripts(name, dofs, frame, position):
    C = model(name)
    assert C.getJointDimension() == dofs
    assert np.allclose(C.getFrame(frame).getPosition(), position, atol=2e-3)


@needs_robots
def test_the_pr2_drives_and_reaches():
    C = model("pr2/pr2.g")
    assert C.getJointNames()[:3] == [f"worldTranslationRotation:{i}" for i in range(3)]
    assert not [name for name in C.getJointNames() if "caster" in name]
    assert C.getJointDimension() == 25 and {"l_gripper_joint", "r_gripper_l_finger_joint"} <= set(C.getJointNames())
    assert np.allclose(C.getFrame("l_wrist_roll_joint").getPosition(), [-0.3998, 0.3779, 0.9513], atol=2e-3)


@pytest.mark.parametrize("name", ["pr2/pr2.g", "g1/g1.g", "allegro/allegro.g"])
def test_a_robot_whose_package_is_missing_says_what_to_install(name, monkeypatch):
    for variable in ("KINEGRAPH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(variable, raising=False)
    C = ry.Config()
    with pytest.raises(ry.ParseError, match="pip install example-robot-data"):
        C.addFile(ry.raiPath(name))
    assert len(C) == 0


def test_a_marker_image_has_its_borders_or_says_what_to_install():
    with pytest.raises(ry.ArgumentError, match="50"):
        ry.getArucoImage(50)
    if importlib.util.find_spec("cv2") is None:
        with pytest.raises(ry.Error, match="pip install opencv"):
            ry.getArucoImage(0)
        return
    image = ry.getArucoImage(id=0)
    assert image.shape == (9, 9) and image.dtype == np.uint8
    assert (image[0] == 255).all() and (image[1, 1:-1] == 0).all()
    assert (image[3, 1:-1] == [0, 0, 255, 0, 255, 255, 0]).all()  # recorded from the package robotic 0.4.2
