"""URDF files: reading, writing, and agreement with Pinocchio if it is installed."""

import importlib.util
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

# Angles and offsets without structure, every kind of joint, a mimic with offset, and a link named as a joint.
ARM = """<?xml version="1.0"?>
<robot name="arm">
  <material name="steel"><color rgba=".5 .5 .6 1"/></material>
  <link name="base">
    <visual><geometry><cylinder length=".2" radius=".1"/></geometry><material name="steel"/></visual>
    <collision><geometry><box size=".2 .2 .2"/></geometry></collision>
  </link>
  <link name="upper">
    <inertial><origin xyz="0 0 .2" rpy="0 .3 0"/><mass value="1.5"/>
      <inertia ixx=".1" ixy=".01" ixz="0" iyy=".2" iyz="0" izz=".3"/></inertial>
  </link>
  <link name="elbow"/> <link name="lower"/> <link name="flange"/> <link name="finger1"/> <link name="finger2"/> <link name="wheel"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 -1"/><limit lower="-2" upper="1.5" effort="10" velocity="2"/>
  </joint>
  <joint name="elbow" type="continuous">
    <origin xyz="0 0 .4" rpy="0 1.5707963267948966 0"/><parent link="upper"/><child link="elbow"/><axis xyz="1 2 2"/>
  </joint>
  <joint name="lift" type="prismatic">
    <origin xyz="0 .1 0"/><parent link="elbow"/><child link="lower"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper=".4" effort="5" velocity="1"/>
  </joint>
  <joint name="mount" type="fixed"><origin xyz="0 0 .1" rpy="0 0 .7853981633974483"/><parent link="lower"/><child link="flange"/></joint>
  <joint name="grip" type="prismatic">
    <parent link="flange"/><child link="finger1"/><axis xyz="0 1 0"/><limit lower="0" upper=".04" effort="5" velocity="1"/>
  </joint>
  <joint name="follow" type="prismatic">
    <parent link="flange"/><child link="finger2"/><axis xyz="0 -1 0"/><limit lower="0" upper=".04" effort="5" velocity="1"/>
    <mimic joint="grip" multiplier="0.5" offset="0.01"/>
  </joint>
  <joint name="spin" type="revolute">
    <origin xyz="1 0 0"/><parent link="base"/><child link="wheel"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
"""


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    file = tmp_path / "arm.urdf"
    file.write_text(ARM)
    return file


def load(file: Path | str, prefix: str | None = None) -> ry.Config:
    config = ry.Config()
    config.addFile(file, prefix)
    return config


def test_a_robot_has_its_joints_limits_and_links(arm: Path) -> None:
    config = load(arm)
    assert config.getJointNames() == ["shoulder", "elbow_joint", "lift", "grip", "spin", "follow"]  # which mimics grip
    np.testing.assert_array_equal(config.getJointLimits(), [[-2, -np.inf, 0, 0, -1], [1.5, np.inf, 0.4, 0.04, 1]])
    assert {"base", "upper", "elbow", "mount", "flange", "finger2", "follow"} <= set(config.getFrameNames())
    assert config.getFrame("upper").getMass() == 1.5
    assert config.getFrame("base_0").getShapeType() == ry.ST.cylinder
    np.testing.assert_array_equal(config.getFrame("base_1").asDict()["size"], [0.2, 0.2, 0.2])


def test_a_prefix_stands_before_every_name_and_mimics_still_follow(arm: Path) -> None:
    config = load(arm, "l_")
    assert config.getJointNames()[0] == "l_shoulder"
    config.setJointState([0.02], ["l_grip"])
    np.testing.assert_allclose(config.getFrame("l_finger2").getRelativePose()[:3], 0)
    follow = config.getFrame("l_finger2").getPosition() - config.getFrame("l_flange").getPosition()
    np.testing.assert_allclose(np.linalg.norm(follow), 0.02, atol=1e-15)


def test_feature_and_ik_work_on_a_robot_from_urdf(arm: Path) -> None:
    config = load(arm)
    y, J = config.eval(ry.FS.position, ["flange"])
    assert y.shape == (3,) and J.shape == (3, 5)
    assert np.abs(J[:, 4]).max() == 0 and np.abs(J[:, 0]).max() > 0.1


def test_mistakes_say_where_they_are(tmp_path: Path) -> None:
    file = tmp_path / "bad.urdf"
    file.write_text(
        '<robot name="r">\n  <link name="a"/>\n  <joint name="j" type="hinge">\n    <parent link="a"/>\n  </joint>\n</robot>'
    )
    with pytest.raises(ry.ParseError) as error:
        load(file)
    assert (error.value.line, error.value.column) == (3, 19)
    assert "unknown joint type 'hinge'" in str(error.value) and "bad.urdf:3:3: joint 'j': has no <child" in str(
        error.value
    )


def test_a_link_without_its_mesh_shows_its_collision_shape(tmp_path: Path) -> None:
    visual = '<visual><geometry><mesh filename="none.stl"/></geometry></visual>'
    box = '<geometry><box size=".1 .1 .1"/></geometry>'
    file = tmp_path / "arm.urdf"
    file.write_text(f"""<robot name="arm">
      <link name="lost">{visual}<collision>{box}</collision></link>
      <link name="whole"><visual>{box}</visual><collision>{box}</collision></link>
      <joint name="j" type="fixed"><parent link="lost"/><child link="whole"/></joint></robot>""")
    with pytest.warns(ry.KinegraphWarning, match="none.stl"):
        config = load(file)
    lost, whole = (config.getFrame(name).asDict()["color"] for name in ("lost_1", "whole_1"))
    assert len(lost) == 3 and list(whole) == [1, 0, 0, 0.2]


def test_a_missing_mesh_is_a_warning_that_says_where_it_was_looked_for(tmp_path: Path) -> None:
    file = tmp_path / "r.urdf"
    file.write_text(
        '<robot><link name="a"><visual><geometry><mesh filename="package://p/a.stl"/></geometry></visual></link></robot>'
    )
    with pytest.warns(
        ry.KinegraphWarning, match="r.urdf:1:41: .*'package://p/a.stl' does not exist.*KINEGRAPH_PACKAGE_PATH"
    ):
        config = load(file)
    assert config.getFrameNames() == ["a", "a_0"]


def test_writing_and_reading_again_gives_the_same_robot(arm: Path, tmp_path: Path) -> None:
    config = load(arm)
    config.writeURDF(tmp_path / "again.urdf")
    again = load(tmp_path / "again.urdf")
    random = np.random.default_rng(0)
    for _ in range(5):
        for name in ["shoulder", "elbow_joint", "lift", "grip", "spin"]:
            q = [random.uniform(-1, 1)]
            config.setJointState(q, [name])
            again.setJointState(q, [name])
        for frame in ["base", "upper", "elbow", "lower", "flange", "finger1", "finger2", "wheel", "base_1"]:
            np.testing.assert_allclose(
                again.getFrame(frame).getTransform(), config.getFrame(frame).getTransform(), atol=1e-12
            )


def test_velocity_and_effort_limits_are_those_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text(
        """<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1" effort="87" velocity="2.5"/></joint>
        <joint name="k" type="continuous"><parent link="b"/><child link="c"/></joint></robot>"""
    )
    C = ry.Config()
    C.addFile(tmp_path / "r.urdf")
    np.testing.assert_array_equal(C.getVelocityLimits(), [2.5, np.inf])
    np.testing.assert_array_equal(C.getEffortLimits(), [87, np.inf])


def test_a_motor_without_effort_or_velocity_has_no_limits_and_the_file_is_named_once(tmp_path: Path) -> None:
    joint = """<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{0}"/>
        <limit lower="-1" upper="1" {2}/>{3}</joint><link name="{0}"/>"""
    file = tmp_path / "r.urdf"
    mimic = '<mimic joint="b"/>'
    for limits, said in {
        'effort="0" velocity="0"': "its effort and velocity are 0, which is read as no limit, here and at other joints",
        'effort="0." velocity="2"': "its effort is 0",
        'effort="2" velocity="0"': "its velocity is 0",
        "": "its <limit> has no effort and velocity, which URDF requires; the motor is read as unlimited, here and at",
        'effort="2"': "its <limit> has no velocity",
    }.items():
        both = joint.format("b", "a", limits, "") + joint.format("c", "b", limits, "")
        file.write_text(f'<robot name="r"><link name="a"/>{both}</robot>')
        C = ry.Config()
        with pytest.warns(ry.KinegraphWarning) as warned:
            C.addFile(file)
        assert len(warned) == 1 and f"{file}:2:" in str(warned[0].message) and said in str(warned[0].message)
        assert ("velocity" in said) == bool(np.isinf(C.getVelocityLimits()).all())
        assert ("effort" in said) == bool(np.isinf(C.getEffortLimits()).all())
        again = tmp_path / "again.urdf"
        again.write_text(C.writeURDF())
        D = ry.Config()
        D.addFile(again)  # without a warning
        np.testing.assert_array_equal(D.getEffortLimits(), C.getEffortLimits())
        np.testing.assert_array_equal(D.getVelocityLimits(), C.getVelocityLimits())
    arm = joint.format("b", "a", 'effort="1" velocity="1"', "") + joint.format(
        "c", "b", 'effort="0" velocity="0"', mimic
    )
    file.write_text(f'<robot name="r"><link name="a"/>{arm}</robot>')
    ry.Config().addFile(file)  # without a warning: a joint that follows another has no motor


needs_pinocchio = pytest.mark.skipif(
    importlib.util.find_spec("pinocchio") is None, reason="compares with Pinocchio: pip install pin"
)


def pairs(C: ry.Config, joints: set[str]) -> set[frozenset[str]]:
    """The links that may collide, each by the joint in q that moves it. A capsule is three shapes in URDF."""

    def joint(name: str) -> str:
        frame = C.getFrame(name)
        while frame.name.removesuffix("_2") not in joints:  # a base that slides and turns is three joints in URDF
            if (parent := frame.getParent()) is None:
                return ""
            frame = parent
        return frame.name.removesuffix("_2")

    names = C.getCollidablePairs()
    found = {frozenset((joint(a), joint(b))) for a, b in zip(names[::2], names[1::2])}
    return {pair for pair in found if len(pair) == 2}


@pytest.mark.parametrize(
    "name, dofs", [("panda/panda.g", 7), ("panda/panda_tight.g", 7), ("pr2/pr2.g", 25), ("ur10/ur10.g", 6)]
)
def test_a_model_keeps_its_dofs_and_pairs_as_urdf(name: str, dofs: int, tmp_path: Path) -> None:
    C, back = ry.Config(), ry.Config()
    C.addFile(ry.raiPath(name))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        C.writeURDF(tmp_path / "robot.urdf")
    if "panda" in name:
        assert not any("is not in q" in str(warning.message) for warning in said)
    back.addFile(tmp_path / "robot.urdf")
    assert C.getJointDimension() == dofs
    assert back.getJointDimension() == dofs + ("panda" in name)  # the hand, which is outside of q in the scene
    joints = {joint.split(":")[0] for joint in C.getJointNames()}
    assert pairs(back, joints) == pairs(C, joints)
    assert "ur10" in name or pairs(C, joints)  # whose links do not collide with each other


@needs_pinocchio
def test_poses_of_an_own_robot_are_those_of_pinocchio(arm: Path) -> None:
    from pinocchio_poses import largestDifference

    assert largestDifference(str(arm), load(arm), seed=0, samples=20) < 1e-12


@needs_pinocchio
def test_pinocchio_reads_what_is_written_and_finds_the_same_poses(arm: Path, tmp_path: Path) -> None:
    from pinocchio_poses import largestDifference

    config = load(arm)
    config.writeURDF(tmp_path / "again.urdf")
    assert largestDifference(str(tmp_path / "again.urdf"), config, seed=1, samples=20) < 1e-12


def collection() -> list[Path]:
    """All URDF files of the package example-robot-data."""
    for entry in sys.path:
        folder = Path(entry) / "cmeel.prefix" / "share" / "example-robot-data" / "robots"
        if folder.is_dir():
            return sorted(folder.rglob("*.urdf"))
    return []


# The one without any link; Pinocchio refuses it as well.
EMPTY = "ur3"

ROBOTS = [file for file in collection() if file.stem != EMPTY] or [
    pytest.param(None, marks=pytest.mark.skip(reason="needs robots: pip install example-robot-data==6.0.0"))
]


@needs_pinocchio
@pytest.mark.robots
@pytest.mark.parametrize("file", ROBOTS, ids=lambda file: file.stem if file else "none")
def test_every_robot_of_the_collection_agrees_with_pinocchio(file: Path, tmp_path: Path) -> None:
    from pinocchio_poses import assertSameNumbers, largestDifference

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ry.KinegraphWarning)  # meshes that the collection itself lacks
        config = load(file)
        config.writeURDF(tmp_path / "again.urdf")
    assert largestDifference(str(file), config, seed=0, samples=20) < 1e-9
    assert largestDifference(str(tmp_path / "again.urdf"), config, seed=1, samples=5) < 1e-9
    assertSameNumbers(str(file), config)
