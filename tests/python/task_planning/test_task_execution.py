"""Plans carried out in simulation: hands hold objects by friction, and failures are noticed and repaired."""

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
    run = plan.execute(bot)
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
    away = C.copy()
    away.setJointState(away.getJointState() + 0.2)
    with pytest.raises(ry.ArgumentError, match="the robot is not where the plan begins"):
        plan.execute(ry.BotOp(away))
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
    run = plan.execute(bot)
    assert not run.feasible and "'drawer' is 0.080 (m or rad) away from where it should be" in run.message
    repaired = plan.repair(run.C)
    assert repaired.feasible and repaired.start.count("(ajar drawer)") == 1
    assert repaired.execute(bot).feasible


def test_a_drawer_that_is_stuck_is_noticed_and_repaired() -> None:
    C, plan = planned(panda_tasks.drawer(1))
    stuck = C.copy()
    stuck.getFrame("drawer").setAttributes({"jointFriction": 300.0})
    run = plan.execute(ry.BotOp(stuck))
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
