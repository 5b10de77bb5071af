"""The motion problems of benchmarks/komo_problems.py: recorded residuals and Jacobians, and solutions from several
starts."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from conftest import recorded

spec = importlib.util.spec_from_file_location(
    "komo_problems", Path(__file__).parents[3] / "benchmarks" / "komo_problems.py"
)
problems = importlib.util.module_from_spec(spec)
spec.loader.exec_module(problems)

RECORDED = {
    "ik_position": "ik position",
    "ik_pose": "ik pose",
    "joint_limits": "joint limits",
    "path_obstacle": "path obstacle",
    "pnp_waypoints": "pick waypoints 6cm",
    "ik_collision": "grasp 6cm",
    "dual_arm": "dual arm",
    "mobile_base": "mobile base",
    "pnp_path": "pick path 6cm",
}


@pytest.mark.parametrize("name", RECORDED)
def test_residuals_and_jacobians_are_those_recorded(name):
    expected = recorded("komo_jacobians")["cases"][name]
    _, komo = problems.PROBLEMS[RECORDED[name]](ry)
    phi, entries = komo.nlp().evaluate(expected["x"])
    wanted = np.array(expected["phi"])
    same = np.where(abs(phi + wanted) < abs(phi - wanted), -1.0, 1.0)  # the sign of a quaternion is arbitrary
    same[: len(phi) if name != "ik_pose" else -4] = 1.0
    np.testing.assert_allclose(phi, same * wanted, atol=2e-5)
    direction = np.cos(np.arange(len(expected["x"])) + 1.0)
    product = np.zeros(len(phi))
    np.add.at(product, entries[:, 0].astype(int), entries[:, 2] * direction[entries[:, 1].astype(int)])
    np.testing.assert_allclose(product, same * expected["Jv"], atol=1e-6)


def saysOneThing(ret):
    """Checks that feasible, status and explain() agree."""
    assert not (ret.feasible and ret.status.name == "infeasible"), ret
    assert not (not ret.feasible and ret.status.name == "converged"), ret
    assert ret.feasible == (ret.violation <= 1e-3)
    if ret.feasible:
        assert ret.explain(1e-3).startswith("All constraints hold")


@pytest.mark.parametrize("options", [{}, {"stopTolerance": 1e-6}, {"stopEvals": 7}], ids=str)
@pytest.mark.parametrize("name", problems.PROBLEMS)
def test_feasible_status_and_explanation_agree(name, options):
    for seed in range(2):
        _, komo = problems.PROBLEMS[name](ry)
        nlp = komo.nlp()
        lower, upper = np.array(nlp.getBounds()).reshape(2, -1)
        solver = ry.NLP_Solver(nlp, verbose=0).setOptions(**options)
        saysOneThing(solver.setInitialization(problems.start(np, komo, lower, upper, seed)).solve())


@pytest.mark.parametrize(
    "name", ["IK", "IKobstacle", "PushToReach", "StableSphere", "MinimalConvexCore", "Wedge", "Box"]
)
def test_they_agree_on_the_named_problems(name):
    for tolerance in (1e-4, 1e-6):
        nlp = ry.make_NLP_Problem(name)
        solver = ry.NLP_Solver(nlp, verbose=0).setOptions(stopTolerance=tolerance)
        saysOneThing(solver.setInitialization(nlp.getInitializationSample()).solve())


def test_a_solver_that_continues_reports_the_evaluations_of_this_solve_and_of_all():
    _, komo = problems.PROBLEMS["path obstacle"](ry)
    solver = ry.NLP_Solver(komo.nlp(), verbose=0).setOptions(stopEvals=3)
    assert solver.solve().message == "limit of 3 evaluations"
    again = solver.solve()
    assert (again.evals, again.totalEvals) == (3, 6)
    assert again.message == "limit of 3 evaluations in this solve; 6 evaluations in all"


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", ["ik position", "joint limits", "path obstacle", "mobile base", "pick waypoints 4cm"])
def test_problems_that_any_start_solves_are_solved(name, seed):
    run = problems.solveFrom(ry, np, problems.PROBLEMS[name], seed, {})
    assert run["violation"] < 1e-3 and run["says"] in ("converged", "stalled"), run


@pytest.mark.parametrize(("name", "seed"), [("mobile base", 4), ("mobile base", 7), ("pick path 4cm", 9)])
def test_slow_progress_along_curved_constraints_ends_at_the_solution(name, seed):
    run = problems.solveFrom(ry, np, problems.PROBLEMS[name], seed, {"stopTolerance": 1e-6})
    assert run["violation"] < 1e-6 and run["says"] == "converged", run


@pytest.mark.parametrize("name", ["ik pose", "grasp 4cm", "dual arm"])
def test_problems_with_local_minima_are_solved_by_restarts(name):
    build = problems.PROBLEMS[name]
    first = problems.solveFrom(ry, np, build, 2, {})
    assert 1 <= problems.attempts(ry, np, build, 2, first) <= problems.RESTARTS


def test_a_box_too_large_for_the_hand_is_reported_with_the_pair_and_how_much_is_missing():
    _, komo = problems.PROBLEMS["pick waypoints 6cm"](ry)
    answer = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert not answer.feasible and str(answer.status).endswith("infeasible")
    assert 2.8e-3 < answer.violation < 3.5e-3
    assert "panda_collCameraWrist" in komo.explain() and "box" in komo.explain()


def test_pick_and_place_moves_with_its_goal_as_differences_say():
    """Mode switches, quaternions and collisions: the derivative by the goal of the box. Constraint rows are linearly
    dependent at the solution, so it is less accurate than rounding: 1.2e-5 are reached."""
    C, komo = problems.PROBLEMS["pick waypoints 4cm"](ry)
    goal, step = C.getFrame("goal").getPosition(), 1e-5

    def solutionAt(by, start):
        C.getFrame("goal").setPosition(goal + by)
        komo.updateRootObjects(C)
        solver = ry.NLP_Solver(komo.nlp(), verbose=0)
        solver.setInitialization(start)
        return solver.solve().sensitivity("goal")

    bounds = np.array(komo.nlp().getBounds()).reshape(2, -1)
    at = solutionAt(np.zeros(3), problems.start(np, komo, *bounds, 0))
    assert at.isRegular, at.message
    for k, axis in enumerate(np.eye(3)):
        found = []
        for h in (step, 2 * step):  # whose third-order errors cancel
            ends = [solutionAt(sign * h * axis, at.x).x for sign in (1, -1)]
            found.append((ends[0] - ends[1]) / (2 * h))
        expected = (4 * found[0] - found[1]) / 3
        np.testing.assert_allclose(at.jacobian[:, k], expected, atol=2e-5 * max(1, abs(expected).max()), rtol=0)
    assert abs(at.jacobian).max() > 1
