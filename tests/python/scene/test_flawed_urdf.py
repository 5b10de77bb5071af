"""Flaws of URDF and MJCF files that concern motion and mass: limits, inertias, names."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from flawed_robots import urdf


@pytest.mark.parametrize(
    "joint, limits",
    [
        ('<limit lower="1" upper="-1" effort="5" velocity="1"/>', None),  # of PyBullet's models: unlimited
        ('<limit lower="0.5" upper="0.5" effort="5" velocity="1"/>', [0.5, 0.5]),
        ('<limit lower="1" upper="-Infinity" effort="5" velocity="1"/>', None),
        ('<limit effort="5" velocity="1"/>', [0, 0]),  # as in Pinocchio
    ],
)
def test_limits_are_mended_as_others_do(joint: str, limits: list[float] | None, tmp_path: Path) -> None:
    with pytest.warns(ry.KinegraphWarning, match="joint 'j'"):
        C = urdf(tmp_path, "", joint, "revolute")
    found = C.getJointLimits()[:, 0]
    assert found[0] > found[1] or not np.isfinite(found).all() if limits is None else list(found) == limits


def test_infinite_limits_are_read_in_any_spelling(tmp_path: Path) -> None:
    for word in ("inf", "INF", "Infinity", "infinity"):
        limit = f'<limit lower="-{word}" upper="+{word}" effort="5" velocity="1"/>'
        C = urdf(tmp_path, "", limit, "revolute")
        assert C.getJointLimits().ravel().tolist() == [-np.inf, np.inf] and C.fileWarnings() == []


INERTIAS = [
    ((0.0, 0.0, 0.0), "its inertia is zero although its mass is 2.5 kg; it is read as a point mass"),
    ((-1e-20, 0.0, 1e-20), "its inertia is zero although its mass is 2.5 kg"),  # as iCub has, by rounding
    ((-0.1, 0.1, 0.1), "its inertia has a negative principal moment .*it is left out"),
    ((1.0, 0.01, 0.01), "its principal moments of inertia .* are impossible: one exceeds the sum of the other two"),
    ((0.1, 0.1, 0.1), ""),
    ((0.05, 0.05, 0.1), ""),  # a thin disk
    ((0.0495, 0.05, 0.1), ""),  # a disk, rounded
]


def robot_with_inertia(kind: str, moments: tuple[float, ...], folder: Path) -> tuple[Path, int]:
    """A file whose link `b` has a mass of 2.5 kg and these moments, and the line that says so."""
    x, y, z = moments
    if kind == "urdf":
        text = f"""<robot name="r"><link name="a"/><link name="b">
<inertial><mass value="2.5"/><inertia ixx="{x}" iyy="{y}" izz="{z}" ixy="0" ixz="0" iyz="0"/></inertial>
</link><joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>"""
    elif kind == "xml":
        text = f"""<mujoco><worldbody><body name="b">
<inertial pos="0 0 0" mass="2.5" diaginertia="{x} {y} {z}"/>
<joint name="j"/></body></worldbody></mujoco>"""
    else:
        text = f"a: {{}}\nb (a): {{ joint: hingeZ, mass: 2.5, inertia: [{x} {y} {z}] }}\n"
    file = folder / f"r.{kind}"
    file.write_text(text)
    return file, 2


@pytest.mark.parametrize(("moments", "message"), INERTIAS)
@pytest.mark.parametrize("kind", ["urdf", "xml", "g"])
def test_an_inertia_that_no_body_has_is_told(
    kind: str, moments: tuple[float, ...], message: str, tmp_path: Path
) -> None:
    if kind == "g" and not any(moments):
        message = ""  # a point mass on purpose
    file, line = robot_with_inertia(kind, moments, tmp_path)
    found = [m for m in ry.checkFile(file)["messages"] if "inertia" in m.split("\n")[0]]
    C = ry.Config()
    if not message:
        C.addFile(file, strict=True)
        assert found == [] and C.fileWarnings() == []
        return
    assert len(found) == 1 and f"{file.name}:{line}:" in found[0]
    with pytest.raises(ry.ParseError, match=message):
        C.addFile(file, strict=True)
    with pytest.warns(ry.KinegraphWarning, match=message):
        C.addFile(file)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the simulation says that it uses the mean of the moments
        S = ry.Simulation(C)  # whatever was assumed can be simulated
    S.step([], 0.01, ry.ControlMode.none)
    assert np.isfinite(C.getFrame("b").getPose()).all()


def test_mujoco_balances_inertias_without_a_warning(tmp_path: Path) -> None:
    file, _ = robot_with_inertia("xml", (1.0, 0.01, 0.01), tmp_path)
    file.write_text(file.read_text().replace("<worldbody>", '<compiler balanceinertia="true"/><worldbody>'))
    C = ry.Config()
    C.addFile(file, strict=True)
    assert C.fileWarnings() == []


@pytest.mark.parametrize("kind, effort", [("revolute", "-1"), ("continuous", "-1"), ("prismatic", "0")])
def test_motors_without_positive_limits_have_none(kind: str, effort: str, tmp_path: Path) -> None:
    limit = f'<axis xyz="0 0 1"/><limit lower="0" upper="1" effort="{effort}" velocity="-2"/>'
    with pytest.warns(ry.KinegraphWarning, match=r"r.urdf:1:\d+: joint 'j': its effort and velocity are .*no limit"):
        C = urdf(tmp_path, "", limit, kind)
    assert C.getEffortLimits().tolist() == C.getVelocityLimits().tolist() == [np.inf]


def test_an_axis_without_numbers_is_told(tmp_path: Path) -> None:
    with pytest.warns(ry.KinegraphWarning, match="joint 'j': <axis> has no attribute 'xyz'; it is read as 1 0 0"):
        C = urdf(tmp_path, "", "<axis/>")
    C.setJointState([np.pi / 2])
    np.testing.assert_allclose(C.eval(ry.FS.vectorY, ["b"])[0], [0, 0, 1], atol=1e-12)


def mjcf(folder: Path, body: str, more: str = "") -> ry.Config:
    file = folder / "m.xml"
    file.write_text(f"<mujoco>{more}<worldbody>{body}</worldbody></mujoco>")
    C = ry.Config()
    C.addFile(file)
    return C


def test_ranges_of_mjcf_files_may_be_infinite(tmp_path: Path) -> None:
    body = '<body><joint name="j" type="slide" range="{}"/><geom size="1"/></body>'
    motor = '<actuator><motor joint="j" forcerange="-inf inf"/></actuator>'
    for text, limits in [("-inf inf", [-np.inf, np.inf]), ("-1 Infinity", [-1, np.inf])]:
        C = mjcf(tmp_path, body.format(text), motor)
        assert C.getJointLimits().ravel().tolist() == limits
        assert C.getEffortLimits().tolist() == [np.inf] and C.fileWarnings() == []
    with pytest.raises(ry.ParseError, match="expected 2 numbers"):
        mjcf(tmp_path, body.format("nan 1"))


@pytest.mark.parametrize(
    "more, told",
    [
        ('<option><flag contact="disable"/></option>', 'contact="disable": shapes collide here'),
        ('<option><flag gravity="disable"/></option>', "not part of the simulation: flag gravity=disable"),
        ('<asset><mesh name="m" builtin="cone"/></asset>', "'builtin', whose meshes are not made"),
    ],
)
def test_settings_of_mujoco_without_a_counterpart_are_told(more: str, told: str, tmp_path: Path) -> None:
    geom = '<geom type="mesh" mesh="m" mass="1"/>' if "asset" in more else '<geom size=".1"/>'
    with pytest.warns(ry.KinegraphWarning, match=rf"m.xml:1:\d+: .*{told}"):
        mjcf(tmp_path, f'<body name="b"><joint/>{geom}</body>', more)


def test_a_joint_with_equal_limits_starts_there(tmp_path: Path) -> None:
    with pytest.warns(ry.KinegraphWarning, match="both of its limits are 0.5; the joint cannot move"):
        C = urdf(tmp_path, joint='<limit lower=".5" upper=".5" effort="1" velocity="1"/>', type="revolute")
    assert C.getJointState() == [0.5]
    C = ry.Config()
    C.addText(
        "w: {}\na (w): { joint: transXY, limits: [-1 .3 1 .3] }\nb (a): { joint: hingeX, limits: [.5 .5], q: .2 }"
    )
    np.testing.assert_array_equal(C.getJointState(), [0, 0.3, 0.2])  # a given q counts
    C.getFrame("b").setAttributes({"limits": [0.7, 0.7]})
    assert C.getFrame("b").getJointState() == [0.7]
    with pytest.warns(ry.KinegraphWarning, match="does not allow this pose"):
        C.addFrame("c", "b").setJoint(ry.JT.hingeX, limits=[0.4, 0.4])
    assert C.getFrame("c").getJointState() == [0.4]


@pytest.mark.parametrize(
    "shape, joint, question",
    [
        ("", '<origin xzy="1 0 0"/>', "joint 'j': unknown attribute 'xzy' of <origin> is ignored; did you mean 'xyz'?"),
        ("", '<axes xyz="0 1 0"/>', "joint 'j': unknown element <axes> of <joint> is ignored; did you mean 'axis'?"),
        ("", '<limits effort="1" velocity="1"/>', "unknown element <limits> of <joint>"),
        ("<visuals/>", "", "link 'a': unknown element <visuals> of <link>"),
        ('<inertial><mass value="1"/><inertia iyx="0" ixx="1" iyy="1" izz="1"/></inertial>', "", "did you mean 'ixy'?"),
    ],
)
def test_misspelled_names_in_a_urdf_file_are_asked_about(shape: str, joint: str, question: str, tmp_path: Path) -> None:
    with pytest.warns(ry.KinegraphWarning, match=re.escape(question)):
        urdf(tmp_path, shape, joint)


def test_extensions_of_a_urdf_file_are_not_asked_about(tmp_path: Path) -> None:
    shape = '<self_collision_checking/><contact><lateral_friction value="1"/></contact>'
    urdf(tmp_path, shape, '<origin xyz="1 0 0"/><transmission/><dynamics damping="1" spring_stiffness="2"/>')


def test_fixed_joints_need_no_limits_of_motors(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        urdf(tmp_path, joint='<limit lower="0" upper="0"/>', type="fixed")
        urdf(tmp_path, joint='<limit effort="0" velocity="0"/>', type="floating")


def test_equal_limits_of_quaternions_do_not_move_a_joint() -> None:
    C = ry.Config()
    C.addText("w: {}\nb (w): { joint: free, limits: [-1 -1 -1 0 0 0 0 1 1 1 0 0 0 0] }")
    assert list(C.getFrame("b").getPose()) == [0, 0, 0, 1, 0, 0, 0]


def test_numbers_may_have_commas_between_them(tmp_path: Path) -> None:
    with pytest.warns(ry.KinegraphWarning, match='<origin> xyz="1, 2 3": the commas are read as blanks'):
        C = urdf(tmp_path, "", '<origin xyz="1, 2 3"/>')
    assert C.getFrame("b").getPosition().tolist() == [1, 2, 3]
    with pytest.raises(ry.ParseError, match='xyz="1,5 2 3": expected 3 numbers'):
        urdf(tmp_path, "", '<origin xyz="1,5 2 3"/>')
    with pytest.raises(ry.ParseError, match="expected 3 numbers; this is xacro: give the file a name that ends with"):
        urdf(tmp_path, "", '<origin xyz="$(optenv PLACE 0 0 1)"/>')
    (tmp_path / "m.xml").write_text('<mujoco><worldbody><body name="b" pos="1,2,3"/></worldbody></mujoco>')
    C = ry.Config()
    with pytest.warns(ry.KinegraphWarning, match='pos="1,2,3": the commas are read as blanks'):
        C.addFile(tmp_path / "m.xml")
    assert C.getFrame("b").getPosition().tolist() == [1, 2, 3]
    for friction in ("0,8", "0," + "8" * 100):  # 0.8, or two numbers
        (tmp_path / "m.xml").write_text(
            f'<mujoco><worldbody><geom size="1" friction="{friction}"/></worldbody></mujoco>'
        )
        with pytest.raises(ry.ParseError, match=r'friction="0,8{1,58}(\.\.\.)?": expected 1 to 3 numbers'):
            ry.Config().addFile(tmp_path / "m.xml")


def test_a_mass_is_finite() -> None:
    with pytest.raises(ry.ArgumentError, match="mass inf kg is not zero, or positive and finite"):
        ry.Config().addFrame("a").setMass(np.inf)
