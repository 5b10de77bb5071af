"""Motions that are free of collisions at all times: what is told of them."""

import itertools
import pickle

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
    assert "the motion is not free: 'ball' and 'wall' overlap by 115 mm at phase time" in result.message
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


def test_scripts_for_robotic_are_told_the_same() -> None:
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
        path = C.getJointState() + rng.normal(0.0, 0.5, (3, 7)).cumsum(0)
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
