"""Results of eval belong to the caller. A repeated call gives the same result, although it skips conversions and reuses
released arrays."""

import copy
import weakref

import numpy as np
import pytest

import kinegraph as ry

ARM = """
base: {}
joint1(base): { joint: hingeZ }
tip(joint1): { Q: [.5 0 .1] }
other(base): { Q: [0 1 0] }
"""
FRAMES = ["tip", "other"]


@pytest.fixture
def arm():
    C = ry.Config()
    C.addText(ARM)
    return C


def anew(q, *arguments):
    """The result of a fresh configuration."""
    C = ry.Config()
    C.addText(ARM)
    C.setJointState(q)
    return C.eval(*arguments)


def test_stored_results_do_not_change(arm):
    angles = np.linspace(-1, 1, 7)
    kept = []
    for q in angles:
        arm.setJointState([q])
        kept.append(arm.eval(ry.FS.positionDiff, FRAMES))
    for q, (y, J) in zip(angles, kept):
        expected = anew([q], ry.FS.positionDiff, FRAMES)
        assert np.array_equal(y, expected[0]) and np.array_equal(J, expected[1])


def test_a_view_keeps_its_numbers(arm):
    J = arm.eval(ry.FS.position, ["tip"])[1]
    row = J[1]
    del J
    arm.setJointState([1.0])
    for _ in range(3):
        arm.eval(ry.FS.position, ["tip"])
    assert row.tolist() == [0.5]


@pytest.mark.parametrize(
    "change",
    [
        lambda J: setattr(J, "shape", (1, 3)),
        lambda J: J.setflags(write=False),
        lambda J: setattr(J, "dtype", np.int64),
        lambda J: setattr(J, "dtype", ">f8"),
        lambda J: J.resize((6, 1), refcheck=False),
        lambda J: J.fill(np.nan),
    ],
    ids=["shape", "read-only", "dtype", "byte order", "resize", "numbers"],
)
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_what_is_done_to_a_result_is_not_seen_in_later_ones(arm, change):
    for _ in range(4):
        y, J = arm.eval(ry.FS.position, ["tip"])
        assert J.dtype == float and J.flags.writeable and np.array_equal(J, [[0], [0.5], [0]])
        assert np.array_equal(y, [0.5, 0, 0.1])
        change(J)
        del J


def test_who_watches_a_result_sees_it_end(arm):
    y, J = arm.eval(ry.FS.position, ["tip"])
    watched = weakref.ref(J)
    del y, J
    again = arm.eval(ry.FS.position, ["tip"])
    assert watched() is None or watched() is not again[1]


def test_positions_of_frames_are_their_owners(arm):
    tip = arm.getFrame("tip")
    positions = []
    for q in (0.0, 0.5, 1.0):
        arm.setJointState([q])
        positions.append(tip.getPosition())
    expected = [[0.5 * np.cos(q), 0.5 * np.sin(q), 0.1] for q in (0.0, 0.5, 1.0)]
    assert np.allclose(positions, expected, atol=1e-15)
    position = tip.getPosition()
    position.setflags(write=False)
    del position
    assert tip.getPosition().flags.writeable


def test_scale_and_target_are_those_of_the_call(arm):
    plain = arm.eval(ry.FS.positionDiff, FRAMES)[0]
    assert np.array_equal(arm.eval(ry.FS.positionDiff, FRAMES, [2.0], [0.5])[0], 2 * (plain - 0.5))
    assert np.array_equal(arm.eval(ry.FS.positionDiff, FRAMES)[0], plain)
    assert arm.eval(ry.FS.positionDiff, FRAMES, [[1, 0, 0]])[0].shape == (1,)
    assert np.array_equal(arm.eval(ry.FS.positionDiff, FRAMES)[0], plain)
    with pytest.raises(ValueError, match="scale of positionDiff"):
        arm.eval(ry.FS.positionDiff, FRAMES, [1.0, 2.0])
    assert np.array_equal(arm.eval(ry.FS.positionDiff, FRAMES)[0], plain)


def test_edits_of_the_structure_are_followed(arm):
    call = (ry.FS.position, ["tip"])
    assert np.array_equal(arm.eval(*call)[0], [0.5, 0, 0.1])
    arm.addFrame("slider", "other").setJoint(ry.JT.transX)
    assert arm.eval(*call)[1].shape == (3, 2)
    arm.delFrame("tip")
    with pytest.raises(ry.FrameNotFound, match="'tip'"):
        arm.eval(*call)


def test_a_list_that_is_changed_asks_another_question(arm):
    frames = ["tip"]
    first = arm.eval(ry.FS.position, frames)[0]
    frames[0] = "other"
    assert np.array_equal(arm.eval(ry.FS.position, frames)[0], [0, 1, 0])
    assert np.array_equal(first, [0.5, 0, 0.1])


def test_frames_may_be_a_name_a_list_or_a_tuple(arm):
    for _ in range(2):
        for frames in ("tip", ["tip"], ("tip",), np.array(["tip"]).tolist()):
            assert np.array_equal(arm.eval(ry.FS.position, frames)[0], [0.5, 0, 0.1])
        for i in range(20):
            made = "".join(["t", "i", "p"]) if i % 2 else "tip"
            assert np.array_equal(arm.eval(ry.FS.position, [made])[0], [0.5, 0, 0.1])


def test_wrong_arguments_raise_each_time(arm):
    for _ in range(2):
        for arguments in [(ry.FS.position, 3), (ry.FS.position, [3]), ("position", ["tip"]), (None, ["tip"])]:
            with pytest.raises(TypeError):
                arm.eval(*arguments)
        with pytest.raises(ValueError, match="order"):
            arm.eval(ry.FS.position, ["tip"], order=1)
        assert arm.eval(ry.FS.position, ["tip"])[0].shape == (3,)


def test_copies_answer_for_themselves(arm):
    arm.eval(ry.FS.position, ["tip"])
    other = copy.copy(arm)
    other.setJointState([np.pi / 2])
    assert np.allclose(other.eval(ry.FS.position, ["tip"])[0], [0, 0.5, 0.1], atol=1e-15)
    assert np.array_equal(arm.eval(ry.FS.position, ["tip"])[0], [0.5, 0, 0.1])


def test_joint_states_may_be_any_numbers(arm):
    for q in ([0.25], (0.25,), np.array([0.25]), np.array([[0.25]]), np.array([0.25, 1.0])[:1], np.float32(0.25), 0.25):
        arm.setJointState([0.0])
        arm.setJointState(q)
        assert arm.getJointState().tolist() == [0.25]
    for wrong in ([0.1, 0.2], [np.nan], np.zeros((2, 2))):
        with pytest.raises(ValueError):
            arm.setJointState(wrong)
    assert arm.getJointState().tolist() == [0.25]
