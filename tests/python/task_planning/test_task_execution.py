"""Plans carried out in simulation: hands hold objects by friction, and failures are noticed and repaired."""

import pickle

import numpy as np
import pytest

import kinegraph as ry
from task_scenes import panda_tasks, planned


@pytest.fixture(scope="module")
def tower():
    return planned(panda_tasks.tower(1, 2))


def test_a_tower_is_built_in_simulation(tower) -> None:
    C, plan = tower
    bot = ry.BotOp(C)
    run = plan.execute(bot)
    assert run.feasible and run.done == len(plan.actions) and "reached the goal" in str(run)
    world = bot.getWorld()
    offset = world.getFrame("b0").getPosition() - world.getFrame("b1").getPosition()
    assert abs(offset[:2]).max() < 0.03 and offset[2] == pytest.approx(0.05, abs=2e-3)
    assert run.C.getFrame("b0").getParent().name == "b1"
    again = plan.repair(run.C)
    assert again.feasible and again.actions == [] and again.execute(bot).feasible


def test_the_same_execution_gives_the_same_bits(tower) -> None:
    C, plan = tower
    ends = [plan.execute(ry.BotOp(C)).C.getFrameState() for _ in range(2)]
    np.testing.assert_array_equal(*ends)


def test_what_is_not_where_it_was_is_noticed_and_repaired(tower) -> None:
    C, plan = tower
    world = C.copy()
    b0 = world.getFrame("b0")
    b0.setRelativePosition(b0.getRelativePosition() + np.array([0.0, 0.06, 0.0]))
    bot = ry.BotOp(world)
    run = plan.execute(bot, repairs=0)
    assert not run.feasible and run.done == 0 and "'b0' is 0.060 m away from where it should be" in run.message
    repaired = plan.repair(run.C)
    assert repaired.feasible and repaired.execute(bot).feasible


def test_mistakes_are_told_before_anything_moves(tower) -> None:
    C, plan = tower
    light = C.copy()
    light.getFrame("b0").setMass(0.0)
    with pytest.raises(ry.ArgumentError, match="'b0' has no mass"):
        plan.execute(ry.BotOp(light))
    with pytest.raises(ry.ArgumentError, match=r"execute: expected a BotOp, got Config; make one by BotOp\(C\)"):
        plan.execute(C)
    with pytest.raises(ry.ArgumentError, match="repairs is -1; expected 0 or more"):
        plan.execute(ry.BotOp(C), repairs=-1)
    with pytest.raises(ry.ArgumentError, match="was not made by planTask"):
        ry.TaskPlan(plan.actions, plan.path, plan.times, plan.segments).repair(C)


def test_a_drawer_is_opened_in_simulation_and_a_box_put_into_it() -> None:
    C, plan = planned(panda_tasks.stow(0))
    assert [a[0] for a in plan.actions] == ["hold", "open", "pick", "place"]
    bot = ry.BotOp(C)
    run = plan.execute(bot)
    assert run.feasible, run
    assert ry.doorStates(C) == {"drawer": "closed"} and ry.doorStates(bot.getWorld()) == {"drawer": "opened"}
    assert run.C.getFrame("cup").getParent().name == "drawer_floor"
    assert plan.repair(run.C).actions == []


def test_a_drawer_that_is_not_where_it_was_is_noticed_and_repaired() -> None:
    C, plan = planned(panda_tasks.drawer(0))
    world = C.copy()
    world.getFrame("drawer").setJointState([-0.08])
    bot = ry.BotOp(world)
    run = plan.execute(bot, repairs=0)
    assert not run.feasible and "'drawer' is 0.080 (m or rad) away from where it should be" in run.message
    repaired = plan.repair(run.C)
    assert repaired.feasible and repaired.start.count("(ajar drawer)") == 1
    assert repaired.execute(bot).feasible


def test_a_drawer_that_is_stuck_is_noticed_and_repaired() -> None:
    C, plan = planned(panda_tasks.drawer(1))
    stuck = C.copy()
    stuck.getFrame("drawer").setAttributes({"jointFriction": 300.0})
    run = plan.execute(ry.BotOp(stuck), repairs=0)
    assert not run.feasible and run.done == 1, run
    assert "'drawer' is 0." in run.message or "the robot is held up" in run.message
    run.C.getFrame("drawer").setAttributes({"jointFriction": 0.0})
    repaired = plan.repair(run.C)
    assert repaired.feasible and repaired.execute(ry.BotOp(run.C)).feasible


def test_what_a_simulation_of_drawers_needs_is_told_before_anything_moves() -> None:
    C, plan = planned(panda_tasks.fetch(0))
    with pytest.raises(ry.ArgumentError, match=r"'cup' hangs below 'drawer'.*call C.getFrame\('cup'\).unLink\(\)"):
        plan.execute(ry.BotOp(C))
    C.getFrame("cup").unLink()
    driven = C.copy()
    driven.getFrame("drawer").setAttributes({"noMotor": False})
    with pytest.raises(ry.ArgumentError, match="a motor moves 'drawer' in the simulated world"):
        plan.execute(ry.BotOp(driven))
    assert plan.execute(ry.BotOp(C)).feasible


def test_a_world_that_is_disturbed_on_the_way_is_repaired(tower) -> None:
    C, plan = tower
    bot = ry.BotOp(C)
    run, kinds = plan.run(bot, time_limit=60), []
    for event in run:
        kinds.append(event.kind.name)
        if kinds.count("grip") == 1 and kinds[-1] == "grip":  # somebody takes the cube out of the hand
            bot.setFramePose("b0", C.getFrame("b0").getPose() + np.array([0.0, -0.12, 0.001, 0, 0, 0, 0]))
    assert run.result.feasible and run.result.repairs == 1, run.result
    assert kinds[:3] == ["start", "motion", "grip"] and kinds[-1] == "end"
    assert run.plan.feasible and "reached the goal" in str(run.result)


def bars(size=(0.12, 0.016, 0.016)) -> ry.Config:
    """A bar on the table, between the fingers of a hand from above, and a tray."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    bar = C.addFrame("bar", "table").setRelativePosition([0.25, 0.27, 0.05 + 0.5 * size[2]]).setJoint(ry.JT.rigid)
    bar.setShape(ry.ST.ssBox, [*size, 0.002]).setContact(1).setMass(0.05)
    tray = C.addFrame("tray", "table").setRelativePosition([-0.25, 0.27, 0.055])
    tray.setShape(ry.ST.ssBox, [0.26, 0.26, 0.01, 0.004]).setContact(1)
    return C


ON_ITS_SIDE = np.sqrt(0.5) * np.array([1, 1, 0, 0])


def disturbed(C, plan, action, position, rotation, repairs=3) -> tuple[ry.TaskExecution, ry.Config]:
    """Executes a plan; somebody moves the bar after an action, or before the first one (-1)."""
    bot = ry.BotOp(C)
    run, is_done = plan.run(bot, repairs=repairs), False
    for event in run:
        if event.index == action and event.kind in (ry.TaskEventKind.start, ry.TaskEventKind.grip) and not is_done:
            is_done = True
            bot.setFramePose("bar", np.concatenate([position, rotation]))
    return run.result, bot.getWorld()


def test_a_hand_opens_where_it_pushes_nothing_over() -> None:
    C = bars()
    beside = C.getFrame("bar").getPosition() + np.array([0.01, -0.056, 0])
    result, world = disturbed(C, ry.planTask(C, "(on tray bar)"), 0, beside, [1, 0, 0, 0])
    assert result.feasible and result.repairs == 1, result
    assert world.getFrame("bar").getRotationMatrix()[2, 2] > 0.99


def test_what_has_fallen_is_put_up_again() -> None:
    C = bars((0.04, 0.05, 0.1))
    fallen = C.getFrame("bar").getPosition() + np.array([0.03, 0, -0.025])
    result, world = disturbed(C, ry.planTask(C, "(on tray bar)"), -1, fallen, ON_ITS_SIDE)
    assert result.feasible and result.repairs == 1, result
    assert world.getFrame("bar").getRotationMatrix()[2, 2] > 0.99
    assert world.getFrame("bar").getPosition()[2] == pytest.approx(0.66 + 0.05, abs=2e-3)


@pytest.mark.parametrize("repairs", [0, 3])
def test_an_object_that_lies_where_it_shall_stand_is_no_success(repairs: int) -> None:
    C = bars((0.04, 0.05, 0.1))
    lying = C.getFrame("tray").getPosition() + np.array([0, 0, 0.005 + 0.025])
    result, world = disturbed(C, ry.planTask(C, "(on tray bar)"), 1, lying, ON_ITS_SIDE, repairs)
    stands = world.getFrame("bar").getRotationMatrix()[2, 2] > 0.99
    assert result.feasible == stands == (repairs > 0), result
    assert stands or result.message == "'bar' has fallen: it stands on another side than planned"


def second(C: ry.Config, rotation, height: float) -> None:
    b2 = C.addFrame("b2", "table").setRelativePosition([0.45, 0.2, 0.05 + height]).setRelativeQuaternion(rotation)
    b2.setJoint(ry.JT.rigid).setShape(ry.ST.ssBox, [0.04, 0.05, 0.1, 0.004]).setContact(1).setMass(0.05)


def test_an_object_that_lies_stays_so_when_another_one_is_put_up_again() -> None:
    C = bars((0.04, 0.05, 0.1))
    second(C, ON_ITS_SIDE, 0.025)
    fallen = C.getFrame("bar").getPosition() + np.array([0.03, 0, -0.025])
    result, world = disturbed(C, ry.planTask(C, "(on tray bar) (on tray b2)"), -1, fallen, ON_ITS_SIDE)
    ups = [world.getFrame(name).getRotationMatrix()[2] for name in ("bar", "b2")]
    assert result.feasible and ups[0][2] > 0.99 and abs(ups[1][1]) > 0.99, (result, ups)


def test_an_object_that_settles_has_not_fallen() -> None:
    C = bars((0.04, 0.05, 0.1))
    tilt = np.radians(14) / 2
    second(C, [np.cos(tilt), np.sin(tilt), 0, 0], 0.058)
    result, world = disturbed(C, ry.planTask(C, "(on tray bar)"), None, [], [])
    assert world.getFrame("b2").getRotationMatrix()[2, 2] > 0.99
    assert result.feasible, result


WITHOUT_SIDES = """
is_gripper is_object is_place on busy
DecisionRule pick { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! (on Obj ANY)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule place { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) (on Obj To)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) } }
"""


def test_a_domain_without_sides_is_repaired_without_them(tmp_path) -> None:
    (tmp_path / "own.fol").write_text(WITHOUT_SIDES)
    C = bars((0.04, 0.05, 0.1))
    plan = ry.planTask(C, "(on tray bar)", domain=ry.Domain.fromFol(str(tmp_path / "own.fol")))
    fallen = C.getFrame("bar").getPosition() + np.array([0.03, 0, -0.025])
    result, _ = disturbed(C, plan, -1, fallen, ON_ITS_SIDE)
    assert not result.feasible and "'bar' has fallen: it stands on another side than planned" in result.message
    assert result.message.endswith("no plan puts bar up again")
    repaired = plan.repair(C, also="(up z bar)")
    assert "the goal is without (up z bar), because the domain has no `up`" in repaired.warnings
    assert pickle.loads(pickle.dumps(repaired)).repair(C).goal == plan.goal


def test_a_ball_may_roll() -> None:
    C = bars()
    C.getFrame("bar").setShape(ry.ST.sphere, [0.025]).setRelativePosition([0.25, 0.27, 0.075])
    rolled = C.getFrame("bar").getPosition() + np.array([0.003, 0, 0])
    result, _ = disturbed(C, ry.planTask(C, "(on tray bar)"), -1, rolled, ON_ITS_SIDE)
    assert result.feasible and result.repairs == 0, result


def test_an_execution_starts_where_the_robot_is(tower) -> None:
    C, plan = tower
    rng = np.random.default_rng(0)
    for off in (0.002, 0.1, 0.5):
        beside = C.copy()
        beside.setJointState(C.getJointState() + off * rng.uniform(-1, 1, 7))
        run = plan.execute(ry.BotOp(beside))
        assert run.feasible and run.repairs == 0, (off, run)


def test_a_drawer_a_little_beyond_its_limit_is_at_it() -> None:
    C, plan = planned(panda_tasks.drawer(0))
    world = C.copy()
    q = world.getJointState()
    arm = [name != "drawer" for name in world.getJointNames()]
    world.setJointState(q + np.where(arm, 0.05, 4e-4))  # as a simulation leaves it at its stop
    run = plan.execute(ry.BotOp(world), repairs=0)
    assert run.feasible, run


def test_cameras_replace_the_state_of_the_simulation(tower) -> None:
    C, plan = tower
    bot = ry.BotOp(C)
    run = plan.execute(bot, observe=lambda: {"b0": None, "b1": bot.getWorld().getFrame("b1").getPose()})
    assert run.feasible, run
    wrong = C.getFrame("b0").getPose() + np.array([0.0, 0.1, 0, 0, 0, 0, 0])
    run = plan.execute(ry.BotOp(C), observe=lambda: {"b0": wrong}, repairs=0)
    assert "'b0' is 0.100 m away from where it should be" in run.message
    with pytest.raises(ry.FrameNotFound, match="cup"):
        plan.execute(ry.BotOp(C), observe=lambda: {"cup": wrong})


def test_a_hand_that_closes_on_nothing_holds_nothing_for_its_repair(tower) -> None:
    C, plan = tower
    world = C.copy()
    block = world.getFrame(plan.actions[0][1])
    block.setPosition(block.getPosition() + np.array([0.0, -0.25, 0.0]))  # and no camera sees it
    run = plan.execute(ry.BotOp(world), observe=lambda: {}, repairs=1)
    assert not run.feasible and run.repairs == 1, run
    assert "closed on nothing" in run.message


def test_a_callback_ends_an_execution(tower) -> None:
    C, plan = tower
    run = plan.execute(ry.BotOp(C), callback=lambda event: event.kind != ry.TaskEventKind.motion)
    assert not run and run.done == 0 and "stopped by its caller" in run.message


def test_a_finger_that_lands_on_a_thing_is_a_result_and_repaired(tower) -> None:
    C, plan = tower
    world = C.copy()
    rock = world.addFrame("rock", "table").setRelativePosition([*C.getFrame("b0").getRelativePosition()[:2], 0.12])
    rock.setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.004]).setContact(1)  # above the cube, and unknown to the plan
    run = plan.execute(ry.BotOp(world), repairs=0)
    assert not run.feasible and run.message


def test_a_hand_that_holds_a_thing_opens_for_a_wider_one() -> None:
    C = panda_tasks.scene()
    panda_tasks.pad(C, "tray", [0.3, 0.35], [0.26, 0.26])
    panda_tasks.box(C, "a", "table", [-0.35, 0.25], [0.04, 0.04, 0.07])
    panda_tasks.box(C, "b", "table", [-0.1, 0.4], [0.06, 0.06, 0.07])
    held = ry.planTask(C, "(on l_gripper a)").execute(ry.BotOp(C))
    assert held.feasible
    plan = ry.planTask(held.C, "(on tray a) (on tray b)")
    assert plan.feasible and len(plan.actions) == 3, plan
    assert ry.checkTaskPlan(held.C, plan) == []


def test_limits_of_a_repair_replace_those_of_the_plan(tower) -> None:
    C, plan = tower
    np.testing.assert_array_equal(plan.repair(C, threads=2, time_limit=1e3).path, plan.path)
    C = panda_tasks.scene()
    panda_tasks.pad(C, "pad", [0.3, 0.35], [0.09, 0.09])
    panda_tasks.box(C, "jug", "pad", [0.0, 0.0], [0.05, 0.05, 0.07])
    panda_tasks.box(C, "cup", "table", [-0.3, 0.3], [0.05, 0.1, 0.07])  # too long for it to stand whole
    plan = ry.planTask(C, "(on pad cup)")  # the jug has to make way, as the search finds out
    assert plan.feasible and len(plan.actions) == 4
    starved = plan.repair(C, max_evaluations=1)
    assert starved.status == ry.TaskStatus.no_plan_found and "no plan within max_evaluations; " in starved.message


def test_a_scene_after_an_execution_has_the_parents_of_its_end() -> None:
    C = panda_tasks.scene()
    panda_tasks.pad(C, "left", [-0.35, 0.35], [0.2, 0.2])
    panda_tasks.box(C, "low", "table", [0.2, 0.35], [0.06, 0.06, 0.06])
    panda_tasks.box(C, "top", "low", [0.0, 0.0], [0.05, 0.05, 0.06])
    plan = ry.planTask(C, "(on left top) (on l_gripper low)")
    run = plan.execute(ry.BotOp(C))
    assert run.feasible, run
    assert run.C.getFrame("top").getParent().name == "left" and run.C.getFrame("low").getParent().name == "l_gripper"


def test_a_thing_that_is_moved_leaves_the_grip_of_another_alone() -> None:
    C = panda_tasks.scene()
    panda_tasks.box(C, "a", "table", [-0.3, 0.3], [0.05, 0.05, 0.07])
    panda_tasks.box(C, "b", "table", [0.35, 0.3], [0.05, 0.05, 0.07])
    bot = ry.BotOp(C)
    assert ry.planTask(C, "(on l_gripper a)").execute(bot)
    D = C.copy()

    def force() -> float:
        contacts = [c for c in bot.getContacts() if "a" in c["frames"]]
        return sum(float(np.linalg.norm(c["force"])) for c in contacts)

    bot.sync(D, 0.1)
    before = force()
    at = D.getFrame("b").getPose() + np.array([0.05, 0, 0, 0, 0, 0, 0])
    bot.setFramePose("b", at)
    bot.sync(D, 0.3)
    np.testing.assert_allclose(D.getFrame("b").getPose()[:3], at[:3], atol=1e-3)
    assert before > 20 and force() == pytest.approx(before, rel=0.05)


@pytest.mark.filterwarnings("ignore:no moving shape of the scene")
def test_the_base_of_a_robot_is_no_object() -> None:
    C = ry.Config()
    C.addText("world: {}\ntable (world): { shape: ssBox, size: [2 2 .1 .02] }")
    C.addFile(ry.raiPath("ur10/ur10.g"))
    C.getFrame("ur_world").setParent(C.getFrame("table"))
    C.addFrame("gripper", "ur_ee_fixed_joint")
    cup = C.addFrame("cup", "table").setRelativePosition([0.5, 0.5, 0.1]).setJoint(ry.JT.rigid)
    cup.setShape(ry.ST.ssBox, [0.05, 0.05, 0.1, 0.005])
    assert any(literal.startswith("(is_object ur_") for literal in ry.sceneFacts(C))
    assert [word for word in ry.planTask(C, "(on gripper cup)").start if word.startswith("(is_object")] == [
        "(is_object cup)"
    ]


@pytest.mark.parametrize("is_observed", [False, True])
def test_a_repair_waits_for_what_falls(tower, is_observed: bool) -> None:
    C, plan = tower
    bot = ry.BotOp(C)

    def look() -> dict:
        world = bot.getWorld()
        return {name: world.getFrame(name).getPose() for name in ("b0", "b1")}

    run = plan.run(bot, repairs=1, observe=look if is_observed else None)
    obj = plan.actions[0][1]
    above = C.getFrame(obj).getPosition() + np.array([0.05, 0, 0.4])
    for event in run:
        if event.kind == ry.TaskEventKind.start and run.result.repairs == 0:
            bot.setFramePose(obj, [*above, 1, 0, 0, 0])
    assert run.result.feasible and run.result.repairs == 1, run.result


def test_success_is_judged_when_nothing_falls_any_more() -> None:
    C = bars((0.04, 0.05, 0.1))
    C.getFrame("bar").setParent(C.getFrame("tray")).setRelativePosition([0.05, 0.05, 0.055])
    second(C, [1, 0, 0, 0], 0.05)
    plan = ry.planTask(C, "(on tray bar) (on tray b2)")
    assert len(plan.actions) == 2
    result, _ = disturbed(C, plan, 1, [0.2, 0.5, 1.05], [1, 0, 0, 0], repairs=0)
    assert not result.feasible and "(on tray bar) does not hold" in result.message, result


def test_a_stop_also_ends_the_wait_for_a_hand(tower) -> None:
    C, plan = tower
    bot = ry.BotOp(C)
    times = []

    def look() -> dict:
        if times:
            run.stop()
        return {}

    run = plan.run(bot, observe=look)
    for event in run:
        if event.kind == ry.TaskEventKind.motion:
            times.append(bot.get_t())
    assert run.result.done == 0 and "stopped by its caller" in run.result.message
    assert bot.get_t() - times[0] < 1.0


def test_a_repair_may_have_a_further_goal(tower) -> None:
    C, plan = tower
    obj = plan.actions[0][1]
    more = plan.repair(C, also=f"(on table {obj})!")
    assert more.feasible and more.goal[-1] == f"(on table {obj})!", more.goal
    assert pickle.loads(pickle.dumps(more)).repair(C).goal == more.goal
    with pytest.raises(ry.ParseError, match="nowhere"):
        plan.repair(C, also="(nowhere cup)")
