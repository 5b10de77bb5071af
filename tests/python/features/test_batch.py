"""Many configurations in one call."""

import threading
import time

import numpy as np
import pytest

import kinegraph as ry
from interrupts import interrupt_after


def configurations(C, count, seed=1):
    lower, upper = C.getJointLimits()
    return np.random.default_rng(seed).uniform(lower - 0.05, upper + 0.05, (count, C.getJointDimension()))


def test_evalBatchGivesWhatEvalGives(panda):
    Q, before = configurations(panda, 20), panda.getJointState()
    y, J = panda.evalBatch(ry.FS.positionRel, ["l_gripper", "table"], Q, scale=[2.0], target=[0.1, 0.2, 0.3])
    assert y.shape == (20, 3) and J.shape == (20, 3, 7)
    np.testing.assert_array_equal(panda.getJointState(), before)
    for q, yi, Ji in zip(Q, y, J):
        panda.setJointState(q)
        one, jacobian = panda.eval(ry.FS.positionRel, ["l_gripper", "table"], [2.0], [0.1, 0.2, 0.3])
        np.testing.assert_allclose(yi, one, rtol=0, atol=1e-12)
        np.testing.assert_allclose(Ji, jacobian, rtol=0, atol=1e-12)


def test_nearestPointsOfAllPairs(panda):
    Q, pairs = configurations(panda, 12), panda.getCollidablePairs()
    d, points, normals = panda.getNearestPoints(Q)
    assert d.shape == (12, 46) and points.shape == (12, 46, 2, 3) and normals.shape == (12, 46, 3)
    np.testing.assert_array_equal(d, panda.getDistances(Q))
    np.testing.assert_allclose(points[:, :, 0] - points[:, :, 1], d[..., None] * normals, rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1, rtol=0, atol=1e-12)
    for i in (0, 5):
        panda.setJointState(Q[i])
        here = panda.getNearestPoints()
        assert [a.shape for a in here] == [(46,), (46, 2, 3), (46, 3)]
        for one, all_of_them in zip(here, (d, points, normals)):
            np.testing.assert_array_equal(one, all_of_them[i])
        for k in (0, 17, 44):
            frames = pairs[2 * k : 2 * k + 2]
            np.testing.assert_allclose(panda.eval(ry.FS.pairCollision_p1, frames)[0], here[1][k, 0], rtol=0, atol=1e-12)
            np.testing.assert_allclose(panda.eval(ry.FS.pairCollision_p2, frames)[0], here[1][k, 1], rtol=0, atol=1e-12)
            np.testing.assert_allclose(
                panda.eval(ry.FS.pairCollision_normal, frames)[0], here[2][k], rtol=0, atol=1e-12
            )
    ball = panda.addFrame("ball").setShape(ry.ST.sphere, [0.1]).setContact(1)
    more = panda.getNearestPoints()[0].shape[0]
    assert more == len(panda.getCollidablePairs()) // 2 > 46
    ball.setPosition([5.0, 0, 0])
    assert panda.getNearestPoints()[0].max() > 3
    with pytest.raises(ry.ArgumentError, match="getNearestPoints"):
        panda.getNearestPoints(np.zeros((2, 3)))


def test_frameJacobiansAreThoseOfVelocities(panda):
    Q = configurations(panda, 9)
    J = panda.getFrameJacobians(Q, ["l_gripper", "table"])
    assert J.shape == (9, 2, 6, 7)
    assert (J[:, 1] == 0).all()
    _, velocities = panda.evalBatch(ry.FS.position, ["l_gripper"], Q)
    np.testing.assert_allclose(J[:, 0, :3], velocities, rtol=0, atol=1e-12)
    axes, turns = panda.evalBatch(ry.FS.vectorX, ["l_gripper"], Q)
    for i in range(9):
        np.testing.assert_allclose(np.cross(J[i, 0, 3:].T, axes[i]).T, turns[i], rtol=0, atol=1e-12)
    with pytest.raises(ry.FrameNotFound, match="l_griper.*l_gripper"):
        panda.getFrameJacobians(Q, "l_griper")


def test_framePosesAreThoseOfEachConfiguration(panda):
    Q = configurations(panda, 10)
    X = panda.getFramePoses(Q, ["l_gripper", "table"])
    assert X.shape == (10, 2, 7)
    ids = [panda.getFrameNames().index(name) for name in ("l_gripper", "table")]
    for q, poses in zip(Q, X):
        panda.setJointState(q)
        np.testing.assert_allclose(poses, panda.getFrameState()[ids], rtol=0, atol=1e-12)


def test_distancesAreThoseOfThePairs(panda):
    Q = configurations(panda, 5)
    D = panda.getDistances(Q)
    names = panda.getCollidablePairs()
    pairs = list(zip(names[::2], names[1::2]))
    assert D.shape == (5, len(pairs))
    for q, distances in zip(Q, D):
        panda.setJointState(q)
        np.testing.assert_array_equal(distances, [-panda.eval(ry.FS.distance, list(pair))[0][0] for pair in pairs])


def test_validMeansWithinLimitsAndApart(panda):
    Q = configurations(panda, 300)
    lower, upper = panda.getJointLimits()
    within = (np.clip(Q, lower - 1e-5, upper + 1e-5) == Q).all(axis=1)
    nearest = panda.getDistances(Q).min(axis=1)
    for margin in (0.0, 0.03, -0.01):
        valid = panda.isValid(Q, margin=margin)
        assert valid.dtype == bool and valid.shape == (300,)
        np.testing.assert_array_equal(valid, within & (nearest >= margin))
        assert 0 < valid.sum() < 300


@pytest.mark.parametrize("threads", [2, 7])
def test_anyNumberOfThreadsGivesTheSameNumbers(panda, threads):
    Q = configurations(panda, 501)
    for call in (
        lambda n: panda.evalBatch(ry.FS.pose, ["l_gripper"], Q, threads=n)[1],
        lambda n: panda.getFramePoses(Q, ["l_gripper"], threads=n),
        lambda n: panda.getFrameJacobians(Q, ["l_gripper"], threads=n),
        lambda n: panda.getDistances(Q, threads=n),
        lambda n: panda.getNearestPoints(Q, threads=n)[1],
        lambda n: panda.isValid(Q, threads=n),
    ):
        np.testing.assert_array_equal(call(threads), call(1))


def reaches(panda, margin=0.0):
    """Motions between collision-free configurations among three posts; some of them collide."""
    for i, place in enumerate([[0.4, 0.2, 0.4], [-0.4, 0.3, 0.5], [0.0, 0.5, 0.6]]):
        panda.addFrame(f"post{i}", "table").setShape(ry.ST.capsule, [0.6, 0.05]).setContact(1).setRelativePosition(
            place
        )
    start, end = configurations(panda, 200), configurations(panda, 200, seed=2)
    both = panda.isValid(start, margin=margin + 1e-3) & panda.isValid(end, margin=margin + 1e-3)
    return start[both], end[both]


def test_motionsAreFreeWhereEachIs(panda):
    start, end = reaches(panda)
    free = panda.isMotionFree(start, end)
    assert free.dtype == bool and 0.1 < free.mean() < 0.9
    np.testing.assert_array_equal(free, [panda.checkMotion(a, b) is None for a, b in zip(start, end)])
    np.testing.assert_array_equal(panda.isMotionFree(start, end, threads=3), free)


def test_motionsKeepWhatManySamplesOfThemKeep(panda):
    start, end = reaches(panda, 0.01)
    free = panda.isMotionFree(start, end, margin=0.01)
    times = np.linspace(0.0, 1.0, 101)[:, None]
    nearest = np.array([panda.getDistances(a + times * (b - a)).min() for a, b in zip(start, end)])
    assert (nearest[free] >= 0.01).all()
    assert (nearest[~free] < 0.05).all(), "those that are reported come near"
    assert not free[nearest < 0.01].any()


def test_aMotionSaysWhereItFirstMeetsWhat(panda):
    start, end = reaches(panda)
    contacts = [panda.checkMotion(a, b) for a, b in zip(start, end)]
    found = 0
    for a, b, contact in zip(start, end, contacts):
        if contact is None:
            continue
        panda.setJointState(a + contact.time * (b - a))
        assert contact.distance == pytest.approx(-panda.eval(ry.FS.distance, list(contact.frames))[0][0], abs=1e-12)
        assert 0.0 <= contact.distance < 1e-5
        assert contact.frames[0] in repr(contact)
        found += 1
    assert found > 5


def test_motionsWithMistakesSayWhich(panda):
    q = panda.getJointState()
    with pytest.raises(ry.ArgumentError, match="end has 3 numbers; expected 7"):
        panda.checkMotion(q, [0.0, 0.0, 0.0])
    with pytest.raises(ry.ArgumentError, match="tolerance is 0"):
        panda.checkMotion(q, q, tolerance=0.0)
    with pytest.raises(ry.ArgumentError, match="2 starts and 1 ends"):
        panda.isMotionFree([q, q], [q])
    with pytest.raises(ry.ArgumentError, match="end has shape"):
        panda.isMotionFree([q], [[0.0, 0.0]])


def test_oneConfigurationGivesAnAnswerWithoutRows(panda):
    q = panda.getJointState() + 0.1
    y, J = panda.evalBatch(ry.FS.position, ["l_gripper"], q)
    many_y, many_J = panda.evalBatch(ry.FS.position, ["l_gripper"], [q])
    assert y.shape == (3,) and J.shape == (3, 7)
    np.testing.assert_array_equal(y, many_y[0])
    np.testing.assert_array_equal(J, many_J[0])
    np.testing.assert_array_equal(panda.getFramePoses(q, ["table"]), panda.getFramePoses([q], ["table"])[0])
    np.testing.assert_array_equal(panda.getFrameJacobians(q, "table"), panda.getFrameJacobians([q], "table")[0])
    np.testing.assert_array_equal(panda.getDistances(q), panda.getDistances([q])[0])
    for one, many in zip(panda.getNearestPoints(q), panda.getNearestPoints([q]), strict=True):
        np.testing.assert_array_equal(one, many[0])
    assert panda.isValid(q) == panda.isValid([q])[0]
    assert panda.isMotionFree(q, q) == panda.isMotionFree([q], [q])[0]


def test_anEmptyListIsNoConfigurations(panda):
    assert panda.getFramePoses([], ["table"]).shape == (0, 1, 7)
    assert panda.isValid([]).shape == panda.isMotionFree([], []).shape == (0,)


def test_noConfigurationsGiveEmptyArrays(panda):
    Q = np.zeros((0, 7))
    y, J = panda.evalBatch(ry.FS.position, ["l_gripper"], Q)
    assert y.shape == (0, 3) and J.shape == (0, 3, 7)
    assert panda.getFramePoses(Q, ["table"]).shape == (0, 1, 7)
    assert panda.isValid(Q).shape == (0,)


@pytest.mark.parametrize(
    "Q, words",
    [
        (np.zeros(6), r"\(6,\)"),
        (np.zeros((4, 6)), r"\(4, 6\)"),
        (np.zeros((2, 2, 7)), "3 dimensions"),
        (np.full((3, 7), np.nan), "row 0"),
    ],
)
def test_wrongShapesSayWhatIsExpected(panda, Q, words):
    calls = [
        lambda: panda.evalBatch(ry.FS.position, ["l_gripper"], Q),
        lambda: panda.getFramePoses(Q, ["l_gripper"]),
        lambda: panda.getDistances(Q),
        lambda: panda.isValid(Q),
    ]
    for call in calls:
        with pytest.raises(ry.ArgumentError, match=words):
            call()


def test_otherMistakesAreErrorsAsWell(panda):
    Q = np.zeros((2, 7))
    with pytest.raises(ry.ArgumentError, match="threads is 0"):
        panda.isValid(Q, threads=0)
    with pytest.raises(ry.FrameNotFound, match="l_griper.*l_gripper"):
        panda.getFramePoses(Q, ["l_griper"])
    with pytest.raises(ry.FrameNotFound, match="positionDiff"):
        panda.evalBatch(ry.FS.positionDiff, ["l_gripper", "nothing"], Q)
    with pytest.raises(ry.ArgumentError, match="angularVel"):
        panda.evalBatch(ry.FS.angularVel, ["l_gripper"], Q)


def test_otherThreadsRunMeanwhileAndMayChangeTheConfiguration(panda):
    Q = configurations(panda, 40000)
    expected = panda.isValid(Q)
    results = []
    worker = threading.Thread(target=lambda: results.append(panda.isValid(Q)))
    worker.start()
    edits = 0
    while worker.is_alive():
        panda.setJointState(Q[edits % 100])
        panda.getFrame("table").setRelativePosition([0.0, 0.0, 0.6])
        edits += 1
    worker.join()
    assert edits > 1, "the lock was held"
    np.testing.assert_array_equal(results[0], expected)


@pytest.mark.parametrize("threads", [1, 3])
def test_controlCStopsABatch(panda, threads):
    sample = np.zeros((20000, 7))
    start = time.perf_counter()
    panda.getDistances(sample, threads=threads)
    whole = 20 * (time.perf_counter() - start)  # the duration of the batch below
    with pytest.raises(KeyboardInterrupt), interrupt_after(0.1 * whole) as interrupt:
        panda.getDistances(np.zeros((400000, 7)), threads=threads)
    assert time.perf_counter() - interrupt.time < 0.5 * whole
