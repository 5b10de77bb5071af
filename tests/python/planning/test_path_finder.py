"""RRT_PathFinder: the path finder of the reference package."""

from __future__ import annotations

import itertools
import pickle

import numpy as np
import pytest

import kinegraph as ry
import robotic

BAR_AROUND_BAR = """
world: {}
stick(world): {shape: ssBox, size: [0.05, 0.9, 0.1, 0.02], contact: 1}
base(world): {joint: transXYPhi, limits: [-1.5, -1.5, -4, 1.5, 1.5, 4]}
bar(base): {shape: ssBox, size: [0.05, 0.6, 0.1, 0.02], contact: 1}
"""
START, GOAL = [-0.4, 0.0, 0.0], [0.4, 0.0, 0.0]


def barAroundBar() -> ry.Config:
    C = ry.Config()
    C.addText(BAR_AROUND_BAR)
    return C


def denselyFree(C: ry.Config, path: np.ndarray, margin: float) -> bool:
    """Checks configurations every milliradian, independently of edge checks."""
    for a, b in itertools.pairwise(path):
        count = max(2, int(np.linalg.norm(b - a) / 1e-3))
        if not C.isValid(a + np.linspace(0, 1, count)[:, None] * (b - a), margin=margin).all():
            return False
    return True


def finder(C: ry.Config) -> ry.RRT_PathFinder:
    return ry.RRT_PathFinder().setProblem(C).setStartGoal(START, GOAL)


def test_a_bar_goes_around_a_bar() -> None:
    C = barAroundBar()
    rrt = finder(C)
    ret = rrt.solve(0)
    assert ret.feasible and ret.done and ret.evals > 0 and ret.f == ret.eq == ret.ineq == ret.sos == 0
    assert ret.x.shape[1] == 3 and np.allclose(ret.x[0], START) and np.allclose(ret.x[-1], GOAL)
    steps = np.linalg.norm(np.diff(ret.x, axis=0), axis=1)
    assert steps.max() <= 0.1 + 1e-12
    assert denselyFree(C, ret.x, margin=-1e-4)
    assert np.allclose(C.getJointState(), 0)  # the scene is left alone
    assert rrt.get_resampledPath(31).shape == (31, 3)
    assert np.allclose(rrt.get_resampledPath(len(ret.x)), ret.x)


def test_a_free_straight_motion_is_the_path() -> None:
    C = barAroundBar()
    ret = ry.RRT_PathFinder().setProblem(C).setStartGoal(START, [-0.4, 0.5, 0.3]).solve(0)
    assert ret.feasible and ret.evals == 0
    assert np.linalg.norm(np.diff(ret.x, axis=0), axis=1).sum() == pytest.approx(np.linalg.norm([0.5, 0.3]))


def test_a_seed_gives_its_path_again() -> None:
    C = barAroundBar()
    paths = []
    for seed in (3, 3, 4):
        ry.rnd_seed(seed)
        paths.append(finder(C).solve(0).x)
    ry.rnd_seed(0)
    assert np.array_equal(paths[0], paths[1])
    assert paths[0].shape != paths[2].shape or not np.array_equal(paths[0], paths[2])


def test_the_older_form_of_the_call_is_the_same() -> None:
    C = barAroundBar()
    old = ry.PathFinder()
    old.setProblem(C, [START], [GOAL])
    assert np.array_equal(old.solve(0).x, finder(C).solve(0).x)


@pytest.mark.parametrize("ends", [(START, [0.0, 0.0, 0.0]), ([0.0, 0.0, 0.0], GOAL)])
def test_an_end_in_collision_is_said_and_no_path_is_claimed(ends: tuple[list[float], list[float]]) -> None:
    ret = ry.RRT_PathFinder().setProblem(barAroundBar()).setStartGoal(*ends).solve(0)
    what = "goal" if ends[0] == START else "start"
    assert not ret.feasible and ret.x.size == 0 and ret.done
    assert f"the {what} collides: 'stick' and 'bar' overlap by" in ret.message


def test_an_end_beyond_limits_is_said() -> None:
    ret = ry.RRT_PathFinder().setProblem(barAroundBar()).setStartGoal([-5.0, 0.0, 0.0], GOAL).solve(0)
    assert not ret.feasible and "the start is outside the limits: base:0 is at -5, 3.5 beyond" in ret.message


def test_only_the_pairs_that_are_named_collide() -> None:
    C = barAroundBar()
    C.addFrame("ghost").setShape(ry.ST.sphere, [0.2]).setPosition([0.4, 0.0, 0.0]).setContact(1)
    assert not finder(C).solve(0).feasible
    ret = finder(C).setExplicitCollisionPairs(["bar", "stick"]).solve(0)
    assert ret.feasible and ret.evals > 0  # still around the stick
    assert finder(C).setExplicitCollisionPairs(["ghost", "stick"]).solve(0).evals == 0  # through everything
    with pytest.raises(ry.FrameNotFound, match="stik"):
        finder(C).setExplicitCollisionPairs(["bar", "stik"])
    with pytest.raises(ry.ArgumentError, match="two for each pair"):
        finder(C).setExplicitCollisionPairs(["bar"])


def test_a_path_that_is_not_there_is_told_with_what_is_in_the_way() -> None:
    C = barAroundBar()
    C.getFrame("stick").setShape(ry.ST.box, [0.05, 4.0, 0.1])
    ret = finder(C).setOptions(maxIters=100).solve(0)
    assert not ret.feasible and ret.x.size == 0 and ret.status.name == "limit"
    assert "most edges collided with 'stick' (100 %, by 'bar')" in ret.message


def test_joints_that_slide_without_limits_are_sampled_around_the_ends_with_a_warning() -> None:
    C = ry.Config()
    C.addFrame("floor")
    C.addFrame("cart", "floor").setJoint(ry.JT.transXY).setShape(ry.ST.sphere, [0.1]).setContact(1)
    C.addFrame("wall", "floor").setShape(ry.ST.box, [0.1, 1.0, 0.2]).setContact(1)
    finder = ry.RRT_PathFinder().setProblem(C).setStartGoal([-1.0, 0.0], [1.0, 0.0])
    with pytest.warns(ry.KinegraphWarning, match="no limits are known for cart:0, cart:1; samples lie around start"):
        ret = finder.solve(0)
    assert ret.feasible and abs(ret.x).max() < 4.0
    np.testing.assert_allclose(ret.x[[0, -1]], [[-1.0, 0.0], [1.0, 0.0]])
    for q in ret.x:  # beside the wall
        C.setJointState(q)
        assert C.coll_totalViolation() < 1e-4
    far = finder.setStartGoal([-1.0, 1e4], [1.0, 1e4])  # the range moves along
    with pytest.warns(ry.KinegraphWarning, match="no limits are known"):
        assert far.solve(0).feasible


def test_iterations_are_counted_up_to_their_maximum() -> None:
    C = barAroundBar()
    C.getFrame("stick").setShape(ry.ST.box, [0.05, 4.0, 0.1])
    for most in (7, 100, 3000):
        ret = finder(C).setOptions(maxIters=most).solve(0)
        assert not ret.feasible and ret.evals == most and f"after {most} samples" in ret.message
    needed = finder(barAroundBar()).solve(0).evals
    assert finder(barAroundBar()).setOptions(maxIters=needed).solve(0).feasible
    assert not finder(barAroundBar()).setOptions(maxIters=needed - 1).solve(0).feasible


def test_options_are_given_by_place() -> None:
    coarse, fine = (finder(barAroundBar()).setOptions(0, step, 4, 5000).solve(0) for step in (0.2, 0.02))
    np.testing.assert_array_equal(fine.x, finder(barAroundBar()).setOptions(stepsize=0.02).solve(0).x)
    assert len(fine.x) > 5 * len(coarse.x)
    with pytest.raises(ry.ArgumentError, match="stepsize is given twice"):
        ry.RRT_PathFinder().setOptions(0, 0.1, stepsize=0.2)
    with pytest.raises(ry.ArgumentError, match="8 values; expected at most 7"):
        ry.RRT_PathFinder().setOptions(0, 0.1, 4, 5000, 0.5, 1e-4, True, 1)
    with pytest.raises(ry.ArgumentError, match="stepsize"):
        ry.RRT_PathFinder().setOptions(0, -0.1)


def test_parameters_are_the_defaults_of_scripts_for_robotic() -> None:
    C = barAroundBar()
    ry.params_clear()
    ry.params_add({"rrt/stepsize": 0.02, "rrt/maxIters": 3})
    try:
        finder = robotic.RRT_PathFinder()
        finder.setProblem(C).setStartGoal(START, GOAL)
        assert finder.solve(0).evals <= 3
        assert robotic.RRT_PathFinder().setOptions(maxIters=5000) is not None
        with pytest.warns(ry.KinegraphWarning, match="'rrt/stepsiz'.*similar names: rrt/stepsize"):
            ry.params_add({"rrt/stepsiz": 0.1})
    finally:
        ry.params_clear()


def test_what_makes_no_sense_is_an_error() -> None:
    C = barAroundBar()
    with pytest.raises(ry.ArgumentError, match="call setProblem"):
        ry.RRT_PathFinder().solve(0)
    with pytest.raises(ry.ArgumentError, match="call setStartGoal"):
        ry.RRT_PathFinder().setProblem(C).solve(0)
    with pytest.raises(ry.ArgumentError, match="the start has 2 numbers; expected 3"):
        ry.RRT_PathFinder().setProblem(C).setStartGoal([0.0, 1.0], GOAL).solve(0)
    with pytest.raises(ry.ArgumentError, match="starts has 2 rows"):
        ry.RRT_PathFinder().setProblem(C).setStartGoal([START, GOAL], GOAL)
    with pytest.raises(ry.ArgumentError, match="stepsize"):
        ry.RRT_PathFinder().setOptions(stepsize=0)
    with pytest.raises(ry.ArgumentError, match="similar names: stepsize"):
        ry.RRT_PathFinder().setOptions(stepsiz=0.1)
    with pytest.raises(ry.ArgumentError, match="call solve first"):
        finder(C).get_resampledPath(5)
    with pytest.raises(ry.ArgumentError, match="only q0"):
        ry.RRT_PathFinder().setProblem(C, START)


def test_a_result_is_a_solver_return_and_is_pickled() -> None:
    ret = finder(barAroundBar()).solve(0)
    again = pickle.loads(pickle.dumps(ret))
    assert isinstance(again, ry.SolverReturn) and np.array_equal(again.x, ret.x) and again.feasible
