"""SRDF files: named states, groups of joints, and pairs that never collide."""

import copy
import itertools
import pickle
import warnings
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

URDF = """<robot name="arm">
  {links}
  <joint name="j1" type="revolute"><parent link="l0"/><child link="l1"/><axis xyz="0 0 -1"/>
    <origin xyz="0 0 .5"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="j2" type="continuous"><parent link="l1"/><child link="l2"/><axis xyz="0 1 0"/><origin xyz="0 0 .5"/></joint>
  <joint name="flange" type="fixed"><parent link="l2"/><child link="l3"/><origin xyz="0 0 .5"/></joint>
  <joint name="grip" type="prismatic"><parent link="l3"/><child link="l4"/><origin xyz="0 0 .5"/>
    <limit lower="0" upper=".1" effort="1" velocity="1"/></joint>
  <joint name="follow" type="prismatic"><parent link="l3"/><child link="l5"/><origin xyz="0 0 1"/>
    <limit lower="0" upper=".1" effort="1" velocity="1"/><mimic joint="grip"/></joint>
  <joint name="base" type="floating"><parent link="l0"/><child link="l6"/></joint>
</robot>""".format(
    links="".join(
        f'<link name="l{i}"><collision><geometry><sphere radius=".1"/></geometry></collision></link>' for i in range(7)
    )
)
SRDF = """<robot name="arm">
  <virtual_joint name="world" type="fixed" parent_frame="odom" child_link="l0"/>
  <group name="arm"><chain base_link="l0" tip_link="l3"/></group>
  <group name="hand"><joint name="grip"/><joint name="follow"/><passive_joint name="follow"/></group>
  <group name="all"><group name="arm"/><group name="hand"/></group>
  <group_state name="home" group="arm"><joint name="j1" value=".3"/><joint name="j2" value="-1"/><joint name="world" value="0"/></group_state>
  <group_state name="home" group="hand"><joint name="grip" value=".05"/><joint name="follow" value=".05"/></group_state>
  <group_state name="ready" group="arm"><joint name="j2" value="1"/></group_state>
  <group_state name="ready" group="all"><joint name="j2" value="2"/></group_state>
  <group_state name="away" group="all"><joint name="base" value="1 2 3 0 0 0.6 0.8"/></group_state>
  <end_effector name="tool" parent_link="l3" group="hand"/>
  <disable_collisions link1="l0" link2="l4" reason="Never"/>
  <disable_collisions link1="l4" link2="l5" reason="Adjacent"/>
  <disable_default_collisions link="l6"/>
  <enable_collisions link1="l6" link2="l5"/>
</robot>"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "arm.urdf").write_text(URDF)
    (tmp_path / "arm.srdf").write_text(SRDF)
    return tmp_path


@pytest.fixture
def arm(folder: Path) -> ry.Config:
    C = ry.Config()
    C.addFile(folder / "robot" / "arm.urdf")
    assert C.getStateNames() == [] and C.getJointGroups() == {}
    assert C.addFile(folder / "arm.srdf") is None
    return C


def pairs(C: ry.Config) -> set[frozenset[str]]:
    names = C.getCollidablePairs()
    return {frozenset(pair) for pair in zip(names[::2], names[1::2])}


def test_named_states_give_q_and_leave_other_joints_as_they_are(arm: ry.Config) -> None:
    q = arm.getJointState()
    assert arm.getJointNames()[:3] == ["j1", "j2", "grip"]
    assert arm.getStateNames() == ["home", "ready", "away"]
    assert arm.getStateNames("arm") == ["home", "ready"]
    np.testing.assert_array_equal(arm.getNamedState("home")[:3], [0.3, -1, 0.05])
    np.testing.assert_array_equal(arm.getNamedState("home", "hand")[:3], [0, 0, 0.05])
    np.testing.assert_array_equal(arm.getNamedState("ready", group="arm")[:3], [0, 1, 0])
    np.testing.assert_array_equal(arm.getJointState(), q)
    arm.setJointState(arm.getNamedState("away"))
    np.testing.assert_allclose(arm.getFrame("l6").getPose(), [1, 2, 3, 0.8, 0, 0, 0.6])


def test_states_that_are_not_there_or_not_clear_are_explained(arm: ry.Config) -> None:
    with pytest.raises(ry.NotFound, match="no state 'hme'; available: home, ready, away; similar names: home"):
        arm.getNamedState("hme")
    with pytest.raises(ry.NotFound, match="no group 'amr' .*similar names: arm"):
        arm.getNamedState("home", "amr")
    with pytest.raises(ry.ArgumentError, match="two values of joint 'j2': in group 'arm' and in group 'all'"):
        arm.getNamedState("ready")


def test_groups_are_lists_of_joints_to_select(arm: ry.Config) -> None:
    assert arm.getJointGroups() == {"arm": ["j1", "j2"], "all": ["j1", "j2", "grip"], "hand": ["grip"]}
    arm.selectJoints(arm.getJointGroups()["arm"])
    assert arm.getJointNames() == ["j1", "j2"]
    np.testing.assert_array_equal(arm.getNamedState("home"), [0.3, -1])


def test_disabled_pairs_never_collide(folder: Path, arm: ry.Config) -> None:
    free = ry.Config()
    free.addFile(folder / "robot" / "arm.urdf")
    gone = {frozenset(pair) for pair in [("l0_0", "l4_0"), ("l4_0", "l5_0")]}
    gone |= {frozenset((f"l{i}_0", "l6_0")) for i in (0, 1, 2, 3, 4)}
    shapes = [f"l{i}_0" for i in range(7)]
    fixed = {frozenset(("l2_0", "l3_0"))}  # to each other
    assert pairs(arm) == {frozenset(pair) for pair in itertools.combinations(shapes, 2)} - gone - fixed
    assert len(pairs(free)) < len(pairs(arm))  # without an SRDF links that are up to two joints above are left out
    assert frozenset(("l5_0", "l6_0")) in pairs(arm)


def test_srdf_semantics_survive_copies_and_files(arm: ry.Config, tmp_path: Path) -> None:
    arm.write(tmp_path / "saved.g")
    saved, twice, read = ry.Config(), ry.Config(), ry.Config()
    saved.addFile(tmp_path / "saved.g")
    read.addDict(arm.asDict())
    twice.addFile(tmp_path / "saved.g", "l_")
    for other in (saved, read, copy.deepcopy(arm), pickle.loads(pickle.dumps(arm))):
        assert pairs(other) == pairs(arm)
        assert other.getJointGroups() == arm.getJointGroups()
        np.testing.assert_array_equal(other.getNamedState("home"), arm.getNamedState("home"))
    assert twice.getJointGroups()["arm"] == ["l_j1", "l_j2"]
    np.testing.assert_array_equal(twice.getNamedState("home"), arm.getNamedState("home"))


def test_a_file_of_the_same_name_is_read_with_the_robot(folder: Path) -> None:
    for place in (folder / "robot" / "arm.srdf", folder / "srdf" / "arm.srdf"):
        place.parent.mkdir(exist_ok=True)
        place.write_text(SRDF.replace("</robot>", '<disable_collisions link1="no" link2="such"/></robot>'))
        C = ry.Config()
        with warnings.catch_warnings(record=True) as raised:
            warnings.simplefilter("always")
            C.addFile(folder / "robot" / "arm.urdf", "l_")
        assert [str(w.message).split("the scene has no ")[1] for w in raised] == ["link 'no'", "link 'such'"]
        assert C.getStateNames() == ["home", "ready", "away"] and C.getJointGroups()["arm"] == ["l_j1", "l_j2"]
        place.write_text("<robot>\n<group/></robot>")
        with pytest.warns(
            ry.KinegraphWarning, match="arm.srdf:2:1: the SRDF file beside the robot's file is ignored: .*'name'"
        ):
            ry.Config().addFile(folder / "robot" / "arm.urdf")
        place.unlink()


def test_prefixes_of_g_files_hold_for_it_as_well(folder: Path) -> None:
    (folder / "robot.g").write_text("Include: <robot/arm.urdf>\nInclude: <arm.srdf>")
    (folder / "two.g").write_text("Prefix: l_\nInclude: <robot.g>\nPrefix: r_\nInclude: <robot.g>")
    C = ry.Config()
    C.addFile(folder / "two.g")
    assert C.getJointGroups()["arm"] == ["l_j1", "l_j2", "r_j1", "r_j2"]
    assert {frozenset(("l_l0_0", "l_l4_0")), frozenset(("r_l0_0", "r_l4_0"))}.isdisjoint(pairs(C))
    assert frozenset(("l_l0_0", "r_l4_0")) in pairs(C)
    C = ry.Config()
    C.addFile(folder / "robot" / "arm.urdf", "a_")
    C.addFile(folder / "arm.srdf", "a_")
    assert C.getStateNames("arm") == ["home", "ready"]


def test_states_may_be_written_in_g_files() -> None:
    C = ry.Config()
    C.addText(
        "a: {}  b(a): { joint: transXY, joint_groups: [base], joint_states: { dock: [1 2], base: { out: [3 4] } } }"
    )
    np.testing.assert_array_equal(C.getNamedState("dock"), [1, 2])
    np.testing.assert_array_equal(C.getNamedState("out", "base"), [3, 4])
    D = ry.Config()
    D.addText("a: {}  b(a): { joint: hingeX, joint_states: { dock: [1 2] } }")
    with pytest.raises(ry.ArgumentError, match="frame 'b', state 'dock': expected 1 numbers, got"):
        D.getNamedState("dock")


MISTAKES = {
    "<link/>": "1:1: the root of an SRDF file is <robot>, not <link>",
    "<robot><group name='a'/><group name='a'/></robot>": "1:25: the group 'a' is already defined at .*1:8",
    "<robot><group name='a'><group name='b'/></group><group name='b'><group name='a'/></group></robot>": "contains itself: a > b > a",
    "<robot><group_state nme='a'/></robot>": "1:8: <group_state> has no attribute 'name'; similar names: nme",
    "<robot><group_state name='s'><joint name='j1' value='0 x'/></group_state></robot>": "1:47: state 's', joint 'j1': value=\"0 x\" is not a number",
    "<robot><disable_collisions link1='l0'/></robot>": "no attribute 'link2'",
    "<robot><disable_collisions link1='x' link2='y'/></robot>": "none of the links and joints .* add the robot first",
    "<robot><xacro:include/></robot>": "expand the file first",
    "<robot><group>": "bad.srdf:1:",
}
ODDITIES = {
    "<robot><disable_colisions/></robot>": "1:8: unknown element <disable_colisions>; similar names: disable_collisions",
    "<robot><disable_collisions link1='l0' link2='l11'/></robot>": "1:8: the scene has no link 'l11'; similar names: l1",
    "<robot><group name='g'><chain base_link='l3' tip_link='l0'/><joint name='j1'/></group></robot>": "'l3' is not above 'l0'",
    "<robot><group_state name='s' group='hnad'><joint name='j1' value='0'/></group_state><group name='hand'/></robot>": "1:30: no group 'hnad'; similar names: hand",
    "<robot><group_state name='s'><joint name='j1' value='0 1'/></group_state></robot>": "joint 'j1' has 1 dof, not 2",
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistakes_say_where_they_are_and_change_nothing(arm: ry.Config, tmp_path: Path, text: str) -> None:
    (tmp_path / "bad.srdf").write_text(text)
    before = arm.write()
    with pytest.raises(ry.ParseError, match=MISTAKES[text]):
        arm.addFile(tmp_path / "bad.srdf")
    assert arm.write() == before


@pytest.mark.parametrize("text", ODDITIES)
def test_suspicious_entries_are_warnings(arm: ry.Config, tmp_path: Path, text: str) -> None:
    (tmp_path / "odd.srdf").write_text(text)
    with pytest.warns(ry.KinegraphWarning, match=ODDITIES[text]):
        arm.addFile(tmp_path / "odd.srdf")


def test_a_missing_file_names_those_that_are_near(arm: ry.Config, folder: Path) -> None:
    with pytest.raises(ry.FileError, match="similar names: arm.srdf"):
        arm.addFile(folder / "amr.srdf")


def test_the_check_of_a_file_alone_is_about_the_file(folder: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ry.checkFile(folder / "arm.srdf")["messages"] == []
