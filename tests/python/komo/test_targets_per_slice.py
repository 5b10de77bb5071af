"""Objectives with a target of their own in each slice."""

import numpy as np
import pytest

import kinegraph as ry

FS, OT = ry.FS, ry.OT


def test_an_objective_may_have_a_target_per_slice():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    start = C.getFrame("l_gripper").getPosition()
    points = start + np.linspace(0, 1, 10)[:, None] * [0.1, 0.2, -0.1]
    komo = ry.KOMO(C, 1, 10, 2, False)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjectivePerSlice([], FS.position, ["l_gripper"], OT.eq, points, scale=10)
    assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible
    found = C.evalBatch(FS.position, ["l_gripper"], komo.getPath())[0]
    np.testing.assert_allclose(found, points, atol=1e-4)
    one_by_one = ry.KOMO(C, 1, 10, 2, False)
    one_by_one.addControlObjective([], 2, 1e-1)
    for k, point in enumerate(points):
        one_by_one.addObjective([(k + 1) / 10], FS.position, ["l_gripper"], OT.eq, [10], point)
    x = komo.getPath().ravel()
    for nlp in (komo.nlp(), one_by_one.nlp()):
        assert np.abs(nlp.evaluate(x)[0] - komo.nlp().evaluate(x)[0]).max() == 0
    with pytest.raises(ry.ArgumentError, match="targets have 10 rows; expected 5, one per slice"):
        komo.addObjectivePerSlice([0.6, 1.0], FS.position, ["l_gripper"], OT.eq, points)
