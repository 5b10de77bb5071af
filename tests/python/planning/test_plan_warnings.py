"""What a plan says of its ends, and how long its stages took."""

import time

import numpy as np
import pytest

import kinegraph as ry


def cart() -> ry.Config:
    C = ry.Config()
    C.addText("""base: {}
x (base): { joint: transX, limits: [-3 3] }
y (x): { joint: transY, limits: [-3 3], shape: sphere, size: [.1], contact: 1 }
wall: { X: [.605 0 0], shape: box, size: [1 .2 .2], contact: 1 }""")
    return C


@pytest.mark.parametrize("margin", [0.02, 0.1])
def test_a_margin_that_an_end_does_not_keep_is_a_warning(margin: float) -> None:
    plan = ry.planMotion(cart(), [0.0, 2.0], margin=margin)
    assert plan.feasible and len(plan.warnings) == 1
    assert "the start does not keep the margin" in plan.warnings[0] and "'y' and 'wall'" in plan.warnings[0]
    assert "5 mm" in plan.warnings[0] and plan.warnings[0] in plan.explain()
    assert plan.clearance() == pytest.approx(0.005, abs=1e-3)
    back = ry.planMotion(cart(), [0.0, 0.0], start=[0.0, 2.0], margin=margin)
    assert len(back.warnings) == 1 and "the goal does not keep the margin" in back.warnings[0]


def test_a_margin_that_is_kept_is_none() -> None:
    assert ry.planMotion(cart(), [0.0, 2.0], margin=0.004).warnings == []


def test_the_stages_add_up_to_the_call() -> None:
    C = cart()
    for _ in range(3):  # the machine may be busy in between
        began = time.perf_counter()
        plan = ry.planMotion(C, [2.0, 0.0], margin=0.01)
        seconds = time.perf_counter() - began
        total = sum(stage["seconds"] for stage in plan.stages)
        assert total <= seconds
        if total > 0.95 * seconds - 2e-4:
            return
    pytest.fail(f"{total} of {seconds} s")


def test_a_refused_query_explains_itself() -> None:
    C = cart()
    finder = ry.RRT_PathFinder().setProblem(C, [0.2, 0.0], [0.0, 2.0])
    result = finder.solve()
    assert not result.feasible and "the start collides" in str(result.explain())


def test_quaternions_of_a_path_have_length_1() -> None:
    C = ry.Config()
    C.addText("world: {}\nbody (world): { joint: free, shape: ssBox, size: [.3 .2 .1 .01], contact: 1 }")
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addControlObjective([], 0, 1e-2)
    komo.addObjective([], ry.FS.positionRel, ["world", "body"], ry.OT.eq, [10.0], [0.1, 0.4, 0.3])
    ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert np.linalg.norm(komo.getPath()[0][3:]) == pytest.approx(1, abs=1e-12)
