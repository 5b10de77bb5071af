"""Motion problems whose variables are the control points of a B-spline."""

import numpy as np
import pytest

import kinegraph as ry


@pytest.fixture
def komo(panda):
    panda.addFrame("goal", "table").setRelativePosition([-0.3, 0.35, 0.3])
    komo = ry.KOMO(panda, 1, 24, 2, True)
    komo.addControlObjective([], 2, 0.1)
    komo.addObjective([], ry.FS.accumulatedCollisions, [], ry.OT.eq, [10.0])
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "goal"], ry.OT.eq, [10.0])
    return komo


@pytest.mark.parametrize(("degree", "rests"), [(1, False), (2, True), (3, True), (3, False), (5, True)])
def test_the_slices_lie_on_the_spline(komo, degree, rests):
    start = komo.getConfiguration(-1).getJointState()
    motion = ry.SplineMotion(komo, 6, degree, ends_at_rest=rests)
    result = ry.NLP_Solver(motion.nlp(), verbose=0).solve()
    assert result.feasible
    assert len(result.x) == motion.nlp().dimension == 7 * (6 + (0 if rests else degree // 2))
    spline = motion.spline()
    t = np.linspace(0, 1, 25)
    np.testing.assert_allclose(spline.eval(t[1:]), komo.getPath(), atol=1e-9)
    np.testing.assert_allclose(spline.eval([0.0])[0], start, atol=1e-12)
    assert repr(motion) == f"<SplineMotion 6 control points of degree {degree}, 24 slices>"


def test_jacobians_are_differences(komo):
    nlp = ry.SplineMotion(komo, 5).nlp()
    nlp.checkJacobian(np.random.default_rng(0).normal(0, 0.3, nlp.dimension), 1e-4)


def test_the_reports_are_those_of_the_komo(komo):
    ry.NLP_Solver(ry.SplineMotion(komo, 5).nlp(), verbose=0).solve()
    assert "positionDiff" in str(komo.report())
    assert komo.getConstraintViolations() < 1e-3


def test_verdicts_are_about_the_spline(komo):
    motion = ry.SplineMotion(komo, 5)
    result = ry.NLP_Solver(motion.nlp(), verbose=0).solve()
    assert result.feasible and result.free is motion.isFree(0.0) is motion.isFree()
    assert not motion.isFree(1.0)
    with pytest.raises(ry.ArgumentError, match="margin is nan"):
        motion.isFree(float("nan"))


def test_what_does_not_fit_is_said(komo):
    with pytest.raises(ry.ArgumentError, match="points is 25; expected 1 to 24"):
        ry.SplineMotion(komo, 25)
    with pytest.raises(ry.ArgumentError, match="do not determine 26 control points"):
        ry.SplineMotion(komo, 24, 5, ends_at_rest=False)
    with pytest.raises(ry.ArgumentError, match="degree is 0"):
        ry.SplineMotion(komo, 5, 0)
