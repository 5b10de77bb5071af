"""Several problems at once, and motion problems from several starts."""

import concurrent.futures
import copy
import multiprocessing
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import kinegraph as ry

WANTED = [np.pi / 2, -np.pi / 2]


@pytest.fixture
def arm() -> ry.Config:
    C = ry.Config()
    C.addText(
        "world {} shoulder (world) { joint: hingeZ, limits: [-3 3] } upper (shoulder) { pose: [1 0 0] }"
        "elbow (upper) { joint: hingeZ, limits: [-3 3] } tip (elbow) { pose: [1 0 0] }"
    )
    C.setJointState([0.1, 1.5])
    return C


@pytest.fixture
def two_answers(arm) -> ry.KOMO:
    """Two links of 1 m reach (1, 1) with the elbow at +pi/2 or -pi/2; the start is near the first, the cost prefers the
    other."""
    komo = ry.KOMO(arm, 1, 1, 0, False)
    komo.addObjective([], ry.FS.qItself, [], ry.OT.sos, [0.1], WANTED)
    komo.addObjective([], ry.FS.position, ["tip"], ry.OT.eq, [10.0], [1.0, 1.0, 0.0])
    return komo


def reachPoint(arm, x: float, y: float) -> ry.KOMO:
    komo = ry.KOMO(arm, 1, 1, 0, False)
    komo.addObjective([], ry.FS.qItself, [], ry.OT.sos, [0.1], arm.getJointState())
    komo.addObjective([], ry.FS.position, ["tip"], ry.OT.eq, [10.0], [x, y, 0.0])
    return komo


def pickAndPlace(panda) -> ry.KOMO:
    panda.addFrame("box", "table").setRelativePosition([-0.1, 0.3, 0.2]).setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.01])
    komo = ry.KOMO(panda, 2, 4, 1, False)
    komo.addControlObjective([], 1, 1e-1)
    komo.addModeSwitch([1.0, 2.0], ry.SY.stable, ["l_gripper", "box"])
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [1e1])
    komo.addObjective([2.0], ry.FS.position, ["box"], ry.OT.eq, [1e1], [0.3, 0.3, 1.0])
    return komo


def solveOne(komo: ry.KOMO) -> tuple[ry.SolverReturn, np.ndarray]:
    """For another process."""
    return ry.NLP_Solver(komo.nlp(), verbose=0).solve(), komo.getPath()


def heightOfTip(tip):
    """A feature of one's own that pickles by its name."""
    return tip.getPosition()[1:2]


@pytest.mark.parametrize("threads", [1, 2])
def test_the_better_answer_is_found_and_the_komo_is_left_there(two_answers, threads):
    result = two_answers.solveFromMany(12, threads=threads)
    assert result and result.feasible and result.best.feasible and len(result) == len(result.results) == 12
    np.testing.assert_allclose(two_answers.getPath()[0], WANTED, atol=1e-3)
    assert result[result.chosen].sos == result.best.sos == min(r.sos for r in result if r.feasible)


def test_threads_do_not_change_a_bit(panda):
    given = pickAndPlace(panda)
    answers = []
    for threads in (1, 3):
        komo = copy.copy(given)
        answers.append((komo.solveFromMany(4, threads=threads, seed=7), komo.getPath()))
    (one, path), (more, other_path) = answers
    assert one.chosen == more.chosen and one.best.feasible
    np.testing.assert_array_equal(path, other_path)
    for a, b in zip(one, more):
        np.testing.assert_array_equal(a.x, b.x)
        assert a.evals == b.evals


def test_the_first_feasible_start_suffices_if_asked(two_answers):
    result = two_answers.solveFromMany(5, best=False)
    assert result.chosen == 0 and not result[1].done
    assert two_answers.getPath()[0][1] > 0


def test_starts_can_be_given_as_paths(two_answers):
    result = two_answers.solveFromMany([[[0.1, 1.5]], [[1.4, -1.4]]])
    assert result.chosen == 1 and len(result) == 2


@pytest.mark.parametrize("starts", [np.zeros((3, 1, 5)), [[0.1, 1.5]], 2.5, "ab"])
def test_starts_of_a_wrong_shape_are_refused(two_answers, starts):
    with pytest.raises(ry.ArgumentError, match=r"paths of shape \(K, 1, 2\)"):
        two_answers.solveFromMany(starts)


def test_verbose_says_how_many_are_feasible(two_answers, caplog):
    caplog.set_level("INFO", "kinegraph")
    two_answers.solveFromMany(3, verbose=1)
    assert "solveFromMany: 3 of 3 are feasible" in caplog.messages[-1]


def test_discrete_choices_are_solved_together_and_the_best_is_chosen(arm):
    far, near, out_of_reach = reachPoint(arm, -1, 1), reachPoint(arm, 0.9, 1.1), reachPoint(arm, 2, 2)
    result = ry.solveAll([far, near, out_of_reach], threads=2)
    assert [r.feasible for r in result] == [True, True, False]
    assert result.chosen == 1
    for komo, ret in zip((far, near, out_of_reach), result):
        np.testing.assert_array_equal(komo.getPath().ravel(), ret.x)
    assert result[2].status.name == "infeasible" and "position" in result[2].explain()


def test_problems_of_all_kinds_can_be_solved_together(arm):
    calls = []

    def function(x):
        calls.append(threading.get_ident())
        return np.array([x[0] - 1, x[1]]), np.eye(2)

    factory = ry.NLP_Factory()
    factory.setDimension(2)
    factory.setTypes([ry.OT.sos, ry.OT.eq])
    factory.setEvalCallback(function)
    solver = ry.NLP_Solver(ry.make_NLP_Problem("Wedge"), verbose=0).setOptions(stopTolerance=1e-8)
    result = ry.solveAll([factory, solver, reachPoint(arm, 1, 1)], threads=3)
    assert all(r.feasible for r in result) and calls
    np.testing.assert_allclose(result[0].x, [1, 0], atol=1e-4)
    np.testing.assert_allclose(solver.x, [-0.4, -0.4], atol=1e-6)


def test_mistakes_are_named(arm):
    komo = reachPoint(arm, 1, 1)
    with pytest.raises(ry.ArgumentError, match="problem 1 is a int; expected a KOMO, an NLP or an NLP_Solver"):
        ry.solveAll([komo, 3])
    with pytest.raises(ry.ArgumentError, match=r"problems 0 and 1 belong to the same KOMO; copy.copy"):
        ry.solveAll([komo, komo.nlp()])
    with pytest.raises(ry.ArgumentError, match="no problems"):
        ry.solveAll([])
    with pytest.raises(ry.ArgumentError, match="threads is 0"):
        ry.solveAll([komo], threads=0)
    factory = ry.NLP_Factory()
    factory.setDimension(1)
    factory.setTypes([ry.OT.sos])
    factory.setEvalCallback(lambda x: (np.array([np.nan]), np.eye(1)))
    with pytest.raises(ry.ArgumentError, match=r"problem 1: at the start, row 0 \(sos\) is not finite"):
        ry.solveAll([komo, factory], threads=2)
    factory.setEvalCallback(lambda x: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        ry.solveAll([komo, factory], threads=2)


def endlessProblem(function) -> ry.NLP_Solver:
    """A cost with thousands of minima, to be solved for hours; function() is called at every evaluation."""

    def evaluate(x):
        function()
        return np.array([np.sin(1e4 * x[0]) + 2]), np.array([[1e4 * np.cos(1e4 * x[0])]])

    factory = ry.NLP_Factory()
    factory.setDimension(1)
    factory.setTypes([ry.OT.sos])
    factory.setBounds([-50.0], [50.0])
    factory.setEvalCallback(evaluate)
    solver = ry.NLP_Solver(factory, verbose=0).setOptions(stopEvals=10**6, stopTolerance=1e-13)
    return solver.setSolver(ry.OptMethod.CMA).setInitialization([-1.0])


@pytest.mark.usefixtures("first_ctrl_c")
@pytest.mark.parametrize(("threads", "sender"), [(1, "main"), (2, "main"), (2, "other")])
def test_ctrl_c_ends_all_with_what_there_is(threads, sender):
    """The signal comes in a function that the main thread or another one calls, the third time at the earliest."""
    calls = {"main": 0, "other": 0}
    after = []

    def count():
        own = "main" if threading.current_thread() is threading.main_thread() else "other"
        calls[own] += 1
        if after:
            after.append(1)
            time.sleep(0.01)
        elif own == sender and calls["main"] >= 3:
            after.append(1)
            os.kill(os.getpid(), signal.SIGINT)
        elif calls["main"] < 3:
            time.sleep(0.001)

    result = ry.solveAll([endlessProblem(count) for _ in range(8)], threads=threads)
    ended = [r for r in result if r.done]
    assert 1 <= len(ended) < 8
    assert any((r.status.name, r.message) == ("cancelled", "interrupted by Ctrl-C") for r in ended)
    assert all(np.isfinite(r.x).all() for r in ended)
    assert len(after) < 1000


def test_ctrl_c_before_any_value_is_an_interrupt():
    def interrupt():
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        ry.solveAll([endlessProblem(interrupt) for _ in range(3)])


def test_a_komo_is_copied_and_pickled_exactly(panda):
    komo = pickAndPlace(panda)
    komo.addObjective([2.0], heightOfTip, ["l_gripper"], ry.OT.ineq, [1.0], [0.7])
    for other in (copy.copy(komo), copy.deepcopy(komo), pickle.loads(pickle.dumps(komo))):
        x = np.linspace(-0.3, 0.3, komo.nlp().dimension)
        for mine, its in zip(komo.nlp().evaluate(x), other.nlp().evaluate(x)):
            np.testing.assert_array_equal(mine, its)
        np.testing.assert_array_equal(komo.getPathFrames(), other.getPathFrames())
        other.initOrg()
        assert not np.array_equal(komo.getPath(), other.getPath()), "each its own path"
    assert repr(pickle.loads(pickle.dumps(ry.KOMO()))) == repr(ry.KOMO())


def test_problems_and_results_travel_between_processes(arm):
    komos = [reachPoint(arm, 1.0, y) for y in (0.5, 1.0)]
    fresh = multiprocessing.get_context("spawn")  # other tests leave threads behind, which a fork would not have
    with concurrent.futures.ProcessPoolExecutor(2, fresh) as pool:
        for komo, (ret, path) in zip(komos, pool.map(solveOne, komos)):
            here, here_path = solveOne(komo)
            assert ret.feasible and ret.status.name == "converged" and ret.evals == here.evals
            np.testing.assert_array_equal(path, here_path)
            np.testing.assert_array_equal(ret.x, here.x)


def test_results_pickle(two_answers):
    result = two_answers.solveFromMany(3)
    again = pickle.loads(pickle.dumps(result))
    assert again.chosen == result.chosen and len(again) == 3
    assert str(again.best) == str(result.best) and again.best.message == result.best.message
    with pytest.raises(ry.Error, match="nothing was solved"):
        again.best.explain()
