"""Execution of plans of tasks in simulation."""

import kinegraph as ry


def executed(C, plan) -> ry.Config:
    """The simulated world 2 s after the execution of a plan."""
    assert plan.feasible, plan
    assert ry.checkTaskPlan(C, plan) == []
    bot = ry.BotOp(C)
    run = plan.execute(bot, repairs=0)
    assert run.feasible, run
    world = C.copy()
    bot.sync(world, 2.0)
    return world
