"""Problems: those of a KOMO, of Python objects and functions, and named ones."""

import pickle

import numpy as np
import pytest

import kinegraph as ry


class Valley:
    """min 4 x^2 + (y - x^2)^2 + 3 y, as f and sos, with a Hessian of f."""

    dimension = 2
    types = (ry.OT.f, ry.OT.sos)
    bounds = np.array([[-2.0, 1.0], [2.0, -1.0]])  # y is unbounded

    def evaluate(self, x):
        return np.array([4 * x[0] ** 2 + 3 * x[1], x[1] - x[0] ** 2]), np.array([[8 * x[0], 3], [-2 * x[0], 1]])

    def getFHessian(self, x):
        return np.diag([8.0, 0.0])

    def getInitializationSample(self):
        return [0.5, 0.25]

    def report(self, verbose):
        return f"a valley, {verbose}"


@pytest.fixture
def reach(panda) -> ry.KOMO:
    panda.addFrame("goal").setPosition([0.3, 0.3, 1.0])
    komo = ry.KOMO(panda, 1, 1, 0, False)
    komo.addObjective([], ry.FS.qItself, [], ry.OT.sos, [0.1], panda.getJointState())
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "goal"], ry.OT.eq, [10.0])
    return komo


def factory(J=None) -> ry.NLP_Factory:
    f = ry.NLP_Factory()
    f.setDimension(2)
    f.setFeatureTypes([ry.OT.sos, ry.OT.eq])
    f.setBounds([-1.0, 1.0], [1.0, -1.0])
    f.setEvalCallback(lambda x: (np.array([x[0] - 2, x[1] - x[0]]), np.array([[1.0, 0], [-1, 1]]) if J is None else J))
    return f


def test_a_problem_of_a_python_object_has_its_hessian_start_and_report():
    solver = ry.NLP_Solver().setPyProblem(Valley()).setOptions(verbose=0, stopTolerance=1e-8)
    nlp = solver.getProblem()
    assert nlp.report(2) == "a valley, 2"
    np.testing.assert_array_equal(nlp.getInitializationSample(), [0.5, 0.25])
    np.testing.assert_array_equal(nlp.getFHessian([1, 1]), np.diag([8, 0]))
    np.testing.assert_array_equal(nlp.getBounds(), [[-2, 0], [2, -1]])
    assert nlp.checkJacobian([0.3, 0.4], 1e-6) and nlp.checkHessian([0.3, 0.4], 1e-6)
    ret = solver.setTracing(True, True).solve()
    np.testing.assert_array_equal(solver.getTrace_x()[0], [0.5, 0.25])
    np.testing.assert_allclose(ret.x, [0, -1.5], atol=1e-6)  # from y - x^2 = -3/2 and 8 x + 6 x = 0


def test_the_scalar_function_of_a_problem_has_its_derivatives():
    nlp = ry.NLP_Solver().setPyProblem(Valley()).getProblem()
    value, gradient, hessian = nlp.eval_scalar([1.0, 2.0])
    assert value == 4 + 6 + 1
    np.testing.assert_allclose(gradient, [8 - 4, 3 + 2])
    np.testing.assert_allclose(hessian, [[8 + 8, -4], [-4, 2]])
    with pytest.raises(ry.ArgumentError, match=r"row 1 \(eq\) is of type eq; expected f or sos"):
        factory().eval_scalar([0, 0])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"types": (7, 1)}, "type of the problem is 7; expected one of OT: f, sos, ineq, eq, ineqB, ineqP, none"),
        ({"types": ("f", "inneq")}, "type of the problem is 'inneq'; expected one of OT: f, sos, ineq, eq"),
        ({"bounds": np.zeros((3, 2))}, "bounds of the problem are 3 x 2 numbers; expected 2 x 2"),
        ({"getFHessian": lambda x: np.eye(3)}, "getFHessian returned 9 numbers; expected 2 x 2"),
        ({"getInitializationSample": lambda: [1.0]}, "getInitializationSample returned 1 numbers; expected 2"),
        ({"evaluate": lambda x: (np.zeros(3), np.zeros((3, 2)))}, "phi of size 3; expected 2"),
        ({"evaluate": lambda x: (np.zeros(2), np.zeros((2, 3)))}, "Jacobian with 6 entries; expected 2 x 2"),
        ({"evaluate": lambda x: 1 / 0}, "division by zero"),
    ],
)
def test_what_is_wrong_about_a_python_object_is_said(change, message):
    problem = Valley()
    for name, value in change.items():
        setattr(problem, name, value)
    with pytest.raises((ry.ArgumentError, ZeroDivisionError), match=message):
        ry.NLP_Solver().setPyProblem(problem).setOptions(verbose=0).solve()


def test_types_may_be_names():
    problem = Valley()
    problem.types = ["f", "sos"]
    assert ry.NLP_Solver().setPyProblem(problem).getProblem().getFeatureTypes() == [ry.OT.f, ry.OT.sos]


@pytest.mark.parametrize("bounds", [[[-2, 2], [-2, 2]], [[-2, 2], [-1, 1]], [[0, 3], [0, 1]]])
def test_bounds_that_look_transposed_are_asked_about(bounds):
    problem = Valley()
    problem.bounds = bounds
    with pytest.warns(ry.KinegraphWarning, match="did you mean the transposed, one row"):
        ry.NLP_Solver().setPyProblem(problem)


@pytest.mark.parametrize("bounds", [[[-2, -2], [2, 2]], [[0, 1], [5, 6]], [[-2, 1], [2, -1]], [[1, 1], [1, 1]]])
def test_bounds_of_two_variables_are_lower_then_upper(bounds, recwarn):
    problem = Valley()
    problem.bounds = bounds
    ry.NLP_Solver().setPyProblem(problem)
    assert not recwarn


class Corner:
    """min |x|^2 with x + y >= 1."""

    dimension, types, bounds = 2, ("f", "ineq"), ((-2, -2), (2, 2))

    def evaluate(self, x):
        return np.array([x @ x, 1 - x.sum()]), np.array([2 * x, [-1, -1]])


def test_an_active_constraint_pulls_without_an_error():
    solver = ry.NLP_Solver().setPyProblem(Corner()).setOptions(verbose=0, stopTolerance=1e-8)
    np.testing.assert_allclose(solver.solve().x, [0.5, 0.5], atol=1e-6)
    report = solver.reportLagrangeGradients(["cost", "wall"])
    np.testing.assert_allclose(report["wall"]["grad"], np.sqrt(2), rtol=1e-5)


def test_an_object_that_is_no_problem_says_what_is_missing():
    with pytest.raises(ry.ArgumentError, match="the problem, a int, has no 'dimension'"):
        ry.NLP_Solver().setPyProblem(3)


def test_a_factory_is_a_problem():
    f = factory()
    assert isinstance(f, ry.NLP)
    assert f.getDimension() == 2 and f.types.tolist() == [1, 3] and f.getTypes() == [ry.OT.sos, ry.OT.eq]
    np.testing.assert_array_equal(f.bounds, [[-1, 0], [1, -1]])
    phi, J = f.testCallingEvalCallback([0.0, 1.0])
    np.testing.assert_array_equal(phi, [-2, 1])
    np.testing.assert_array_equal(J, [[1, 0], [-1, 1]])
    ret = ry.NLP_Solver(f).solve()
    np.testing.assert_allclose(ret.x, [1, 1], atol=1e-4)


def test_a_factory_says_what_is_missing_or_wrong():
    empty = ry.NLP_Factory()
    empty.setDimension(1)
    with pytest.raises(ry.Error, match="setEvalCallback"):
        empty.evaluate([0.0])
    with pytest.raises(ry.ArgumentError, match="2 lower and 1 upper bounds; expected 1 of each"):
        empty.setBounds([0, 0], [1])


def test_a_wrong_jacobian_is_found_and_its_entries_named(capsys):
    wrong = factory(np.array([[1.0, 0.5], [-1, 3]]))
    assert factory().checkJacobian([0.1, 0.2]) and "SUCCESS" in capsys.readouterr().out
    assert not wrong.checkJacobian([0.1, 0.2])
    lines = capsys.readouterr().out.splitlines()
    assert "row 1 (eq), variable 1 (column 1): J is 3, differences give 1" in lines[1] and "J is 0.5" in lines[2]
    assert not wrong.checkJacobian(x=[0.1, 0.2], tolerance=1e-4, featureNames=["near", "line"])
    assert "line, variable 1" in capsys.readouterr().out
    assert not wrong.checkJacobian([1.0, 2, 3, 4]), "at a sample"
    with pytest.raises(ry.ArgumentError, match="1 names; the problem has 2 residuals"):
        wrong.checkJacobian([0.1, 0.2], 1e-4, ["near"])


def test_samples_differ_from_call_to_call_and_repeat_with_the_seed():
    nlp = ry.make_NLP_Problem("Box")
    ry.rnd_seed(3)
    first, second = nlp.getUniformSample(), nlp.getUniformSample()
    ry.rnd_seed(3)
    np.testing.assert_array_equal(nlp.getUniformSample(), first)
    assert not np.array_equal(first, second)
    ry.rnd_seed(0)


def test_what_constraints_cost_as_penalties_and_barriers():
    nlp = ry.make_NLP_Problem("HalfCircle")
    x = np.array([0.3, 0.5])
    phi, J = nlp.evaluate(x)
    penalized, P = nlp.aug_lag(100.0).evaluate(x)
    np.testing.assert_allclose(penalized, [phi[0], 10 * phi[1], 10 * phi[2]])
    np.testing.assert_allclose(P[1:], 10 * J[1:])
    inside = np.array([0.1, 0.1])
    barrier = nlp.aug_lag(-1, 0.5)
    np.testing.assert_allclose(barrier.evaluate(inside)[0][1:], -0.5 * np.log(-nlp.evaluate(inside)[0][1:]))
    assert barrier.getTypes() == [ry.OT.f] * 3
    assert ry.make_NLP_Problem("Wedge").aug_lag(-1, 0.5).checkHessian([-0.1, 0.0])


def test_the_problem_of_a_komo_leads_back_to_it_and_pickles(reach):
    nlp = reach.nlp()
    assert nlp.as_KOMO() is reach
    assert factory().as_KOMO() is None
    again = pickle.loads(pickle.dumps(nlp))
    x = reach.getPath()[0] + 0.1
    for mine, other in zip(nlp.evaluate(x), again.evaluate(x)):
        np.testing.assert_array_equal(mine, other)
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(ry.make_NLP_Problem("Box"))


def test_what_each_objective_pulls_at_the_solution(reach):
    solver = ry.NLP_Solver(reach.nlp(), verbose=0).setOptions(stopTolerance=1e-8)
    with pytest.raises(ry.Error, match="nothing has been solved yet"):
        solver.reportLagrangeGradients()
    solver.solve()
    report = solver.reportLagrangeGradients()
    assert set(report) == {"positionDiff of l_gripper, goal", "qItself"}
    pulls = [entry["grad"] for entry in report.values()]
    assert pulls == sorted(pulls, reverse=True)
    np.testing.assert_allclose(report["qItself"]["grad"], report["positionDiff of l_gripper, goal"]["grad"], rtol=1e-4)
    assert report["qItself"]["type"] == "sos" and report["positionDiff of l_gripper, goal"]["type"] == "eq"
    names = ["posture"] * 7 + list("xyz")
    assert set(solver.reportLagrangeGradients(names)) <= {"posture", "x", "y", "z"}


@pytest.mark.parametrize("name", ry.get_NLP_Problem_names())
def test_named_problems_have_the_derivatives_that_they_claim(name):
    nlp = ry.make_NLP_Problem(name, 4 if name == "SpherePacking" else None)
    x = nlp.getUniformSample()
    assert nlp.checkJacobian(x, 1e-4)
    assert nlp.checkHessian(x, 1e-4)


def test_named_problems_take_a_dimension_and_refuse_other_names():
    assert ry.make_NLP_Problem("Rosenbrock", 5).dimension == 5
    ry.params_add({"problem/dim": 3})
    assert ry.make_NLP_Problem("Rastrigin").dimension == 3
    ry.params_clear()
    with pytest.raises(ry.NotFound, match="no problem 'Rosenbrok'; expected one of .*Rosenbrock"):
        ry.make_NLP_Problem("Rosenbrok")


def test_options_of_the_solver_print_and_pickle_and_name_misspelt_ones():
    options = ry.NLP_SolverOptions().set_damping(0.3).set_method(ry.OptMethod.LBFGS)
    again = pickle.loads(pickle.dumps(options))
    assert again.dict() == options.dict() and again.dict()["damping"] == 0.3
    assert "damping=0.3" in repr(options)
    with pytest.raises(ry.ArgumentError, match="no option 'stopTolerence'; similar names: stopTolerance"):
        ry.NLP_Solver().setOptions(stopTolerence=1e-3)
    ry.NLP_Solver().setOptions(stepInit=1.0, stopLineSteps=10)  # of older scripts


@pytest.mark.parametrize("phi", [[], np.zeros((0, 7)), np.zeros(99)])
def test_residuals_of_another_problem_are_refused(phi):
    with pytest.raises(ry.ArgumentError, match=r"sumErrors: got \d+ residuals; expected 1"):
        ry.make_NLP_Problem("Rastrigin").summarizeErrors(phi)


def test_a_method_is_one_of_its_enum():
    with pytest.raises(ry.ArgumentError, match="option method is 'Newton'; expected one of OptMethod: none, .*newton"):
        ry.NLP_SolverOptions().set_method("Newton")
