"""Calls that once did something else in silence: they do it, warn, or refuse."""

from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry


@pytest.fixture
def lever() -> ry.Config:
    C = ry.Config()
    C.addText("""base: {}
j (base): { joint: hingeZ, limits: [-1 1], shape: ssBox, size: [.2 .1 .1 .01] }
wheel (base): { joint: hingeX }""")
    return C


def test_joints_without_limits_have_infinite_ones(lever: ry.Config) -> None:
    assert lever.getJointLimits().tolist() == [[-1, -np.inf], [1, np.inf]]
    assert (np.clip([5.0, 9.0], *lever.getJointLimits()) == [1, 9]).all()


def test_attributes_do_what_they_do_in_a_file(lever: ry.Config) -> None:
    f = lever.getFrame("j")
    f.setAttributes({"contact": 1, "limits": [-2, 2], "mass": 3.0, "q": 0.5, "ctrl_limits": [1.5, 2.5], "own": "text"})
    assert lever.getJointLimits()[:, 0].tolist() == [-2, 2] and lever.getJointState()[0] == 0.5
    assert f.getMass() == 3 and f.asDict()["contact"] == 1
    assert lever.getVelocityLimits()[0] == 1.5 and lever.getEffortLimits()[0] == 2.5
    assert f.getAttributes()["own"] == "text"
    before = f.asDict()
    for attributes, message in (
        ({"mass": 1, "shape": "box"}, "'shape' of frame 'j' has a meaning in files only; call setShape"),
        ({"limits": [1]}, "limits of its joint are 2 numbers"),
        ({"limits": [2, 1]}, "'j'"),
        ({"contact": 0.5}, "contact is 0.5; expected a whole number"),
    ):
        with pytest.raises(ry.ArgumentError, match=message):
            f.setAttributes(attributes)
    assert f.asDict() == before


def test_contact_exclude_is_set_as_in_a_file() -> None:
    C = ry.Config()
    C.addFrame("table").setShape(ry.ST.box, [1, 1, 0.1]).setContact(1)
    C.addFrame("foot").setShape(ry.ST.box, [0.1, 0.1, 0.1]).setPosition([0, 0, 0.05]).setContact(1)
    assert len(C.getCollisions(-0.01)) == 1
    with pytest.raises(ry.FrameNotFound, match="tabel.*table"):
        C.getFrame("foot").setAttributes({"contact_exclude": ["tabel"]})
    assert len(C.getCollisions(-0.01)) == 1
    C.getFrame("foot").setAttributes({"contact_exclude": ["table"]})
    assert not C.getCollisions(-0.01) and not C.getCollidablePairs()


@pytest.mark.parametrize(
    ("suffix", "hint"),
    [
        ("usd", "USD is not supported"),
        ("glb", "writeGltf"),
        ("json", "asDict"),
        ("png", "expected .g"),
        ("dae", "Collada"),
    ],
)
def test_a_scene_is_not_written_to_unknown_suffixes(lever: ry.Config, tmp_path: Path, suffix: str, hint: str) -> None:
    with pytest.raises(ry.ArgumentError, match=hint):
        lever.write(tmp_path / f"scene.{suffix}")
    assert not list(tmp_path.iterdir())
    lever.write(tmp_path / "scene.G")


def test_sizes_that_are_mended_or_in_millimeters_are_warned_of() -> None:
    C = ry.Config()
    with pytest.warns(ry.KinegraphWarning, match="setShape: frame 'plate'"):
        C.addFrame("plate").setShape(ry.ST.ssBox, [0.3, 0.3, 0.01, 0.02])
    can = C.addFrame("can", "plate").setJoint(ry.JT.rigid).setMass(0.3)
    with pytest.warns(ry.KinegraphWarning, match="frame 'can': its cylinder is 120 m large; did you mean meters"):
        can.setShape("cylinder", [120, 33])
    C.addFrame("floor").setShape(ry.ST.box, [50, 50, 0.1])


def test_degrees_and_another_order_of_quaternions_are_asked_about(lever: ry.Config) -> None:
    with pytest.warns(ry.KinegraphWarning, match="did you mean radians"):
        lever.setJointState([45.0, 0.0])
    lever.setJointState([1.5, 0.0])  # slightly beyond a limit
    with pytest.warns(ry.KinegraphWarning, match="The order is w x y z"):
        lever.getFrame("base").setQuaternion([0, 0, 0, 1])
    plan = ry.planMotion(lever, [45.0, 0.0], start=[0.0, 0.0])
    assert not plan.feasible and "did you mean radians" in plan.message


def test_what_a_joint_does_not_express_of_a_pose_is_warned_of() -> None:
    C = ry.Config()
    C.addFrame("a").setPosition([1, 0, 0])
    frame = C.addFrame("b", "a").setRelativePosition([0, 0, 0.5])
    lost = "setJoint: the joint of frame 'b', hingeX, does not allow this pose: the frame is 0.5 m away"
    with pytest.warns(ry.KinegraphWarning, match=lost):
        frame.setJoint(ry.JT.hingeX)
    for name, call, value in (
        ("setRelativePosition", frame.setRelativePosition, [0, 0.1, 0]),
        ("setPosition", frame.setPosition, [0, 0, 0.1]),
        ("setQuaternion", frame.setQuaternion, [0.6, 0, 0.8, 0]),
        ("setRotationMatrix", frame.setRotationMatrix, [0, 0, 1, 1, 0, 0, 0, 1, 0]),
        ("setPose", frame.setPose, "t(0 0 1)"),
        ("setRelativePose", frame.setRelativePose, [0, 0, 0, 0.6, 0, 0.8, 0]),
    ):
        with pytest.warns(ry.KinegraphWarning, match=f"{name}: the joint of frame 'b', hingeX, does not allow"):
            call(value)
    frame.setRelativePose([0, 0, 0, 0.6, 0.8, 0, 0])  # a rotation about x
    C.addFrame("c", "a").setRelativePosition([0, 0, 0.5]).setJoint(ry.JT.rigid).setJoint(ry.JT.free)
    C.getFrame("c").setPose([1, 2, 3, 0.6, 0, 0.8, 0])
    C.addFrame("slider", "a").setRelativePosition([0.5, 0, 0]).setJoint(ry.JT.transX).setPosition([3, 0, 0])
    assert C.getJointState()[-1] == pytest.approx(2)


@pytest.mark.parametrize(
    ("word", "meant"), [("contcat", "contact"), ("mas", "mass"), ("colour", "color"), ("frictoin", "friction")]
)
def test_a_misspelled_attribute_is_asked_about(lever: ry.Config, word: str, meant: str) -> None:
    question = f"frame 'j': unknown attribute '{word}'; did you mean '{meant}'"
    with pytest.warns(ry.KinegraphWarning, match=question):
        lever.getFrame("j").setAttributes({word: 1.0})
    with pytest.warns(ry.KinegraphWarning, match=question):
        lever.getFrame("j").setAttribute(word, 1.0)
    with pytest.warns(ry.KinegraphWarning, match=question):
        lever.getFrame("j").addAttributes({word: 1.0})
    with pytest.warns(ry.KinegraphWarning, match=f"'{word}'; did you mean '{meant}'"):
        lever.addFrame("new", "", f"{word}: 1")


def test_own_words_of_attributes_are_stored_without_a_question(lever: ry.Config) -> None:
    lever.getFrame("j").setAttributes({"id": 3, "price": 2.5, "tag": "a", "owner": "lab"})
    assert lever.getFrame("j").getAttributes()["price"] == 2.5


def test_a_box_has_no_rounding(lever: ry.Config) -> None:
    with pytest.warns(ry.KinegraphWarning, match="a box has no rounding, so its fourth number 0.02 is not used"):
        lever.getFrame("j").setShape(ry.ST.box, [0.1, 0.1, 0.1, 0.02])
    with pytest.warns(ry.KinegraphWarning, match="a box has no rounding"):
        lever.addText("crate: { shape: box, size: [.1 .1 .1 .02] }")
    lever.getFrame("j").setShape(ry.ST.box, [0.1, 0.1, 0.1, 0])  # as in older files
    assert lever.getFrame("j").getSize().tolist() == [0.1, 0.1, 0.1]
