"""Features that a Python function computes."""

import signal
import threading

import numpy as np
import pytest

import kinegraph as ry

NAMES = ["l_gripper", "table"]


def offset(a, b):
    """positionDiff, without its Jacobian."""
    return a.getPosition() - b.getPosition()


def offsetWithJacobian(a, b):
    return a.getPosition() - b.getPosition(), a.getPositionJacobian() - b.getPositionJacobian()


@pytest.fixture
def reach(panda):
    panda.addFrame("target", "table").setShape(ry.ST.marker, [0.1]).setRelativePosition([0.0, 0.3, 0.3])
    return panda


@pytest.mark.parametrize("function, tolerance", [(offset, 1e-9), (offsetWithJacobian, 1e-12)])
def test_isEvaluatedAsABuiltInOne(panda, function, tolerance):
    y, J = panda.eval(function, NAMES, scale=[2.0], target=[0.1])
    expected, jacobian = panda.eval(ry.FS.positionDiff, NAMES, scale=[2.0], target=[0.1])
    np.testing.assert_allclose(y, expected, atol=1e-12)
    np.testing.assert_allclose(J, jacobian, atol=tolerance)
    assert J.shape == (3, 7)


def test_viewsOfFramesSayWhatFramesSay(panda):
    seen = []
    panda.eval(lambda frame: seen.append(frame) or 0.0, "l_gripper")
    view, frame = seen[0], panda.getFrame("l_gripper")
    panda.setJointState(panda.getJointState() + 0.1)
    panda.setJointState(panda.getJointState() - 0.1)
    assert view.name == "l_gripper" and "l_gripper" in repr(view)
    np.testing.assert_allclose(view.getPosition(), frame.getPosition(), atol=1e-12)
    np.testing.assert_allclose(view.getRotationMatrix(), frame.getRotationMatrix(), atol=1e-12)
    np.testing.assert_allclose(view.getPose(), np.concatenate([view.getPosition(), view.getQuaternion()]))
    np.testing.assert_allclose(abs(view.getQuaternion() @ frame.getQuaternion()), 1.0)
    np.testing.assert_allclose(view.getJointState(), panda.getJointState(), atol=1e-12)
    np.testing.assert_array_equal(view.getPositionJacobian(), panda.eval(ry.FS.position, ["l_gripper"])[1])


def test_jacobiansOfAPointAndOfTheRotationAreThoseOfDifferences(panda):
    point = np.array([0.1, -0.2, 0.3])

    def placed(frame):
        return frame.getPosition() + frame.getRotationMatrix() @ point, frame.getPositionJacobian(point)

    def axis(frame):
        z = frame.getRotationMatrix()[:, 2]
        return z, -np.cross(z, frame.getAngularJacobian(), axisa=0, axisb=0, axisc=0)

    for function in (placed, axis):
        J = panda.eval(function, ["l_gripper"])[1]
        differences = panda.eval(lambda f, function=function: function(f)[0], ["l_gripper"])[1]
        np.testing.assert_allclose(J, differences, atol=1e-8)


def test_withoutFramesItGetsQ(panda):
    y, J = panda.eval(lambda q: q[0] * q[3])
    q = panda.getJointState()
    assert y == pytest.approx([q[0] * q[3]])
    np.testing.assert_allclose(J[0], [q[3], 0, 0, q[0], 0, 0, 0], atol=1e-9)


def test_aNumberIsOneRowAndItsJacobianMayBeOne(panda):
    def height(frame):
        return frame.getPosition()[2], frame.getPositionJacobian()[2]

    y, J = panda.eval(height, ["l_gripper"])
    assert y.shape == (1,) and J.shape == (1, 7)
    assert panda.eval(lambda frame: (1.0, 2.0), ["l_gripper"])[0].tolist() == [1.0, 2.0]


def test_isAFeatureObjectToo(panda):
    feature = panda.feature(offset, NAMES).setTarget([0.0, 0.0, 0.5])
    expected = panda.eval(ry.FS.positionDiff, NAMES, target=[0.0, 0.0, 0.5])
    np.testing.assert_allclose(feature.eval(panda)[0], expected[0], atol=1e-12)
    assert feature.dim(panda) == 3
    assert "offset" in feature.description(panda)


@pytest.mark.parametrize("threads", [1, 3])
def test_runsInABatchOnAnyNumberOfThreads(panda, threads):
    Q = panda.getJointState() + 0.2 * np.random.default_rng(2).standard_normal((100, 7))
    y, J = panda.evalBatch(offset, NAMES, Q, threads=threads)
    expected, jacobians = panda.evalBatch(ry.FS.positionDiff, NAMES, Q)
    np.testing.assert_allclose(y, expected, atol=1e-12)
    np.testing.assert_allclose(J, jacobians, atol=1e-8)


def solveReach(C, feature, times=(1, 1, 0)):
    komo = ry.KOMO(C, *times, False)
    komo.addControlObjective([], 0, 1e-1)
    if times[2] > 0:
        komo.addControlObjective([], times[2], 1.0)
    komo.addObjective([1.0], feature, ["l_gripper", "target"], ry.OT.eq, [1e1])
    solver = ry.NLP_Solver(komo.nlp(), verbose=0)
    solver.setOptions(verbose=0, stopTolerance=1e-7)  # built-in features have second derivatives, and other steps
    return komo, solver.solve()


@pytest.mark.parametrize("function", [offset, offsetWithJacobian])
def test_solvesInverseKinematicsAsTheBuiltInOneDoes(reach, function):
    komo, result = solveReach(reach, function)
    assert result.feasible
    expected, _ = solveReach(reach, ry.FS.positionDiff)
    np.testing.assert_allclose(komo.getPath(), expected.getPath(), atol=1e-5)
    assert any("offset" in str(entry) for entry in komo.report().values())


def test_ordersAboveItsOwnAreDifferences(reach):
    paths = []
    for feature in (offset, ry.FS.positionDiff):
        komo = ry.KOMO(reach, 1, 4, 2, False)
        komo.addObjective([], feature, ["l_gripper", "target"], ry.OT.sos, [3.0], [], 2)
        komo.addObjective([1.0], feature, ["l_gripper", "target"], ry.OT.eq, [1.0], [], 1)
        nlp = komo.nlp()
        phi, triplets = nlp.evaluate(np.linspace(-0.5, 0.5, nlp.getDimension()))
        J = np.zeros((len(phi), nlp.getDimension()))
        np.add.at(J, (triplets[:, 0].astype(int), triplets[:, 1].astype(int)), triplets[:, 2])
        paths.append((phi, J))
    np.testing.assert_allclose(paths[0][0], paths[1][0], atol=1e-9)
    np.testing.assert_allclose(paths[0][1], paths[1][1], atol=1e-5)


def test_solvesAPathInAnotherThreadWhileThisOneRuns(reach):
    results = []
    worker = threading.Thread(target=lambda: results.append(solveReach(reach, offset, (1, 5, 1))[1]))
    worker.start()
    worker.join(60.0)
    assert results and results[0].feasible


@pytest.mark.parametrize(
    "function, words",
    [
        (lambda f: "word", "word|str"),
        (lambda f: None, "NoneType"),
        (lambda f: np.zeros((2, 2)), "rank 2"),
        (lambda f: (np.zeros(2), np.zeros((2, 6))), "2 x 6.*2 x 7"),
        (lambda f: (np.zeros(2), np.zeros((3, 7))), "3 x 7.*2 x 7"),
        (lambda f: (0.0, np.zeros(5)), "5 numbers.*1 x 7"),
    ],
)
def test_wrongReturnsAreErrorsThatNameTheFunction(panda, function, words):
    function.__name__ = "mine"
    with pytest.raises(ry.ArgumentError, match=f"mine.*({words})"):
        panda.eval(function, ["l_gripper"])


def test_anotherNumberOfRowsThanBeforeIsAnError(panda):
    sizes = iter([2, 3, 3])
    with pytest.raises(ry.ArgumentError, match="3 numbers; the first time 2"):
        panda.eval(lambda f: np.zeros(next(sizes)), ["l_gripper"])


def test_itsOwnErrorsComeThrough(reach):
    calls = []

    def fails(a, b):
        calls.append(a)
        if len(calls) > 3:
            raise RuntimeError("my own")
        return a.getPosition() - b.getPosition()

    with pytest.raises(RuntimeError, match="my own"):
        solveReach(reach, fails)


def test_whatIsNeitherSymbolNorFunctionIsRefused(panda):
    with pytest.raises(TypeError):
        panda.eval("position", ["l_gripper"])


class Interrupting:
    """The height of a frame; Ctrl-C comes in the call with this number."""

    __name__ = "interrupting"

    def __init__(self, at: int):
        self.at, self.calls = at, 0

    def __call__(self, frame):
        self.calls += 1
        if self.calls == self.at:
            signal.raise_signal(signal.SIGINT)
        return frame.getPosition()[2:], frame.getPositionJacobian()[2:]


def raisingKomo(panda, function) -> ry.KOMO:
    komo = ry.KOMO(panda, 1, 5, 1, False)
    komo.addControlObjective([], 1)
    komo.addObjective([], function, ["l_gripper"], ry.OT.eq, [10.0], [1.0])
    return komo


@pytest.mark.usefixtures("first_ctrl_c")
@pytest.mark.parametrize("way", ["solve", "solveAll", "solveFromMany"])
def test_ctrl_c_in_it_ends_a_solve_with_the_best_path_so_far(panda, way):
    height = Interrupting(10**9)
    komo = raisingKomo(panda, height)
    height.at = height.calls + 13  # in the third evaluation of five slices
    if way == "solve":
        ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    else:
        ret = (ry.solveAll([komo]) if way == "solveAll" else komo.solveFromMany(1)).best
    assert (ret.status.name, ret.message) == ("cancelled", "interrupted by Ctrl-C")
    assert height.calls <= height.at + 1, "it is not called again, but to count its rows"
    assert ret.x.shape == (35,) and np.isfinite(ret.x).all()
    np.testing.assert_array_equal(komo.getPath().ravel(), ret.x)
    assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible, "and it can go on"


def test_ctrl_c_before_there_is_a_path_or_outside_of_a_solve_is_an_interrupt(panda):
    height = Interrupting(10**9)
    komo = raisingKomo(panda, height)
    for call in (
        lambda: ry.NLP_Solver(komo.nlp(), verbose=0).solve(),
        lambda: ry.solveAll([komo]),
        lambda: komo.nlp().evaluate(np.zeros(35)),
        lambda: panda.eval(height, "l_gripper"),
    ):
        height.at = height.calls + 3
        with pytest.raises(KeyboardInterrupt):
            while True:
                call()


@pytest.mark.usefixtures("first_ctrl_c")
def test_ctrl_c_in_a_feature_within_a_problem_within_a_solve(panda):
    """Features that the function of a problem evaluates are part of that function."""
    height = Interrupting(10**9)

    def function(q):
        panda.setJointState(q)
        y, J = panda.eval(height, "l_gripper", target=[1.0])
        return y, J

    factory = ry.NLP_Factory()
    factory.setDimension(7)
    factory.setTypes([ry.OT.eq])
    factory.setEvalCallback(function)
    solver = ry.NLP_Solver(factory, verbose=0).setInitialization(panda.getJointState())
    height.at = 4
    ret = solver.solve()
    assert ret.status.name == "cancelled" and ret.message == "interrupted by Ctrl-C"
    assert np.isfinite(ret.x).all()
    assert solver.solve().feasible
