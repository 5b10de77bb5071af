"""Methods of NLP_Solver, how a solve is watched and ended, and errors in a user's function."""

import importlib
import pickle
import signal
import subprocess
import sys

import numpy as np
import pytest

import kinegraph as ry

UNCONSTRAINED = ["newton", "LBFGS", "gradientDescent", "rprop", "NelderMead", "CMA"]
CONSTRAINED = ["augmentedLag", "squaredPenalty", "logBarrier", "slackGN_logBarrier"]


class Circle:
    """min (x-2)^2 + (y-1)^2 with x^2 + y^2 <= 1: the optimum is (2, 1) / sqrt(5)."""

    dimension = 2
    types = (ry.OT.sos, ry.OT.sos, ry.OT.ineq)
    bounds = np.array([[-2.0, -2.0], [2.0, 2.0]])
    evals = 0

    def evaluate(self, x):
        self.evals += 1
        phi = np.array([x[0] - 2, x[1] - 1, x @ x - 1])
        return phi, np.array([[1, 0], [0, 1], 2 * x])


class Free(Circle):
    types = (ry.OT.sos, ry.OT.sos)

    def evaluate(self, x):
        phi, J = super().evaluate(x)
        return phi[:2], J[:2]


def solver(problem, method: str = "augmentedLag", x0=(0.1, 0.2)) -> ry.NLP_Solver:
    s = (
        ry.NLP_Solver()
        .setPyProblem(problem)
        .setOptions(verbose=0, stopTolerance=1e-6, stopEvals=10000, stopGTolerance=1e-5)
    )
    return s.setSolver(getattr(ry.OptMethod, method)).setInitialization(np.array(x0))


@pytest.mark.parametrize("method", UNCONSTRAINED)
def test_a_method_without_constraints_finds_the_minimum_and_refuses_constraints(method):
    ret = solver(Free(), method).solve()
    assert ret.status.name == "converged"
    np.testing.assert_allclose(ret.x, [2, 1], atol=1e-3)
    with pytest.raises(ry.ArgumentError, match=rf"{method} does not support constraints, such as row 2 \(ineq\)"):
        solver(Circle(), method).solve()


@pytest.mark.parametrize("method", CONSTRAINED)
def test_a_method_with_constraints_finds_the_constrained_minimum(method):
    ret = solver(Circle(), method).solve()
    assert ret.feasible
    np.testing.assert_allclose(ret.x, np.array([2, 1]) / np.sqrt(5), atol=1e-3)


@pytest.mark.parametrize(("method", "package", "extra"), [("Ipopt", "ipyopt", "ipopt"), ("NLopt", "nlopt", "nlopt")])
def test_solvers_of_other_packages_solve_or_say_what_to_install(method, package, extra):
    try:
        __import__(package)
    except ImportError:
        with pytest.raises(ry.Error, match=rf"{method} needs the package {package}.*kinegraph\[{extra}\]"):
            solver(Circle(), method).solve()
        return
    ret = solver(Circle(), method).solve()
    assert ret.feasible, ret.message
    np.testing.assert_allclose(ret.x, np.array([2, 1]) / np.sqrt(5), atol=1e-4)


def test_methods_that_do_not_exist_are_refused_with_those_that_do():
    with pytest.raises(ry.ArgumentError, match="Ceres is not available; expected one of augmentedLag, .*CMA"):
        solver(Circle(), "Ceres").solve()


@pytest.mark.parametrize("method", CONSTRAINED + UNCONSTRAINED)
def test_what_is_not_a_number_is_named(method):
    class Broken(Free):
        def evaluate(self, x):
            return np.array([x[0], np.nan]), np.eye(2)

    with pytest.raises(ry.ArgumentError, match=r"at the start, row 1 \(sos\) is not finite: nan"):
        solver(Broken(), method).solve()


def test_infinities_on_the_way_are_stepped_around_or_named():
    class Wall(Free):
        def evaluate(self, x):
            phi, J = super().evaluate(x)
            return (phi, J) if x[0] < 0.5 else (np.array([np.inf, phi[1]]), J)

    ret = solver(Wall()).solve()
    assert ret.x[0] < 0.5
    assert ret.status.name == "stalled"
    assert "row 0 (sos) is not finite: inf" in ret.message


def test_a_mistake_in_the_function_reaches_the_caller():
    class Wrong(Free):
        def evaluate(self, x):
            raise RuntimeError("no such thing")

    with pytest.raises(RuntimeError, match="no such thing"):
        solver(Wrong()).solve()


@pytest.mark.usefixtures("first_ctrl_c")
@pytest.mark.parametrize("method", ["augmentedLag", "LBFGS", "NelderMead"])
def test_ctrl_c_in_a_users_function_ends_it_with_the_best_so_far(method):
    class Slow(Free):
        def evaluate(self, x):
            if self.evals == 1:  # the second time
                signal.raise_signal(signal.SIGINT)
            return super().evaluate(x)

    problem = Slow()
    ret = solver(problem, method).solve()
    assert ret.status.name == "cancelled"
    assert ret.message == "interrupted by Ctrl-C"
    assert problem.evals <= 6
    assert np.linalg.norm(ret.x - [2, 1]) <= np.linalg.norm(np.array([0.1, 0.2]) - [2, 1])


def test_ctrl_c_before_the_first_value_is_an_interrupt():
    class Slow(Free):
        def evaluate(self, x):
            signal.raise_signal(signal.SIGINT)
            return super().evaluate(x)

    with pytest.raises(KeyboardInterrupt):
        solver(Slow()).solve()


@pytest.mark.usefixtures("first_ctrl_c")
def test_ctrl_c_ends_a_long_motion_problem_which_then_holds_the_best_path(panda):
    panda.addFrame("target").setPosition([0.4, 0.3, 1.2])
    komo = ry.KOMO(panda, 1, 200, 2, False)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0])

    def interrupt(now):
        if now["evals"] == 2:
            signal.raise_signal(signal.SIGINT)

    s = ry.NLP_Solver(komo.nlp(), verbose=0).setProgress(interrupt, 0.0)
    ret = s.solve()
    assert ret.status.name == "cancelled"
    assert ret.evals == 2
    np.testing.assert_array_equal(komo.getPath().ravel(), ret.x)
    assert s.setProgress(None).solve().feasible, "and it can go on"


def test_progress_is_told_and_may_stop():
    seen = []
    ret = solver(Circle()).setProgress(lambda now: seen.append(now), 0.0).solve()
    assert [now["evals"] for now in seen] == list(range(1, ret.evals + 1))
    assert set(seen[0]) == {"evals", "x", "f", "sos", "ineq", "eq"}
    np.testing.assert_array_equal(seen[0]["x"], [0.1, 0.2])
    ret = solver(Circle()).setProgress(lambda now: now["evals"] < 3, 0.0).solve()
    assert (ret.status.name, ret.evals) == ("cancelled", 3)


def test_traces_hold_every_evaluation():
    s = solver(Circle()).setTracing(True, True, True, True)
    ret = s.solve()
    assert s.getTrace_x().shape == (ret.evals, 2)
    assert s.getTrace_phi().shape == (ret.evals, 3)
    assert s.getTrace_errs().shape == s.getTrace_costs().shape == (ret.evals, 4)
    np.testing.assert_allclose(s.getTrace_best()[:, 0], np.minimum.accumulate(s.getTrace_errs().sum(1)))
    assert len(s.getTrace_J()) == ret.evals
    np.testing.assert_allclose(s.getTrace_J()[0], [[1, 0], [0, 1], [0.2, 0.4]])
    assert len(s.clearTracing().getTrace_J()) == 0


def test_the_same_problem_gives_the_same_bits(panda):
    paths = []
    for _ in range(2):
        panda.addFrame("target").setPosition([0.4, 0.3, 1.2])
        komo = ry.KOMO(panda, 1, 10, 2, False)
        komo.addControlObjective([], 2, 1e-1)
        komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0])
        ry.NLP_Solver(komo.nlp(), verbose=0).solve()
        paths.append(komo.getPath())
        panda.delFrame("target")
    np.testing.assert_array_equal(*paths)


def test_a_numeric_jacobian_replaces_one_that_is_missing():
    class Numeric(Circle):
        def evaluate(self, x):
            return super().evaluate(x)[0], np.zeros((3, 2))

    s = solver(Numeric())
    s.getOptions().set_finiteDifference(1e-5)
    np.testing.assert_allclose(s.solve().x, np.array([2, 1]) / np.sqrt(5), atol=1e-3)


def test_a_kept_problem_is_solved_again_in_few_evaluations(panda):
    target = panda.addFrame("target").setPosition([0.3, 0.3, 1.0])
    komo = ry.KOMO(panda, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [0.1], panda.getJointState())
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0])
    s = ry.NLP_Solver(komo.nlp(), verbose=0)
    s.solve()
    for moved, limit in ((0.0, 2), (0.001, 3), (0.01, 5)):
        target.setPosition([0.3, target.getPosition()[1] + moved, 1.0])
        komo.updateRootObjects(panda)
        ret = s.solve()
        assert ret.feasible and ret.evals <= limit


def test_traces_and_counts_include_the_way_to_the_least_violation(panda):
    """An infeasible problem with a sum of overlaps, which the solver sees pair by pair."""
    panda.addFrame("wall").setShape(ry.ST.ssBox, [0.5, 0.5, 0.5, 0.02]).setPosition([0.4, 0.3, 0.9]).setContact(1)
    komo = ry.KOMO(panda, 1, 1, 0, False)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [1.0])
    komo.addObjective([], ry.FS.position, ["l_gripper"], ry.OT.eq, [10.0], [0.4, 0.3, 0.9])
    s = ry.NLP_Solver(komo.nlp(), verbose=0).setTracing(True, True)
    ret = s.solve()
    assert ret.status.name == "infeasible"
    assert len(s.getTrace_x()) == len(s.getTrace_errs()) == ret.evals


def test_options_of_another_type_are_taken_or_explained():
    s = solver(Free()).setOptions(stopEvals=1e3, boundedNewton=1)
    assert s.getOptions().dict()["stopEvals"] == 1000 and s.getOptions().dict()["boundedNewton"] is True
    with pytest.raises(ry.ArgumentError, match="stopEvals is 2.5; expected a whole number"):
        s.setOptions(stopEvals=2.5)
    with pytest.raises(ry.ArgumentError, match="boundedNewton is 2; expected True or False"):
        s.setOptions(boundedNewton=2)
    with pytest.raises(ry.ArgumentError, match="damping is 'high'; expected a number"):
        s.setOptions(damping="high")


def test_set_options_changes_what_is_named_and_nothing_else():
    s = ry.NLP_Solver(ry.make_NLP_Problem("Wedge"), verbose=0).setSolver(ry.OptMethod.squaredPenalty)
    before = s.setOptions(stopEvals=77).getOptions().dict()
    assert before["verbose"] == 0 and before["method"] == ry.OptMethod.squaredPenalty and before["stopEvals"] == 77
    after = s.setOptions(damping=0.5).getOptions().dict()
    assert {name for name in after if after[name] != before[name]} == {"damping"}
    with pytest.raises(ry.ArgumentError, match="option stepDec is 2; expected a number > 0 and < 1"):
        s.setOptions(damping=0.7, stepDec=2.0)
    assert s.getOptions().dict() == after, "all of them or none"


def test_options_are_properties_with_defaults_and_help():
    options = ry.NLP_SolverOptions(damping=0.5, method=ry.OptMethod.newton)
    assert options.damping == 0.5 and options.method == ry.OptMethod.newton
    assert options != ry.NLP_SolverOptions() and ry.NLP_SolverOptions() == ry.NLP_SolverOptions()
    options.stopEvals = 5
    assert options.dict()["stopEvals"] == 5
    with pytest.raises(ry.ArgumentError, match="NLP_Solver: option muInc is 1; expected a number > 1"):
        options.muInc = 1
    assert options.muInc == ry.NLP_SolverOptions().muInc
    again = pickle.loads(pickle.dumps(options))
    assert again == options
    for name, default in ry.NLP_SolverOptions().dict().items():
        doc = getattr(ry.NLP_SolverOptions, name).__doc__
        assert f"Default {default}" in doc, doc
        assert doc in ry.NLP_SolverOptions.__doc__ and doc in ry.NLP_Solver.setOptions.__doc__


def test_the_limit_on_steps_says_how_many_there_were():
    s = solver(Circle()).setOptions(stopInners=0)
    ret = s.solve()
    assert ret.status.name == "limit" and ret.message == "limit of 0 steps, 20 times stopInners"


@pytest.mark.skipif(sys.platform != "linux", reason="counts page faults as Linux does")
def test_a_path_is_solved_in_memory_that_the_last_one_has_left():
    """Otherwise the system hands out new pages each time: some 300 for this one."""
    script = """
import resource
import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))


def solve():
    komo = ry.KOMO(C, 1, 256, 2, False)
    komo.addControlObjective([], 2, 1.0)
    komo.addObjective([1.0], ry.FS.position, ["l_gripper"], ry.OT.eq, [10.0], [0.3, 0.3, 1.1])
    assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible


for _ in range(5):
    solve()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(10):
    solve()
print((resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before) / 10)
"""
    faults = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    assert float(faults) < 50


@pytest.mark.usefixtures("first_ctrl_c")
def test_a_second_ctrl_c_within_a_second_leaves_a_loop_of_solves():
    class Slow(Free):
        def evaluate(self, x):
            if self.evals == 1:
                signal.raise_signal(signal.SIGINT)
            return super().evaluate(x)

    assert solver(Slow()).solve().message == "interrupted by Ctrl-C"
    with pytest.raises(KeyboardInterrupt):
        solver(Slow()).solve()


@pytest.mark.parametrize(
    ("module", "package", "extra"), [("torch", "torch", "torch"), ("jax", "jax", "jax"), ("gym", "gymnasium", "gym")]
)
def test_modules_of_extras_name_the_extra(module, package, extra, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.delitem(sys.modules, f"kinegraph.{module}", raising=False)
    with pytest.raises(ModuleNotFoundError, match=rf"kinegraph.{module} needs .*pip install 'kinegraph\[{extra}\]'"):
        importlib.import_module(f"kinegraph.{module}")
