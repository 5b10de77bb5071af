"""Continuously collision-free motions and their reports."""

import importlib.util
import itertools
import pickle
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import kinegraph as ry

SCENE = """
base: {}
ball (base): { joint: transX, shape: sphere, size: [.1], contact: 1 }
wall (base): { Q: [.6 0 0], shape: box, size: [.03 1 1], contact: 1 }
"""


def across(slices: int = 4, goal: float = 1.0, order: int = 2) -> tuple[ry.KOMO, ry.SolverReturn]:
    C = ry.Config()
    C.addText(SCENE)
    komo = ry.KOMO(C, 1, slices, order, True)
    komo.addControlObjective([], order, 1.0)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0])
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [], [goal])
    return komo, ry.NLP_Solver(komo.nlp()).solve()


def test_a_path_that_jumps_over_a_wall_is_feasible_but_not_free() -> None:
    komo, result = across()
    assert result.feasible
    assert result.free is False
    assert "the solution is invalid between slices: 'ball' and 'wall' overlap by 115 mm at phase time" in result.message
    assert not komo.isFree()
    contact = min(komo.checkMotion(), key=lambda c: c.distance)
    assert contact.frames == ("ball", "wall")
    assert contact.distance == pytest.approx(-0.115, abs=1e-6)
    assert contact.time < contact.deepest <= (contact.slice + 1) / 4
    assert "overlap by 115 mm" in repr(contact)


def test_a_path_before_the_wall_is_free() -> None:
    komo, result = across(goal=0.4)
    assert result.free is True
    assert "free" not in result.message
    assert komo.isFree(0.08) and not komo.isFree(0.09)


def test_what_is_no_motion_is_not_judged() -> None:
    assert across(slices=1)[1].free is None
    C = ry.Config()
    C.addText(SCENE)
    komo = ry.KOMO(C, 1, 4, 2, True)
    komo.addControlObjective([], 2, 1.0)
    assert ry.NLP_Solver(komo.nlp()).solve().free is None
    assert ry.SolverReturn().free is None


def test_the_verdict_goes_along_with_a_pickle() -> None:
    result = across()[1]
    copy = pickle.loads(pickle.dumps(result))
    assert copy.free is False
    assert copy.message == result.message
    assert pickle.loads(pickle.dumps(across(slices=1)[1])).free is None


def test_scripts_for_robotic_get_the_same_reports() -> None:
    import robotic

    komo, _ = across()
    result = robotic.NLP_Solver(komo.nlp()).solve()
    assert result.feasible and result.free is False and "'ball' and 'wall'" in result.message


def test_a_panda_is_checked_as_its_configuration_is() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    rng = np.random.default_rng(0)
    agree = set()
    for _ in range(20):
        path = np.clip(C.getJointState() + rng.normal(0.0, 0.5, (3, 7)).cumsum(0), *C.getJointLimits())
        komo = ry.KOMO(C, 1, 3, 1, False)
        komo.initWithPath(path)
        rows = np.vstack([C.getJointState(), path])
        motions = [C.checkMotion(a, b, tolerance=1e-5) for a, b in itertools.pairwise(rows)]
        contacts = komo.checkMotion()
        assert [c.slice for c in contacts] == [t for t, m in enumerate(motions) if m]
        for contact, motion in zip(contacts, filter(None, motions), strict=True):
            assert contact.frames == motion.frames
            assert contact.time == pytest.approx((contact.slice + motion.time) / 3)
            assert contact.distance <= motion.distance + 1e-9
        agree.add(bool(contacts))
    assert agree == {True, False}


def benchmark() -> ModuleType:
    file = Path(__file__).parents[3] / "benchmarks" / "free_between_slices.py"
    spec = importlib.util.spec_from_file_location("free_between_slices", file)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.filterwarnings("ignore:.*overlap at a constant relative pose")
def test_what_is_called_free_among_thin_walls_is_free() -> None:
    """Some problems of benchmarks/free_between_slices.py, started with a line through the obstacles."""
    problems = benchmark()
    rng = np.random.default_rng(5)
    free = {False: 0, True: 0}
    for _ in range(5):
        C, start, goal = problems.among_obstacles("panda", rng)
        for at_all_times in free:
            komo = problems.make_komo(C, goal, 16, at_all_times)
            komo.initWithPath(problems.line(start, goal, 16))
            result = ry.NLP_Solver(komo.nlp()).solve()
            is_free = problems.is_truly_free(C, np.vstack([start, komo.getPath()]))
            assert is_free or not result.free
            if at_all_times and result.feasible:
                assert result.free and komo.isFree(problems.MARGIN), "feasible means free with the margin at all times"
            free[at_all_times] += result.feasible and is_free
    assert free[True] >= 4 and free[True] >= free[False]


@pytest.mark.filterwarnings("ignore:.*overlap.* at a constant relative pose")
def test_a_spline_that_is_called_free_is_free() -> None:
    """Few slices, so that the spline is far from the lines between them."""
    problems = benchmark()
    rng = np.random.default_rng(31)
    feasible = 0
    for _ in range(4):
        C, start, goal = problems.among_obstacles("panda", rng)
        komo = problems.make_komo(C, goal, 10, True)
        komo.initWithPath(problems.line(start, goal, 10))
        motion = ry.SplineMotion(komo, 8)
        result = ry.NLP_Solver(motion.nlp()).solve()
        assert result.free is motion.isFree()
        if not result.feasible:
            continue
        feasible += 1
        assert result.free and motion.isFree(problems.MARGIN)
        limits = C.getJointLimits()
        samples = np.clip(motion.spline().eval(np.linspace(0, 1, 5000)), limits[0], limits[1])
        assert C.isValid(samples, margin=problems.MARGIN - 1e-6).all()
    assert feasible >= 3


def test_a_motion_that_is_to_be_free_keeps_its_margin() -> None:
    C = ry.Config()
    C.addText("""
        base: {}
        ball (base): { joint: transXY, shape: sphere, size: [.04], contact: 1 }
        wall (base): { Q: [.5 -.2 0], shape: box, size: [.03 .6 1.], contact: 1 }
    """)
    komo = ry.KOMO(C, 1, 10, 2, False)
    komo.addControlObjective([], 2, 1.0)
    komo.addFreeMotion(margin=0.005)
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [10.0], [1.0, 0.0])
    s = np.linspace(0.1, 1.0, 10)
    komo.initWithPath(np.column_stack([s, 0.25 * np.sin(np.pi * s)]))
    copy = pickle.loads(pickle.dumps(komo))
    result = ry.NLP_Solver(komo.nlp()).solve()
    assert result.feasible and result.free and komo.isFree(0.005) and not komo.isFree(0.01)
    assert np.array_equal(ry.NLP_Solver(copy.nlp()).solve().x, result.x), "a copy is solved to the same bits"
    assert "free" not in result.message
    assert komo.report()["totals"]["ineq"] == 0


def test_collisions_have_a_margin() -> None:
    C = ry.Config()
    C.addText(SCENE)
    C.setJointState([0.465])  # 20 mm off the wall
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.ineq, [1.0], margin=0.05)
    komo.addObjective([], ry.FS.negDistance, ["ball", "wall"], ry.OT.ineq, [1.0], margin=0.05)
    assert np.allclose(komo.info_objectiveErrorTraces(), 0.03)
    with pytest.raises(ry.ArgumentError, match="jointState|qItself"):
        komo.addObjective([], ry.FS.jointState, [], ry.OT.ineq, [1.0], margin=0.05)
    with pytest.raises(ry.ArgumentError, match="margin is -1"):
        komo.addFreeMotion(margin=-1.0)


def test_pairs_that_overlap_now_are_ignored_from_then_on() -> None:
    C = ry.Config()
    C.addText("""
        world: {}
        base (world): { shape: sphere, size: [.1], contact: 1 }
        a (base): { joint: transX, shape: sphere, size: [.1], contact: 1 }
        wall (world): { Q: [.5 0 0], shape: box, size: [.1 1 1], contact: 1 }
    """)
    assert C.ignoreCollisionsNow() == [("base", "a", pytest.approx(-0.2))]
    assert C.ignoreCollisionsNow() == [] and C.isValid([[0.0]])[0]
    C.setJointState([0.45])
    assert [pair[:2] for pair in C.getCollisions()] == [("a", "wall")]


def test_steps_from_slice_to_slice_have_a_limit() -> None:
    C = ry.Config()
    C.addText("base: {} arm (base): { joint: hingeZ }")
    komo = ry.KOMO(C, 1, 8, 2, False)
    komo.addControlObjective([], 2, 1.0)
    komo.addStepLimit(0.14)
    komo.addObjective([1.0], ry.FS.jointState, [], ry.OT.eq, [], [1.0])
    assert ry.NLP_Solver(komo.nlp()).solve().feasible
    assert np.abs(np.diff(komo.getPath(), axis=0, prepend=0.0)).max() < 0.14 + 1e-4
    with pytest.raises(ry.ArgumentError, match="step is 0"):
        komo.addStepLimit(0.0)
