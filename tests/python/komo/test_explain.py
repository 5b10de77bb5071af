"""Explanations of problems without a solution."""

import numpy as np
import pytest

import kinegraph as ry


def ik(C: ry.Config, *objectives) -> ry.KOMO:
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [0.1], C.getJointState())
    for feature, frames, kind, scale, *target in objectives:
        komo.addObjective([], feature, frames, kind, scale, *target)
    return komo


def far_target(C: ry.Config) -> ry.Config:
    C.addFrame("target").setShape(ry.ST.marker, [0.1]).setPosition([3.0, 0.0, 1.0])
    return C


def best(conflicts: list[dict]) -> dict:
    return next(conflict for conflict in conflicts if conflict["best"])


def test_a_target_out_of_reach_is_named_with_the_distance_in_meters(panda):
    C = far_target(panda)
    komo = ik(C, (ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0]))
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert ret.status.name == "infeasible"
    path = komo.getPath()
    C.setJointState(path[0])
    missed = np.linalg.norm(C.eval(ry.FS.positionDiff, ["l_gripper", "target"])[0])
    conflicts = ret.conflicts()
    target = conflicts[0]
    assert target["name"] == "positionDiff of l_gripper, target"
    assert target["frames"] == ["l_gripper", "target"]
    assert target["slices"] == [0]
    assert target["type"] == "eq"
    assert target["meters"] == pytest.approx(missed, rel=0.05), "not the scaled residual"
    assert target["radians"] is None
    assert best(conflicts) is target
    assert target["suffices"]
    assert target["by_meters"] == pytest.approx(target["meters"], rel=1e-3)
    text = ret.explain()
    assert "positionDiff of l_gripper, target in slice 0 (eq) is violated by 2." in text
    assert "is relaxed by 2." in text
    np.testing.assert_allclose(komo.getPath(), path)


def test_the_same_amount_is_said_whatever_the_scale(panda):
    C = far_target(panda)
    amounts = []
    for scale in (1.0, 10.0, 100.0):
        komo = ik(C, (ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [scale]))
        amounts.append(komo.conflicts()[0]["meters"])
    np.testing.assert_allclose(amounts, amounts[0], rtol=1e-3)


def test_an_active_joint_limit_is_named_in_radians(panda):
    q, joint = panda.getJointState(), panda.getJointNames()[3]
    q[3] = 0.5  # its upper limit is -0.07
    komo = ik(panda, (ry.FS.jointState, [], ry.OT.eq, [1.0], q))
    conflicts = komo.conflicts()
    assert [c["name"] for c in conflicts] == ["qItself", f"upper limit of joint of {joint}"]
    wanted, limit = conflicts
    upper = panda.getJointLimits()[1][3]
    assert wanted["radians"] == pytest.approx(0.5 - upper, abs=1e-3)
    assert limit["type"] == "bound"
    assert limit["frames"] == [joint]
    assert limit["suffices"]
    assert limit["by_radians"] == pytest.approx(0.5 - upper, abs=1e-2)
    assert "is active at" in komo.explain()


def test_shapes_that_overlap_are_named_in_millimeters(panda):
    panda.addFrame("wall").setShape(ry.ST.ssBox, [0.3, 0.3, 0.3, 0.01]).setContact(1)
    panda.frame("wall").setPosition([0.3, 0.3, 1.1])
    panda.addFrame("target").setShape(ry.ST.marker, [0.1]).setPosition([0.3, 0.3, 1.1])
    komo = ik(
        panda,
        (ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0]),
        (ry.FS.accumulatedCollisions, [], ry.OT.eq, [1.0]),
    )
    conflicts = komo.conflicts()
    names = {c["name"]: c for c in conflicts}
    assert {"accumulatedCollisions", "positionDiff of l_gripper, target"} <= set(names)
    hit = names["accumulatedCollisions"]
    assert hit["meters"] > 0.005
    assert any("wall" in detail and "mm" in detail for detail in hit["details"])
    assert "wall" in komo.explain()
    assert best(conflicts)["name"] == "positionDiff of l_gripper, target", "giving it up lets the hand leave the wall"


def test_an_orientation_is_missed_by_an_angle(panda):
    # one axis of the hand cannot point up and along the world's x
    komo = ik(
        panda,
        (ry.FS.vectorZ, ["l_gripper"], ry.OT.eq, [1.0], [0.0, 0.0, 1.0]),
        (ry.FS.vectorZ, ["l_gripper"], ry.OT.eq, [1.0], [1.0, 0.0, 0.0]),
    )
    conflicts = [c for c in komo.conflicts() if c["type"] == "eq"]
    assert len(conflicts) == 2
    for conflict in conflicts:
        assert conflict["radians"] == pytest.approx(np.pi / 4, abs=0.05), "half way between"
        assert conflict["suffices"]
        assert conflict["by_radians"] == pytest.approx(np.pi / 2, abs=0.05)


def test_slices_of_a_path_are_reported(panda):
    komo = ry.KOMO(panda, 1, 8, 2, False)
    komo.addControlObjective([], 2, 1e-1)
    q = panda.getJointState()
    komo.addObjective([0.5, 1.0], ry.FS.jointState, [], ry.OT.eq, [1.0], q)
    komo.addObjective([0.5, 0.8], ry.FS.jointState, [], ry.OT.eq, [1.0], q + 0.1)
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    conflicts = ret.conflicts()
    assert conflicts[0]["slices"] == [3, 4, 5]
    assert conflicts[0]["radians"] == pytest.approx(0.05, abs=1e-3)
    assert "in 3 slices, 3 to 5" in ret.explain()


def test_a_path_that_is_not_solved_yet_differs_from_a_contradiction(panda):
    panda.addFrame("target").setPosition([0.3, 0.3, 1.2])
    komo = ik(panda, (ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [10.0]))
    assert "solve (again)" in komo.explain()
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert komo.explain().startswith("All constraints hold")
    assert ret.conflicts() == []


def test_a_result_of_nothing_has_nothing_to_explain():
    with pytest.raises(ry.Error, match="nothing was solved"):
        ry.SolverReturn().explain()
