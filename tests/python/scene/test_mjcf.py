"""MJCF files, and agreement with MuJoCo if it is installed."""

import importlib.util
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

ARM = """<mujoco model="arm">
  <compiler angle="radian"/>
  <default><geom rgba=".2 .3 .4 1"/><default class="finger"><joint type="slide" range="0 .04"/></default></default>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body name="cube" pos=".4 .2 .1"><freejoint name="cube_free"/><geom type="box" size=".03 .03 .03"/></body>
    <body name="upper" pos="0 0 .3" euler=".1 .2 .3">
      <inertial pos="0 0 .1" mass="2" diaginertia=".1 .1 .05"/>
      <joint name="shoulder" axis="1 2 2" pos="0 .1 0" range="-2 1"/>
      <geom type="capsule" fromto="0 0 0 0 0 .4" size=".05"/>
      <body name="hand" pos="0 0 .4">
        <inertial pos="0 0 .05" mass=".5" diaginertia=".001 .001 .001"/>
        <joint name="wrist" axis="0 0 -1"/> <site name="tcp" pos="0 0 .1"/> <camera name="eye" fovy="50"/>
        <body name="finger1" childclass="finger"><joint name="grip" axis="0 1 0"/><geom size=".01"/></body>
        <body name="finger2" childclass="finger"><joint name="follow" axis="0 -1 0"/><geom size=".01"/></body>
      </body>
    </body>
  </worldbody>
  <equality><joint joint1="follow" joint2="grip"/></equality>
</mujoco>
"""


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    file = tmp_path / "arm.xml"
    file.write_text(ARM)
    return file


def load(file: Path, prefix: str | None = None) -> ry.Config:
    config = ry.Config()
    config.addFile(file, prefix)
    return config


def test_a_scene_has_its_joints_limits_and_bodies(arm: Path) -> None:
    config = load(arm)
    assert config.getJointNames() == [*(f"cube_free:{i}" for i in range(7)), "shoulder", "wrist", "grip", "follow"]
    np.testing.assert_array_equal(config.getJointLimits()[:, 7:], [[-2, -np.inf, 0], [1, np.inf, 0.04]])
    np.testing.assert_allclose(config.getJointState()[:7], [0.4, 0.2, 0.1, 1, 0, 0, 0])
    assert config.getFrame("upper").getMass() == 2
    assert {"tcp", "eye", "finger2", "follow"} <= set(config.getFrameNames())


def test_a_robot_can_be_included_twice_with_prefixes(arm: Path, tmp_path: Path) -> None:
    scene = tmp_path / "two.g"
    scene.write_text("Prefix: l_\nInclude: <arm.xml>\nPrefix: r_\nInclude: <arm.xml>\n")
    config = load(scene)
    config.setJointState([0.02], ["r_grip"])
    apart = config.getFrame("r_finger1").getPosition() - config.getFrame("r_finger2").getPosition()
    np.testing.assert_allclose(np.linalg.norm(apart), 0.04)
    assert np.allclose(config.getFrame("l_finger1").getPosition(), config.getFrame("l_finger2").getPosition())


def test_mistakes_say_where_they_are(tmp_path: Path) -> None:
    file = tmp_path / "bad.xml"
    file.write_text('<mujoco>\n  <worldbody>\n    <body><joint type="hinje"/></body>\n  </worldbody>\n</mujoco>')
    with pytest.raises(ry.ParseError, match="similar names: hinge") as error:
        load(file)
    assert (error.value.line, error.value.column) == (3, 18)


def test_what_is_written_as_g_is_the_same_scene(arm: Path, tmp_path: Path) -> None:
    config = load(arm)
    config.write(tmp_path / "again.g")
    again = load(tmp_path / "again.g")
    assert again.getFrameNames() == config.getFrameNames()
    np.testing.assert_array_equal(again.getFrameState(), config.getFrameState())


needs_mujoco = pytest.mark.skipif(
    importlib.util.find_spec("mujoco") is None, reason="compares with MuJoCo: pip install mujoco"
)


@needs_mujoco
def test_poses_of_an_own_robot_are_those_of_mujoco(arm: Path) -> None:
    from mujoco_poses import largestDifference

    assert largestDifference(str(arm), load(arm), seed=0, samples=20) < 1e-12


def collection() -> list[Path]:
    """All MJCF files of the package robosuite that stand for themselves."""
    package = importlib.util.find_spec("robosuite")
    if package is None or package.origin is None:
        return []
    assets = Path(package.origin).parent / "models" / "assets"
    return sorted(file for file in assets.rglob("*.xml") if "<mujoco" in file.read_text(errors="ignore"))


# MuJoCo refuses these: a body without mass, a material that is not there, a mesh twice, an unknown attribute.
REFUSED = {"null_mobile_base", "rethink_minimal_mount", "robotiq_gripper_85", "xarm7_gripper"}

MODELS = [file for file in collection() if file.stem not in REFUSED] or [
    pytest.param(None, marks=pytest.mark.skip(reason="needs models: pip install --no-deps robosuite==1.5.2"))
]


@needs_mujoco
@pytest.mark.models
@pytest.mark.parametrize("file", MODELS, ids=lambda file: f"{file.parent.name}/{file.stem}" if file else "none")
def test_every_model_of_robosuite_agrees_with_mujoco(file: Path) -> None:
    from mujoco_poses import assertSameNumbers, largestDifference

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)  # actuators and sensors are not read
        config = load(file)
    assert largestDifference(str(file), config, seed=0, samples=20) < 1e-9
    assertSameNumbers(str(file), config)
