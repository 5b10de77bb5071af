"""Motions of planTask: free at all times, within limits, at rest between actions; and the judge that says so."""

import re

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.task_check import cornersOf
from kinegraph.task_plan import failedConfiguration
from task_scenes import families, panda_tasks, planned


@pytest.fixture(scope="module")
def tower():
    return planned(panda_tasks.tower(0, 2))


def test_the_motion_keeps_its_limits_and_rests_between_actions(tower) -> None:
    C, plan = tower
    assert plan.path.shape == (len(plan.times), 7) and plan.times[0] == 0.0 and plan.duration == plan.times[-1]
    velocity = C.getVelocityLimits()
    np.testing.assert_array_equal(plan.limits, [velocity, 2 * velocity])
    for rows in plan.segments:
        q, t = plan.path[rows], plan.times[rows]
        speed = np.diff(q, axis=0) / np.diff(t)[:, None]
        assert (abs(speed) <= velocity * (1 + 1e-6)).all()
        assert (abs(speed[[0, -1]]) <= velocity * np.diff(t)[[0, -1], None] * (1 + 1e-6)).all()
    at_limit = max(
        abs(np.diff(plan.path[r], axis=0) / np.diff(plan.times[r])[:, None] / velocity).max() for r in plan.segments
    )
    assert at_limit > 0.5  # it is not slow for no reason


def test_where_the_motion_is_at_a_time(tower) -> None:
    C, plan = tower
    np.testing.assert_array_equal(plan.at(-1.0), C.getJointState())
    np.testing.assert_array_equal(plan.at(1e9), plan.path[-1])
    k = len(plan.times) // 2
    np.testing.assert_allclose(plan.at(plan.times[k]), plan.path[k], atol=1e-12)
    with pytest.raises(ry.ArgumentError, match="at: there is no motion; the goal"):
        ry.TaskPlan("not found", "the goal is too far").at(0.0)


def test_slower_limits_make_a_slower_motion(tower) -> None:
    C, plan = tower
    slow = ry.planTask(C, "(on b1 b0)", velocity=0.5, acceleration=1.0)
    assert slow.feasible and slow.duration > plan.duration and ry.checkTaskPlan(C, slow) == []
    assert (abs(np.diff(slow.path[slow.segments[0]], axis=0)) <= 0.5 * 0.0101).all()


def test_the_judge_finds_jumps_haste_and_what_is_hit_between_rows(tower) -> None:
    C, plan = tower

    def wrong(**changes):
        kept = {name: getattr(plan, name) for name in changes}
        for name, value in changes.items():
            setattr(plan, name, value)
        found = ry.checkTaskPlan(C, plan)
        for name, value in kept.items():
            setattr(plan, name, value)
        return found

    assert wrong() == []
    assert "faster than its limit" in wrong(times=0.4 * plan.times)[0]
    assert "accelerates more" in wrong(times=0.9 * plan.times)[0]
    assert "jumps" in wrong(path=plan.path + 1e-6)[0]


def test_the_judge_looks_between_rows() -> None:
    C = ry.Config()
    C.addFrame("world")
    C.addFrame("hand", "world").setShape(ry.ST.sphere, [0.01]).setContact(1).setJoint(
        ry.JT.trans3, [-1, -1, -1, 1, 1, 1]
    )
    C.addFrame("obj", "world").setRelativePosition([0.9, 0, 0]).setShape(ry.ST.sphere, [0.02]).setJoint(ry.JT.rigid)
    plan = ry.TaskPlan(
        "solved",
        "",
        actions=[["pick", "obj", "table", "hand"]],
        path=np.array([[0, 0, 0], [0.88, 0, 0]]),
        times=np.array([0.0, 1.0]),
        segments=[slice(0, 2)],
    )
    assert ry.checkTaskPlan(C, plan) == []
    C.addFrame("foil").setPosition([0.5, 0, 0]).setShape(ry.ST.box, [0.002, 0.5, 0.5]).setContact(1)
    assert re.match(r"\(pick obj table hand\): .*foil.* overlap", ry.checkTaskPlan(C, plan)[0])


def test_the_judge_knows_pushing_from_pulling() -> None:
    C = ry.Config()
    table = C.addFrame("table").setShape(ry.ST.ssBox, [4.0, 4.0, 0.1, 0.02]).setContact(1)
    C.addFrame("hand", "table").setShape(ry.ST.sphere, [0.01]).setJoint(ry.JT.trans3, [-1, -1, 0, 1, 1, 1])
    C.addFrame("obj", "table").setRelativePosition([0, 0, 0.1]).setShape(ry.ST.ssBox, [0.1, 0.1, 0.1, 0.004])
    C.getFrame("obj").setJoint(ry.JT.rigid).setContact(1)
    beside = [-0.06, 0, 0.1]
    C.setJointState(beside)

    def wrong(to):
        plan = ry.TaskPlan(
            "solved",
            "",
            actions=[["push_start", "obj", table.name, "hand"], ["push_end", "obj", "hand", table.name]],
            path=np.array([beside, beside, beside, to]),
            times=np.array([0.0, 0.0, 0.0, 1.0]),
            segments=[slice(0, 2), slice(2, 4)],
        )
        return ry.checkTaskPlan(C, plan)

    assert wrong([0.3, 0, 0.1]) == []
    assert "'obj' is not pushed from behind" in wrong([-0.4, 0, 0.1])[0]
    assert "'obj' is not pushed from behind" in wrong([-0.06, 0.3, 0.1])[0]
    assert "'obj' does not slide straight" in wrong([0.3, 0, 0.2])[0]


def test_rows_inside_of_straight_pieces_are_left_out() -> None:
    path = np.array([[0, 0], [1, 1], [2, 2], [3, 1], [4, 0], [3, 1], [3, 1], [5, 1.0]])
    np.testing.assert_array_equal(cornersOf(path), [[0, 0], [2, 2], [4, 0], [3, 1], [5, 1]])
    np.testing.assert_array_equal(cornersOf(path[:1]), path[:1])


def test_plans_get_faster_as_long_as_effort_is_given() -> None:
    problem = families.tower(0)
    plans = list(ry.planTasks(problem.C, problem.goal, evaluations=3000))
    durations = [plan.duration for plan in plans]
    assert len(plans) > 1 and durations == sorted(durations, reverse=True) and len(set(durations)) == len(durations)
    assert all(ry.checkTaskPlan(problem.C, plan) == [] for plan in plans)
    np.testing.assert_array_equal(plans[0].path, ry.planTask(problem.C, problem.goal, evaluations=3000).path)


def test_the_tree_of_the_search_and_a_ghost_of_what_failed() -> None:
    problem = families.walled(0)
    plan = ry.planTask(problem.C, problem.goal)
    assert plan.searchTree().startswith("(pick obj table g_gripper)")
    scene = failedConfiguration(plan, problem.C)
    assert "ghost of g_palm" in scene.getFrameNames() and set(problem.C.getFrameNames()) < set(scene.getFrameNames())
    assert plan.view(problem.C, False) == 0
    with pytest.raises(ry.ArgumentError, match="no branch failed at a waypoint; .*beyond the reach"):
        failedConfiguration(ry.planTask(families.far(0).C, "(on goal obj)"), problem.C)
