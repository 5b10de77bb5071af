"""Arguments of features: the calling forms of old and new scripts, scale and target, orders, and errors."""

import numpy as np
import pytest

import kinegraph as ry

SCENE = """
A: { X: "t(1 2 3) d(90 0 0 1)", shape: ssBox, size: [.4 .4 .2 .05] }
B: { X: "t(1.5 2 3) d(30 1 0 0)", shape: sphere, size: [.1] }
arm: { X: [0 0 1], shape: sphere, size: [.1], mass: 2 }
elbow(arm): { joint: hingeZ, limits: [-1 2] }
hand(elbow): { pre: [.5 0 0], joint: hingeX, mass: 1 }
"""


@pytest.fixture
def C():
    config = ry.Config()
    config.addText(SCENE)
    config.setJointState([0.3, -0.2])
    return config


def test_symbols_have_the_numbers_and_aliases_of_old_scripts():
    assert ry.FS.negDistance == ry.FS.distance == 29 and ry.FS.jointState == ry.FS.qItself == 31
    numbers = {int(symbol) for symbol in ry.FS.__members__.values()}
    assert set(range(53)) - {32} <= numbers and 32 not in numbers
    assert {"scalarProductZX", "scalarProductZY", "negDistance", "jointState"} <= set(ry.FS.__members__)


def test_a_value_comes_with_its_jacobian(C):
    y, J = C.eval(ry.FS.position, ["hand"])
    assert y.shape == (3,) and J.shape == (3, 2) and y.dtype == J.dtype == float
    [y2, J2] = C.evalFeature(ry.FS.position, ["hand"])
    assert np.array_equal(y, y2) and np.array_equal(J, J2)
    y, J = C.eval(ry.FS.qQuaternionNorms, [])
    assert y.shape == (0,) and J.shape == (0, 2)


def test_joint_states_are_q_or_the_dofs_of_some_joints(C):
    for frames in ([], ["elbow", "hand"]):
        y, J = C.eval(ry.FS.jointState, frames)
        assert np.array_equal(y, [0.3, -0.2]) and np.array_equal(J, np.eye(2))
    y, J = C.eval(ry.FS.jointState, ["hand"])
    assert np.array_equal(y, [-0.2]) and np.array_equal(J, [[0, 1]])
    assert np.array_equal(C.eval(ry.FS.jointState)[0], [0.3, -0.2])


def test_feature_objects_are_bound_to_names_and_evaluated_on_what_is_passed(C):
    F = C.feature(ry.FS.positionDiff, ["B", "A"])
    assert np.allclose(F.eval(C)[0], [0.5, 0, 0]) and F.dim(C) == 3
    assert "positionDiff" in F.description(C) and "B" in F.description(C)
    other = ry.Config()
    other.addText("B: { X: [0 0 1] }\nA: { X: [0 0 3] }")
    assert np.allclose(F.eval(other)[0], [0, 0, -2])
    assert np.allclose(F.setScale([2.0]).setTarget([0.1]).eval(C)[0], [0.8, -0.2, -0.2])
    with pytest.raises(ry.ArgumentError, match="order 1"):
        F.setOrder(1).eval(C)


@pytest.mark.parametrize("scale", [2.0, 2, [2.0], [2], np.array([2.0]), np.float64(2), [2, 2, 2], np.diag([2, 2, 2])])
def test_the_scale_is_a_number_a_vector_or_a_matrix(C, scale):
    y, J = C.eval(ry.FS.position, ["hand"])
    scaled, scaled_J = C.eval(ry.FS.position, ["hand"], scale)
    assert np.allclose(scaled, 2 * y) and np.allclose(scaled_J, 2 * J)


def test_a_matrix_may_change_the_number_of_rows_and_the_target_comes_first(C):
    y, J = C.eval(ry.FS.position, ["hand"])
    S = np.array([[1.0, 2, 3], [0, -1, 1]])
    scaled, scaled_J = C.eval(ry.FS.position, ["hand"], S, [1, 2, 3])
    assert np.allclose(scaled, S @ (y - [1, 2, 3])) and np.allclose(scaled_J, S @ J)
    assert np.allclose(C.eval(ry.FS.position, ["hand"], target=0.5)[0], y - 0.5)
    assert np.allclose(C.eval(ry.FS.gazeAt, ["B", "A"], [[1.0, 1.0]])[0], [-0.5])


def test_a_quaternion_is_compared_with_the_target_that_is_nearer(C):
    half = np.sqrt(0.5)
    assert np.allclose(np.abs(C.eval(ry.FS.quaternion, ["A"], [], [-1, 0, 0, 0])[0]), [1 - half, 0, 0, half])
    near = C.eval(ry.FS.pose, ["A"], [], [0, 0, 0, -1, 0, 0, 0])[0]
    assert np.allclose(near[:3], [1, 2, 3]) and np.allclose(np.abs(near[3:]), [1 - half, 0, 0, half])


@pytest.mark.parametrize(
    "arguments, parts",
    [
        ((ry.FS.position, ["hant"]), ["position", "'hant'", "hand"]),
        ((ry.FS.position, ["hand", "A"]), ["position takes 1 frame", "2"]),
        ((ry.FS.positionDiff, ["hand"]), ["positionDiff takes 2 frames", "1"]),
        ((ry.FS.position, ["hand"], [1.0, 2.0]), ["scale of position", "3"]),
        ((ry.FS.position, ["hand"], [], [1.0, 2.0]), ["target of position", "3"]),
        ((ry.FS.gazeAt, ["A", "B"], [[1.0, 0, 0]]), ["scale of gazeAt", "2 columns"]),
        ((ry.FS.position, ["hand"], [], [], 1), ["order 1", "2 consecutive configurations"]),
        ((ry.FS.angularVel, ["hand"]), ["angularVel", "2 consecutive"]),
        ((ry.FS.angularVel, ["hand"], [], [], 0), ["angularVel", "at least 1"]),
        ((ry.FS.linangVel, ["A", "B"]), ["linangVel takes 1 frame"]),
        ((ry.FS.energy, ["hand", "arm"]), ["energy", "2 consecutive"]),
        ((ry.FS.physics, ["arm"]), ["physics", "3 consecutive"]),
        ((ry.FS.transVelocities, []), ["transVelocities", "position with order"]),
        ((ry.FS.aboveBox, ["A", "B"]), ["aboveBox", "'B'", "ssBox"]),
        ((ry.FS.totalForce, ["A"]), ["totalForce", "'A'", "mass"]),
        ((ry.FS.jointState, ["A"]), ["'A'", "no active joint"]),
    ],
    ids=lambda value: None,
)
def test_mistakes_are_exceptions_that_say_what_was_expected(C, arguments, parts):
    with pytest.raises(ry.Error) as raised:
        C.eval(*arguments)
    for part in parts:
        assert part in str(raised.value)


def test_a_box_that_stands_on_another_is_standing_above():
    C = ry.Config()
    C.addText(
        "table: { X: [0 0 1], shape: ssBox, size: [1 1 .1 .01] }\n"
        "block: { X: [.2 .1 1.1], shape: ssBox, size: [.1 .1 .1 .01] }"
    )
    assert np.allclose(C.eval(ry.FS.standingAbove, ["block", "table"])[0], 0)


def test_collisions_are_those_of_the_present_state_without_being_computed_first():
    C = ry.Config()
    for i, x in enumerate((0.0, 0.15, 5.0)):
        C.addFrame(f"ball{i}").setShape(ry.ST.sphere, [0.1]).setPosition([x, 0, 0]).setContact(1)
    assert np.allclose(C.eval(ry.FS.accumulatedCollisions)[0], 0.05)
    assert np.allclose(C.eval(ry.FS.accumulatedCollisions, ["ball0", "ball2"])[0], 0.05)
    assert np.allclose(C.eval(ry.FS.accumulatedCollisions, ["ball2"])[0], 0)
    assert C.eval(ry.FS.pairCollisions)[0].shape == (3,)
    C.getFrame("ball2").setPosition([0.33, 0, 0])
    assert np.allclose(C.eval(ry.FS.accumulatedCollisions)[0], 0.07)


def test_a_gaze_stays_two_dimensional_in_a_problem(C):
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.gazeAt, ["A", "hand"], ry.OT.eq)
    assert komo.nlp().evaluate(C.getJointState())[0].shape == (2,)
