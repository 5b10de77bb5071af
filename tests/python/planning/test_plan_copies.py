"""Copied and pickled plans and roadmaps equal the originals and behave the same."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
from collections.abc import Callable

import numpy as np
import pytest

import kinegraph as ry

TURN = np.array([0.6, 0, 0, 0, 0, 0, 0])
COPIES: list[Callable] = [lambda thing: pickle.loads(pickle.dumps(thing)), copy.copy, copy.deepcopy]


def states(plan: ry.MotionPlan) -> np.ndarray:
    return np.array([np.concatenate(plan.eval(t)) for t in np.linspace(0, plan.duration, 50)])


@pytest.mark.parametrize("copied", COPIES)
def test_a_copy_of_a_plan_is_that_plan(column: ry.Config, copied: Callable) -> None:
    q = column.getJointState()
    plan = ry.planMotion(column, q + TURN, q - TURN, margin=0.01, jerk=60)
    again = copied(plan)
    assert again.explain() == plan.explain() and repr(again) == repr(plan) and again.stages == plan.stages
    for name in ("path", "times", "raw_path"):
        np.testing.assert_array_equal(getattr(again, name), getattr(plan, name))
    np.testing.assert_array_equal(states(again), states(plan))
    assert len(again.trees) == len(plan.trees) == 2
    for ours, theirs in zip(plan.trees, again.trees, strict=True):
        for a, b in zip(ours, theirs, strict=True):
            np.testing.assert_array_equal(a, b)
    assert len(again.picture(column)) == len(plan.picture(column))
    column.clear()  # a plan keeps its scene as it was
    assert again.clearance() == plan.clearance() == copied(plan).clearance()


def test_a_copy_goes_on_as_the_plan_does(column: ry.Config) -> None:
    q = column.getJointState()
    column.delFrame("column")
    column.addFrame("cart").setShape(ry.ST.ssBox, [0.3, 0.3, 0.5, 0.02]).setContact(1)
    moving = {
        "cart": (
            [0.0, 2.0, 4.0],
            [[-0.6, 0.6, 1.1, 1, 0, 0, 0], [0.6, 0.6, 1.1, 1, 0, 0, 0], [0.6, 1.5, 1.1, 1, 0, 0, 0]],
        )
    }
    z = column.eval(ry.FS.vectorZ, ["l_gripper"])[0]
    tilt = ry.MotionConstraint(ry.FS.vectorZ, ["l_gripper"], scale=[[0, 0, 1.0]], target=z)
    plan = ry.planMotion(
        column, q + TURN, q - TURN, margin=0.01, obstacle_trajectories=moving, jerk=60, constraints=[tilt]
    )
    again = pickle.loads(pickle.dumps(plan))
    assert plan.feasible and again.warnings == plan.warnings
    np.testing.assert_array_equal(again.obstaclesAt(1.3)["cart"], plan.obstaclesAt(1.3)["cart"])
    assert again.clearance() == plan.clearance()
    at = 0.4 * plan.duration
    ours, theirs = plan.replan(column, at=at, goal=q), again.replan(column, at=at, goal=q)
    assert ours.feasible
    np.testing.assert_array_equal(states(ours), states(theirs))


def test_a_plan_that_failed_keeps_what_it_says(column: ry.Config) -> None:
    q = column.getJointState()
    plans = [
        ry.planMotion(column, [0.0] * 7),
        ry.planMotion(column, q, start=q + TURN, start_velocity=[99.0, 0, 0, 0, 0, 0, 0]),
        ry.planMotion(column, q + TURN, q - TURN, max_evaluations=3, margin=0.02),
    ]
    for plan in plans:
        again = pickle.loads(pickle.dumps(plan))
        assert not again and again.status == plan.status and again.message == plan.message
        assert again.obstacles == plan.obstacles and again.explain() == plan.explain()
        assert len(again.picture(column)) == len(plan.picture(column))
        with pytest.raises(ry.ArgumentError, match="there is no motion"):
            again.eval(0)


def planned(job: tuple) -> ry.MotionPlan:
    config, goal, start = job
    return ry.planMotion(config, goal, start, margin=0.01)


def test_plans_come_back_from_other_processes(column: ry.Config) -> None:
    q = column.getJointState()
    jobs = [(column, q + TURN, q - TURN), (column, q - TURN, q + TURN)]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        plans = pool.map(planned, jobs)
    for job, plan in zip(jobs, plans, strict=True):
        np.testing.assert_array_equal(states(plan), states(planned(job)))


@pytest.mark.parametrize("copied", COPIES)
def test_a_copy_of_a_roadmap_grows_and_answers_as_it_does(column: ry.Config, copied: Callable) -> None:
    q = column.getJointState()
    ours = ry.Roadmap(column, 0.005, 3).grow(80)
    ours.findPath(q - TURN, q + TURN)
    theirs = copied(ours)
    assert theirs.margin == ours.margin and theirs.edges == ours.edges
    answers = []
    for roadmap in (ours, theirs):
        roadmap.grow(20)
        answers.append(roadmap.findPath(q - TURN, q + 0.9 * TURN))
    np.testing.assert_array_equal(ours.configurations, theirs.configurations)
    np.testing.assert_array_equal(answers[0].path, answers[1].path)
    np.testing.assert_array_equal(copied(answers[0]).path, answers[0].path)
    assert answers[0].evaluations == answers[1].evaluations


def test_a_map_that_was_loaded_draws_other_postures_than_it_has(column: ry.Config, tmp_path) -> None:
    roadmap = ry.Roadmap(column).grow(10)
    roadmap.save(tmp_path / "map")
    loaded = ry.Roadmap(column)
    loaded.load(tmp_path / "map")
    np.testing.assert_array_equal(loaded.grow(10).configurations, roadmap.grow(10).configurations)
    assert len(np.unique(loaded.configurations, axis=0)) == 20
