"""A waypoint of a tool path that is dragged on the page: the next key plans the path again."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .browser import Browser
from .program import KinematicModel


def test_a_dragged_waypoint_is_planned_again(browser: Browser, start: Callable[..., KinematicModel]) -> None:
    program = start("""
C = kg.Config()
C.addFile(kg.raiPath('scenarios/pandaSingle.g'))
tool = C.addFrame('tool', 'l_gripper').setRelativePosition([0, 0, -0.08])
pose = tool.getPose()
goal = C.addFrame('goal').setShape(kg.ST.marker, [0.1]).setPosition(pose[:3] + [0.1, 0.2, -0.1])
C.view()
C.viewer().setCamera([0, 2.5, 1.2], [0, 0, 1.2])
C.viewer().select(goal.ID)
C.viewer().waitForClient(60)
key, round = -1, 0
while key not in (0, ord('q')):
    path = kg.ToolPath('tool').start(pose).line(goal.getPosition())
    plan = kg.planToolPath(C, path)
    plan.view(C, path)
    q = plan.eval(plan.duration)[0]
    print(f'end{round}', *C.evalBatch(kg.FS.position, ['tool'], q[None])[0][0])
    print(f'goal{round}', *goal.getPosition(), flush=True)
    key = C.view(True, f'plan {round}: drag the goal, then press a key; q ends')
    round += 1
""")
    browser.open(program.url())
    browser.wait_for("kinegraph.message().includes('plan 0: drag the goal')")
    browser.wait_for("kinegraph.selected() == 'goal'")
    x, y, z = browser.evaluate("kinegraph.position('goal')")
    handle = browser.upper_handle("goal")
    browser.drag(handle, (handle[0], handle[1] - 20))
    browser.wait_for(f"kinegraph.position('goal')[2] > {z} + 0.02")
    browser.press("n")
    browser.wait_for("kinegraph.message().includes('plan 1: drag the goal')")
    there = browser.evaluate("kinegraph.position('goal')")  # now that the last step of the drag has arrived
    browser.press("q")
    first, second, goal = (np.array(program.line(name).split(), float) for name in ("end0", "end1", "goal1"))
    assert np.abs(first - [x, y, z]).max() < 1e-4
    assert np.abs(goal - there).max() < 1e-4
    assert np.abs(second - goal).max() < 3e-5 and second[2] > first[2] + 0.02
