"""Configurations and frames: the calls of Python users, and the messages for mistakes."""

import copy
import re

import numpy as np
import pytest

import kinegraph as ry


def test_setters_give_back_the_frame_they_were_called_on():
    C = ry.Config()
    box = C.addFrame("box")
    chained = (
        box.setShape("box", [1, 2, 3])
        .setColor(0.5)
        .setMass(1)
        .setContact(1)
        .setPosition([0, 0, 1])
        .setQuaternion([1, 0, 0, 0])
    )
    assert chained is box


def test_lists_tuples_arrays_and_integers_are_taken_as_numbers():
    C = ry.Config()
    frame = C.addFrame("a")
    for numbers in (
        [1, 2, 3],
        (1, 2, 3),
        np.array([1, 2, 3]),
        np.array([1, 2, 3], dtype=np.float32),
        np.array([[1], [2], [3]]),
    ):
        assert np.allclose(frame.setPosition(numbers).getPosition(), [1, 2, 3])


def test_returned_arrays_are_copies(panda):
    q = panda.getJointState()
    q[0] = 1.0
    assert panda.getJointState()[0] == 0.0
    position = panda.getFrame("table").getPosition()
    position[:] = 9.0
    assert not np.allclose(panda.getFrame("table").getPosition(), 9.0)


def test_a_configuration_counts_iterates_and_contains_its_frames(panda):
    assert len(panda) == panda.getFrameDimension() == len(list(panda))
    assert "table" in panda and "chair" not in panda
    assert panda["table"] == panda.frame("table") == panda.getFrame("table") == panda.frame(panda["table"].ID)
    assert repr(panda) == f"<Config: {len(panda)} frames, 7 dofs>"


def test_copies_are_independent(panda):
    for other in (copy.copy(panda), copy.deepcopy(panda)):
        other.setJointState(np.ones(7))
        other.addFrame("extra")
        assert "extra" not in panda
        assert not np.allclose(panda.getJointState(), 1.0)


def test_prefixes_make_two_robots_of_one_file():
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"), "l_")
    C.addFile(ry.raiPath("panda/panda.g"), namePrefix="r_")
    assert C.getJointDimension() == 14
    assert C.getFrame("l_gripper").getPosition() == pytest.approx(C.getFrame("r_gripper").getPosition())


def test_world_and_relative_poses_compose():
    C = ry.Config()
    a = C.addFrame("a").setPose([1, 2, 3, np.sqrt(0.5), 0, 0, np.sqrt(0.5)])
    b = C.addFrame("b", "a").setRelativePosition([1, 0, 0])
    assert np.allclose(b.getPosition(), [1, 3, 3])
    assert np.allclose(b.getPosition(relativeTo=a), [1, 0, 0])
    assert np.allclose(a.getTransform() @ b.getRelativeTransform(), b.getTransform())
    assert np.allclose(b.setPosition([1, 2, 4]).getRelativePosition(), [0, 0, 1])


def test_a_deleted_frame_says_so(panda):
    table = panda.getFrame("table")
    panda.delFrame("table")
    with pytest.raises(ry.FrameDeleted, match="table"):
        table.getPosition()


def test_a_frame_outlives_the_name_of_its_configuration():
    frame = ry.Config().addFrame("a").setPosition([1, 2, 3])
    assert np.allclose(frame.getPosition(), [1, 2, 3])


def test_select_joints_makes_others_constant(panda):
    panda.selectJoints(["l_panda_joint1", "l_panda_joint2"])
    assert panda.getJointNames() == ["l_panda_joint1", "l_panda_joint2"]
    panda.setJointState([0.1, 0.2])
    assert np.allclose(panda.eval(ry.FS.position, ["l_gripper"])[1].shape, (3, 2))


def test_collisions_name_the_pair_and_its_depth():
    C = ry.Config()
    C.addFrame("a").setShape("box", [1, 1, 1]).setContact(1)
    C.addFrame("b").setShape("sphere", [0.5]).setContact(1).setPosition([0.9, 0, 0])
    assert [(a, b, round(d, 6)) for a, b, d in C.getCollisions()] == [("a", "b", -0.1)]
    assert C.coll_totalViolation() == pytest.approx(0.1)
    assert C.getCollisions(belowMargin=-0.2) == []


MISTAKES = [
    (lambda C: C.getFrame("l_griper"), ry.FrameNotFound, "l_griper.*l_gripper"),
    (lambda C: C.eval(ry.FS.position, ["l_griper"]), ry.FrameNotFound, "l_griper.*l_gripper"),
    (lambda C: C.setJointState([0, 0, 0]), ry.ArgumentError, "3.*7"),
    (lambda C: C.setJointState([np.nan] * 7), ry.ArgumentError, "finite"),
    (lambda C: C.getFrame("table").setPosition([0, 0]), ry.ArgumentError, "table.*2.*3"),
    (lambda C: C.getFrame("table").setQuaternion([0, 0, 0, 0]), ry.ArgumentError, "table"),
    (lambda C: C.getFrame("table").setShape("shpere", [1]), ry.Error, "shpere.*sphere"),
    (lambda C: C.getFrame("table").setShape(ry.ST.box, [1]), ry.ArgumentError, "box.*3"),
    (lambda C: C.getFrame("table").setColor([1, 2, 3, 4, 5]), ry.ArgumentError, "5"),
    (lambda C: C.addFrame("x", "tabel"), ry.FrameNotFound, "addFrame: .*tabel.*table"),
    (lambda C: C.delFrame("tabel"), ry.FrameNotFound, "delFrame: .*tabel.*table"),
    (lambda C: C.addFile(""), ry.FileError, "scene file '' does not exist"),
    (lambda C: C.getFrame("table").setMeshFile("x" * 3000), ry.FileError, "xxx"),
    (lambda C: C.getFrame("table").setJoint(ry.JT.hingeX, [np.nan, 1]), ry.ArgumentError, "table.*limit is nan"),
    (lambda C: C.getCollisions(np.nan), ry.ArgumentError, "margin is nan"),
    (lambda C: C.addFile("no_such_file.g"), ry.FileError, "no_such_file.g"),
    (lambda C: C.attach("table", "nothing"), ry.FrameNotFound, "nothing"),
    (lambda C: C.frame(1000), ry.Error, "1000"),
    (lambda C: C.addText("a: { shape: shpere }"), ry.ParseError, r"text:1:\d+.*shpere.*sphere"),
    (lambda C: C.addText("a: {}\nb (a): { joint: hingZ }"), ry.ParseError, r"text:2:\d+.*hingZ.*hingeZ"),
    (lambda C: C.addText("a: { shape: box, size: [1 1 }"), ry.ParseError, r"text:1:\d+"),
    (lambda C: C.addText("a (nowhere): {}"), ry.ParseError, r"text:1:\d+.*nowhere"),
    (lambda C: ry.raiPath("panda/pnda.g"), ry.FileError, "pnda.*panda/panda.g"),
    (lambda C: C.getFrame("l_panda_joint2").setParent(C.getFrame("l_gripper")), ry.Error, "l_panda_joint2"),
]


@pytest.mark.parametrize("mistake, kind, words", MISTAKES, ids=[words for _, _, words in MISTAKES])
def test_a_mistake_raises_a_typed_error_that_names_it_and_loses_nothing(panda, mistake, kind, words):
    before = panda.getFrameState()
    with pytest.raises(kind) as caught:
        mistake(panda)
    assert isinstance(caught.value, ry.Error)
    assert re.search(words, str(caught.value), re.DOTALL), str(caught.value)
    assert np.array_equal(panda.getFrameState(), before)


def test_a_syntax_error_carries_file_line_and_column(tmp_path):
    scene = tmp_path / "scene.g"
    scene.write_text("a: { shape: sphere, size: [.1] }\nb: { shape: sphere, size: [.1 }\n")
    with pytest.raises(ry.ParseError) as caught:
        ry.Config().addFile(scene)
    assert (caught.value.file, caught.value.line) == (str(scene), 2)
    assert caught.value.column > 1
    assert "b: { shape" in str(caught.value) and "^" in str(caught.value)


def test_a_name_that_is_taken_warns():
    C = ry.Config()
    first = C.addFrame("a")
    with pytest.warns(ry.KinegraphWarning, match="a"):
        assert C.addFrame("a") == first


def test_an_unknown_frame_is_none_where_a_script_asks_so(panda):
    assert panda.getFrame("nothing", False) is None


def test_frames_of_a_text_whose_names_are_taken_are_a_warning() -> None:
    C = ry.Config()
    C.addText("a: {}")
    with pytest.warns(ry.KinegraphWarning, match="text: duplicate frame names: 1 .a."):
        C.addText("a: {}  b: {}")


def test_a_frame_may_be_asked_for_twice_but_not_as_another_one() -> None:
    C = ry.Config()
    C.addFrame("table")
    box = C.addFrame("box", "table", "shape: sphere, size: [.1]")
    with pytest.warns(ry.KinegraphWarning, match="'box' already exists and is returned unchanged"):
        assert C.addFrame("box", C.getFrame("table")) == box
    with pytest.raises(ry.ArgumentError, match="below 'table', not below 'box2'; choose another name .such as 'box_2'"):
        C.addFrame("box", C.addFrame("box2"))
    assert C.getFrameNames() == ["table", "box", "box2"]


def test_joints_that_mimic_others_are_named_behind_those_of_q():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    arm = C.getJointNames()
    assert len(arm) == C.getJointDimension() == 7
    C.selectJoints([*arm, "l_panda_finger_joint1"])
    assert C.getJointNames() == [*arm, "l_panda_finger_joint1", "l_panda_finger_joint2"]
    assert C.getJointDimension() == 8  # the second finger mimics the first


def test_all_joints_but_some_do_not_include_the_fingers_that_a_file_leaves_out_of_q():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    arm = C.getJointNames()
    C.selectJoints(arm[6:], notThose=True)
    assert C.getJointNames() == arm[:6]
    C.selectJoints([], notThose=True)
    assert C.getJointNames() == arm
    C.addText("rail: {}\nslider (rail): { joint: transX, joint_active: 0 }")
    C.selectJoints([], notThose=True)
    assert C.getJointNames() == arm


def test_a_root_gets_a_joint_once_it_has_a_parent_as_the_error_says():
    C = ry.Config()
    box = C.addFrame("box")
    with pytest.raises(ry.ArgumentError, match="call setParent first"):
        box.setJoint(ry.JT.transX)
    box.setParent(C.addFrame("world")).setJoint(ry.JT.transX)
    assert C.getJointNames() == ["box"]


def test_a_frame_without_joint_is_attached_once_it_has_one_as_the_error_says():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box", "table").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setRelativePosition([0.3, 0.3, 0.1])
    before = box.getPosition()
    with pytest.raises(ry.ArgumentError, match=r"'box' has no joint.*setJoint\(JT.rigid\)"):
        C.attach("l_gripper", "box")
    box.setJoint(ry.JT.rigid)
    C.attach("l_gripper", "box")
    assert box.getParent().name == "l_gripper" and box.getPosition() == pytest.approx(before, abs=1e-9)


def test_swapped_limits_are_shown_in_the_right_order():
    C = ry.Config()
    frame = C.addFrame("arm", C.addFrame("world").name)
    with pytest.raises(ry.ArgumentError, match=r"expected \[lower, upper\]: \[-1 2\]"):
        frame.setJoint(ry.JT.hingeX, [2, -1])
    frame.setJoint(ry.JT.hingeX, [-1, 2])
    assert C.getJointLimits().tolist() == [[-1], [2]]


def test_scenes_written_beside_the_folder_of_models_find_them(tmp_path, monkeypatch):
    """Files of tutorials say <../../rai-robotModels/panda/panda.g>, which is beside the checkout of their author."""
    (tmp_path / "own").mkdir()
    scene = tmp_path / "own" / "scene.g"
    scene.write_text("Prefix: l_\nInclude: <../../rai-robotModels/panda/panda.g>\nPrefix: False\n")
    C = ry.Config()
    C.addFile(scene)
    assert "l_gripper" in C.getFrameNames()
    (tmp_path / "rai-robotModels" / "panda").mkdir(parents=True)  # existing files come first
    (tmp_path / "rai-robotModels" / "panda" / "panda.g").write_text("mine: {}")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "near.g").write_text("Include: <rai-robotModels/panda/panda.g>")
    D = ry.Config()
    D.addFile("near.g")
    assert D.getFrameNames() == ["mine"]
    scene.write_text("Include: <../../rai-robotModels/panda/panada.g>")
    with pytest.raises(ry.ParseError, match="rai-robotModels/panda/panada.g' does not exist"):
        ry.Config().addFile(scene)


def test_a_color_of_0_to_255_is_hardly_meant():
    C = ry.Config()
    with pytest.warns(ry.KinegraphWarning, match=r"numbers above 1; expected 0\.\.1"):
        C.addFrame("ball").setShape(ry.ST.sphere, [0.1]).setColor([255, 0, 0])
