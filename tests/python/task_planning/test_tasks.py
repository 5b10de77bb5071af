"""planTask: goals become motions that an independent checker accepts; impossible goals are proved impossible."""

import re

import numpy as np
import pytest

import kinegraph as ry
from task_scenes import families


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    for name, at in (("cup", [-0.3, 0.25, 0.1]), ("jug", [0.25, 0.35, 0.1])):
        box = C.addFrame(name, "table").setRelativePosition(at).setJoint(ry.JT.rigid)
        box.setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.005]).setContact(1)
    tray = C.addFrame("tray", "table").setRelativePosition([0.0, 0.45, 0.055])
    tray.setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]).setContact(1)
    return C


@pytest.mark.parametrize(
    "family",
    [
        "tower",
        "sort",
        "handover",
        "crowded",
        "turn",
        "slot",
        "carry",
        "push",
        "hook",
        "drawer",
        "door",
        "stow",
        "fetch",
        "cleared",
        "lower",
    ],
)
def test_families_are_solved_and_the_checker_agrees(family) -> None:
    problem = families.FAMILIES[family](0)
    plan = ry.planTask(problem.C, problem.goal)
    assert plan.status == ry.TaskStatus.solved, plan
    assert len(plan.actions) >= problem.least
    assert ry.checkTaskPlan(problem.C, plan) == []
    assert plan.path.shape == (plan.segments[-1].stop, problem.C.getJointDimension())
    assert plan.waypoints.shape == (len(plan.actions), problem.C.getJointDimension())


def test_a_tray_is_carried_with_what_stands_on_it_level_and_slowly() -> None:
    problem = families.carry(0)
    plan = ry.planTask(problem.C, problem.goal)
    assert [a[0] for a in plan.actions[:2]] == ["lift", "place"] and len(plan.actions) == problem.least
    assert plan.frames(problem.C, 10.0).shape == (round(10 * plan.duration), problem.C.getFrameDimension(), 7)
    hasty = ry.TaskPlan(plan.actions, plan.path, 0.5 * plan.times, plan.segments, start=plan.start)
    assert any("'cup0' is accelerated too much for what carries it" in w for w in ry.checkTaskPlan(problem.C, hasty))


@pytest.mark.parametrize(
    "family", ["far", "beyond", "remote", "blocked", "tall", "small", "contradiction", "wide", "walled", "nowhere"]
)
def test_what_is_impossible_ends_with_its_cause(family) -> None:
    problem = families.FAMILIES[family](0)
    plan = ry.planTask(problem.C, problem.goal)
    assert plan.status == problem.expect and plan.actions == []
    assert re.search(problem.why, plan.message), plan.message


def test_what_is_too_wide_for_the_hand_is_told_with_the_widths() -> None:
    C = panda()
    C.getFrame("cup").setShape(ry.ST.ssBox, [0.12, 0.12, 0.12, 0.005])
    plan = ry.planTask(C, "(on tray cup)")
    assert plan.status == ry.TaskStatus.infeasible
    assert "'cup' is wider than 'l_gripper' opens (0.080 m)" in plan.message


def test_a_panda_puts_things_onto_a_tray_in_a_scene_that_says_nothing_of_logic() -> None:
    C = panda()
    before = C.getFrameState()
    plan = ry.planTask(C, "(on tray cup) (on tray jug)")
    assert plan.feasible and ry.checkTaskPlan(C, plan) == []
    assert [a[0] for a in plan.actions] == ["pick", "place"] * 2
    np.testing.assert_array_equal(C.getFrameState(), before)
    plan.play(C)
    for name in ("cup", "jug"):
        offset = C.getFrame(name).getPosition() - C.getFrame("tray").getPosition()
        assert abs(offset[:2]).max() < 0.1 and offset[2] == pytest.approx(0.055, abs=2e-3)


def test_the_same_call_gives_the_same_bits() -> None:
    one, other = (ry.planTask(panda(), "(on tray cup)", seed=3) for _ in range(2))
    assert one.actions == other.actions and one.evaluations == other.evaluations
    np.testing.assert_array_equal(one.path, other.path)


@pytest.mark.parametrize("shape", ["ball", "cylinder", "capsule", "mesh"])
def test_things_of_all_shapes_are_grasped(shape) -> None:
    C = panda()
    cup = C.getFrame("cup")
    if shape == "ball":
        cup.setShape(ry.ST.sphere, [0.03]).setRelativePosition([-0.3, 0.25, 0.08])
    elif shape == "cylinder":
        cup.setShape(ry.ST.ssCylinder, [0.1, 0.025, 0.005])
    elif shape == "capsule":
        cup.setShape(ry.ST.capsule, [0.06, 0.025]).setRelativePosition([-0.3, 0.25, 0.105])
    else:
        corners = np.array([[x, y, z] for x in (-0.02, 0.02) for y in (-0.03, 0.03) for z in (-0.05, 0.05)])
        cup.setConvexMesh(corners).setContact(1)
    plan = ry.planTask(C, "(on l_gripper cup)")
    assert plan.feasible, plan
    assert ry.checkTaskPlan(C, plan) == []


def test_an_action_of_ones_own_with_variants() -> None:
    C, domain = panda(), ry.defaultDomain()
    domain.addAction("show", ["Obj", "Hand"], "(is_gripper Hand) (is_object Obj) (on Hand Obj)", "(shown Obj)")

    def show(w, time, action, variant):
        height = {"too high": 3.0, "high": 1.1}[variant]
        w.komo.addObjective([time], ry.FS.position, [action[1]], ry.OT.eq, [[0, 0, 10.0]], [0, 0, height])

    rules = {"show": ry.TaskRule(show, lambda C, action: ["too high", "high"])}
    plan = ry.planTask(C, "(shown cup)", domain=domain, rules=rules)
    assert plan.feasible and [a[0] for a in plan.actions] == ["pick", "show"]
    assert plan.scenes[-1].getFrame("cup").getPosition()[2] > 0  # the scene in which it is held
    with pytest.raises(ry.ArgumentError, match="no TaskRule for the actions show; pass rules="):
        ry.planTask(C, "(shown cup)", domain=domain)


def test_the_checker_finds_what_is_wrong_with_a_plan() -> None:
    C = panda()
    plan = ry.planTask(C, "(on tray cup)")
    states = [["(on table cup)"], [], ["(on table cup)"]]
    assert "the goal (on tray cup) does not hold" in ry.checkTaskPlan(C, plan, states)[0]

    def violations(path, limits=None):
        return ry.checkTaskPlan(C, ry.TaskPlan(plan.actions, path, plan.times, plan.segments, limits=limits))

    path = plan.path
    path[plan.segments[0].stop - 1 :] += 0.3  # the hand is not at the cup
    assert any("away from what it takes" in w or "overlap" in w for w in violations(path))
    path = plan.path
    path[0, 0] = 9.0
    assert "jumps" in violations(path, plan.limits)[0]
    path = plan.path
    path[1:, 0] += 9.0
    assert "beyond its limits" in violations(path)[0]
    path = plan.path
    path[plan.segments[1].stop - 1, 5] += 0.1  # the cup is released in the air
    assert violations(path, plan.limits) != []


def test_mistakes_and_goals_that_hold() -> None:
    C = panda()
    with pytest.raises(ry.ParseError, match="unknown symbol 'tary' in the goal.*similar names: tray"):
        ry.planTask(C, "(on tary cup)")
    plan = ry.planTask(C, "(on table cup)")
    assert plan.feasible and plan.actions == [] and plan.warnings == ["the goal already holds"] and plan.message == ""
    assert ry.planTask(C, "(on cup tray)").status == ry.TaskStatus.infeasible


def test_effort_ends_it() -> None:
    problem = families.turn(0)  # its first sequences fail
    plan = ry.planTask(problem.C, problem.goal, max_evaluations=1)
    assert plan.status == ry.TaskStatus.no_plan_found and "no plan within max_evaluations" in plan.message
    assert "branch" in plan.explain()


def test_what_is_in_a_drawer_is_shown_moving_with_it() -> None:
    problem = families.fetch(0)
    C, plan = problem.C, ry.planTask(problem.C, problem.goal)
    assert [a[0] for a in plan.actions] == ["hold", "open", "pick", "place", "hold", "close"]
    names, frames = C.getFrameNames(), plan.frames(C, 20.0)
    opened = round(20.0 * plan.times[plan.segments[1].stop - 1])
    moved = frames[opened + 1, :, :3] - frames[0, :, :3]
    way = plan.path[plan.segments[1].stop - 1][C.getJointNames().index("drawer")]
    for name in ("drawer_front", "handle", "cup"):
        np.testing.assert_allclose(moved[names.index(name)], [0, way, 0], atol=1e-6)
    assert np.abs(frames[-1, names.index("drawer_front"), :3] - frames[0, names.index("drawer_front"), :3]).max() < 2e-3


def test_doors_and_their_states() -> None:
    C = families.fetch(0).C
    for at, state in ((0.0, "closed"), (-0.014, "closed"), (-0.1, "ajar"), (-0.25, "opened")):
        C.getFrame("drawer").setJointState([at])
        assert ry.doorStates(C) == {"drawer": state}
    assert ry.doorStates(panda()) == {}


def test_plans_are_made_with_keywords_alone() -> None:
    with pytest.raises(TypeError):
        ry.planTask(panda(), "(on tray cup)", ry.defaultDomain())
    assert str(ry.TaskStatus.no_plan_found) == "TaskStatus.no_plan_found"


def test_a_robot_without_a_gripper_is_told_so_and_not_by_the_rules_that_never_fire():
    C = ry.Config()
    C.addFile(ry.raiPath("ur5e/ur5e.g"))
    C.addText("""table: { X: [.6 0 .3], shape: ssBox, size: [.5 .5 .1 .01], contact: 1 }
box (table): { joint: rigid, Q: [0 0 .08], shape: ssBox, size: [.05 .05 .05 .01], contact: 1 }
tray (table): { joint: rigid, Q: [.1 .1 .06], shape: ssBox, size: [.2 .2 .02 .005], contact: 1 }""")
    plan = ry.planTask(C, "(on box tray)")
    assert plan.message.startswith("no frame is a gripper; give the point between the fingers a name")
    assert len(plan.message) < 250
