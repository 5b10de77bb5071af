"""Plans carried out in simulation: what is grasped is held by friction, and what goes wrong is noticed and repaired."""

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


def test_what_is_taken_out_of_the_hand_is_noticed(tower) -> None:
    C, plan = tower

    class Thief:
        """A robot from whose hand somebody takes the cube on its way."""

        def __init__(self, bot):
            self.bot, self.moves = bot, 0

        def __getattr__(self, name):
            return getattr(self.bot, name)

        def move(self, path, times):
            self.bot.move(path, times)
            self.moves += 1
            if self.moves == 2:
                self.bot.sync(self.bot.getWorld(), 0.5 * times[-1])
                self.bot.setFramePose("b0", [-0.3, 0.1, 0.7, 1, 0, 0, 0])

    bot = Thief(ry.BotOp(C))
    run = plan.execute(bot)
    assert not run.feasible and run.done == 1 and "'b0' is not in 'l_gripper'" in run.message
    assert run.C.getFrame("b0").getParent().name == "table"
    repaired = plan.repair(run.C)
    assert repaired.feasible and [a[0] for a in repaired.actions] == ["pick", "place"]
    assert repaired.execute(bot.bot).feasible


def test_mistakes_are_told_before_anything_moves(tower) -> None:
    C, plan = tower
    light = C.copy()
    light.getFrame("b0").setMass(0.0)
    with pytest.raises(ry.ArgumentError, match="'b0' has no mass"):
        plan.execute(ry.BotOp(light))
    away = C.copy()
    away.setJointState(away.getJointState() + 0.2)
    with pytest.raises(ry.ArgumentError, match="the robot is not where the plan begins"):
        plan.execute(ry.BotOp(away))
    with pytest.raises(ry.ArgumentError, match="was not made by planTask"):
        ry.TaskPlan("solved", "").repair(C)


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


def test_a_drawer_that_comes_loose_is_noticed_and_repaired() -> None:
    C, plan = planned(panda_tasks.drawer(1))

    class Loose:
        """A robot whose gripper does not close on the handle the first time."""

        def __init__(self, bot):
            self.bot, self.is_loose = bot, True

        def __getattr__(self, name):
            return getattr(self.bot, name)

        def gripperCloseGrasp(self, number, obj, force):
            if not self.is_loose:
                self.bot.gripperCloseGrasp(number, obj, force=force)
            self.is_loose = False

    bot = Loose(ry.BotOp(C))
    run = plan.execute(bot)
    assert not run.feasible and run.done == 1 and "'drawer' is 0." in run.message
    repaired = plan.repair(run.C)
    assert repaired.feasible and repaired.execute(bot).feasible


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
