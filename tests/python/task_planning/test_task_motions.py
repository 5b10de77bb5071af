"""Motions of planTask: continuously collision-free, within limits, at rest between actions; and the checker of it."""

import copy
import pickle
import re

import numpy as np
import pytest

import kinegraph as ry
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
    q, velocity, acceleration = plan.eval(-1.0)
    np.testing.assert_array_equal(q, C.getJointState())
    assert not velocity.any() and not acceleration.any()
    np.testing.assert_array_equal(plan.eval(1e9)[0], plan.path[-1])
    k = len(plan.times) // 2
    np.testing.assert_allclose(plan.eval(plan.times[k])[0], plan.path[k], atol=1e-12)
    several = plan.eval(plan.times[k : k + 3])
    assert [part.shape for part in several] == [(3, 7)] * 3
    np.testing.assert_array_equal(several[0][1], plan.eval(plan.times[k + 1])[0])
    times, q, velocity, _ = plan.sample(100.0)
    assert times[-1] == plan.duration and q.shape == velocity.shape == (len(times), 7)
    with pytest.raises(ry.ArgumentError, match="TaskPlan.eval: the plan has no motion; 'goal' is at least"):
        ry.planTask(families.far(0).C, "(on goal obj)").eval(0.0)


def test_slower_limits_make_a_slower_motion(tower) -> None:
    C, plan = tower
    slow = ry.planTask(C, "(on b1 b0)", velocity=0.5, acceleration=1.0)
    assert slow.feasible and slow.duration > plan.duration and ry.checkTaskPlan(C, slow) == []
    assert (abs(np.diff(slow.path[slow.segments[0]], axis=0)) <= 0.5 * 0.0101).all()


def test_the_judge_finds_jumps_haste_and_what_is_hit_between_rows(tower) -> None:
    C, plan = tower

    def wrong(path=plan.path, times=plan.times):
        return ry.checkTaskPlan(C, ry.TaskPlan(plan.actions, path, times, plan.segments, limits=plan.limits))

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


def test_plans_get_faster_as_long_as_effort_is_given() -> None:
    problem = families.tower(0)
    plans = list(ry.planTasks(problem.C, problem.goal, max_evaluations=3000))
    durations = [plan.duration for plan in plans]
    assert len(plans) > 1 and durations == sorted(durations, reverse=True) and len(set(durations)) == len(durations)
    assert all(ry.checkTaskPlan(problem.C, plan) == [] for plan in plans)
    np.testing.assert_array_equal(plans[0].path, ry.planTask(problem.C, problem.goal, max_evaluations=3000).path)


def test_the_tree_of_the_search_and_the_configuration_that_failed() -> None:
    problem = families.walled(0)
    plan = ry.planTask(problem.C, problem.goal)
    assert plan.searchTree().startswith("(pick obj table g_gripper)")
    scene = plan.failedConfiguration(problem.C)
    assert "failed g_palm" in scene.getFrameNames() and set(problem.C.getFrameNames()) < set(scene.getFrameNames())
    assert plan.view(problem.C, False) == 0
    with pytest.raises(ry.ArgumentError, match="no branch failed at a waypoint; .*beyond the reach"):
        ry.planTask(families.far(0).C, "(on goal obj)").failedConfiguration(problem.C)


def test_a_pickled_copy_plays_checks_and_repairs_as_the_original(tower) -> None:
    C, plan = tower
    other = pickle.loads(pickle.dumps(plan))
    assert other.actions == plan.actions and str(other) == str(plan) and other.explain() == plan.explain()
    assert other.searchTree() == plan.searchTree() and other.attachments == plan.attachments
    np.testing.assert_array_equal(other.path, plan.path)
    np.testing.assert_array_equal(other.frames(C), plan.frames(C))
    assert ry.checkTaskPlan(C, other) == []
    other.play(C.copy())
    moved = C.copy()
    moved.getFrame("b1").setRelativePosition(moved.getFrame("b1").getRelativePosition() + np.array([0.0, 0.05, 0.0]))
    np.testing.assert_array_equal(other.repair(moved).path, plan.repair(moved).path)
    assert copy.copy(plan).duration == plan.duration


def add_show(w, time, action, variant) -> None:
    w.komo.addObjective([time], ry.FS.position, [action[1]], ry.OT.eq, [[0, 0, 10.0]], [0, 0, 1.1])


def show_variants(C, action) -> list[str]:
    return ["high"]


def test_a_copy_keeps_the_domain_and_the_rules() -> None:
    problem = panda_tasks.tower(0, 2)
    domain = ry.defaultDomain()
    domain.addAction("show", ["Obj", "Hand"], "(is_gripper Hand) (is_object Obj) (on Hand Obj)", "(shown Obj)")
    assert pickle.loads(pickle.dumps(domain)).toFol() == domain.toFol()
    rules = {"show": ry.TaskRule(add_show, show_variants)}
    plan = ry.planTask(problem.C, "(shown b0)", domain=domain, rules=rules, max_evaluations=50000)
    other = pickle.loads(pickle.dumps(plan)).repair(problem.C)
    assert other.status == plan.status and other.actions == plan.actions
    np.testing.assert_array_equal(other.path, plan.path)


def test_a_copy_of_a_failure_keeps_its_tree() -> None:
    problem = families.walled(0)
    plan = ry.planTask(problem.C, problem.goal)
    other = pickle.loads(pickle.dumps(plan))
    assert other.status == ry.TaskStatus.no_plan_found and other.message == plan.message
    assert [branch.cause for branch in other.tree] == [branch.cause for branch in plan.tree]
    assert other.failedConfiguration(problem.C).getFrameNames() == plan.failedConfiguration(problem.C).getFrameNames()
