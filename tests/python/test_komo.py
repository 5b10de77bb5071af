"""Motion problems: recorded numbers, mode switches, solutions that are checked without the problem that produced them."""

import warnings

import numpy as np
import pytest
from conftest import recorded

import kinegraph as ry

FS, OT, SY, JT = ry.FS, ry.OT, ry.SY, ry.JT


def small_scene() -> ry.Config:
    C = ry.Config()
    C.addText(recorded("komo_modes")["scene"])
    C.addFrame("box").setPosition([0.3, 0.2, 0.63]).setQuaternion([0.9, 0.1, -0.2, 0.3]).setShape(ry.ST.ssBox, [0.12, 0.1, 0.16, 0.01]).setMass(0.7)
    C.addFrame("handle", "box").setRelativePosition([0, 0, 0.1])
    return C


def small_problem(phases=3, slices=2, order=2) -> ry.KOMO:
    return ry.KOMO(small_scene(), phases, slices, order, False)


def switched(mode, times=(1.0, 2.0), frames=("grip", "box"), first=True, **grid) -> ry.KOMO:
    komo = small_problem(**grid)
    komo.addModeSwitch(list(times), mode, list(frames), first)
    komo.addQuaternionNorms()
    komo.addObjective([], FS.jointLimits, [], OT.ineq)
    return komo


def two_switches() -> ry.KOMO:
    komo = small_problem()
    komo.addModeSwitch([1.0, 2.0], SY.stable, ["grip", "box"], True)
    komo.addModeSwitch([2.0, -1.0], SY.stableOn, ["table", "box"], True)
    return komo


def grasp_frame(stable=True, rigid=True, **grid) -> ry.KOMO:
    komo = small_problem(**grid)
    komo.addFrameDof("grasp", "grip", JT.free, stable, "box")
    if rigid:
        komo.addRigidSwitch(1.0, ["grasp", "box"])
    komo.addQuaternionNorms()
    return komo


def controlled() -> ry.KOMO:
    komo = small_problem()
    komo.addModeSwitch([1.0, -1.0], SY.stable, ["grip", "box"], True)
    for order in (0, 1, 2):
        komo.addControlObjective([], order, 0.5)
    komo.addControlObjective([1.0, 2.0], 1, 0.5, [], 1, -1)
    return komo


ONE_SLICE = {"slices": 1, "order": 1}
ON_TABLE = {"frames": ("table", "box")}
SMALL = {
    "stable": lambda: switched(SY.stable),
    "stable_k1": lambda: switched(SY.stable, **ONE_SLICE),
    "stable_second": lambda: switched(SY.stable, first=False),
    "stable_t0": lambda: switched(SY.stable, times=(0.0, 1.0)),
    "stable_handle": lambda: switched(SY.stable, frames=("grip", "handle")),
    "stable_marker": lambda: switched(SY.stable, frames=("l1b", "handle")),
    "stableOn_k1": lambda: switched(SY.stableOn, **ON_TABLE, **ONE_SLICE),
    "stableOnX_k1": lambda: switched(SY.stableOnX, **ON_TABLE, **ONE_SLICE),
    "stableYPhi": lambda: switched(SY.stableYPhi),
    "stableZero": lambda: switched(SY.stableZero),
    "dynamic_k1": lambda: switched(SY.dynamic, **ONE_SLICE),
    "two_first": two_switches,
    "framedof_k2": grasp_frame,
    "framedof_nonstable": lambda: grasp_frame(stable=False, rigid=False, **ONE_SLICE),
    "control": controlled,
}


def dense(triplets, rows, columns):
    J = np.zeros((rows, columns))
    triplets = np.asarray(triplets, float).reshape(-1, 3)
    np.add.at(J, (triplets[:, 0].astype(int), triplets[:, 1].astype(int)), triplets[:, 2])
    return J


def type_names(nlp) -> list[str]:
    return [type.name for type in nlp.getTypes()]


@pytest.mark.parametrize("name", SMALL)
def test_problems_with_mode_switches_have_the_recorded_variables_residuals_and_jacobians(name):
    expected = recorded("komo_modes")["cases"][name]
    komo = SMALL[name]()
    nlp = komo.nlp()
    assert [len(q) for q in komo.getPath_qAll()] == expected["own"]
    assert komo.getFeatureNames() == expected["tags"]
    assert type_names(nlp) == expected["types"]
    np.testing.assert_allclose(nlp.getBounds(), expected["bounds"], atol=2e-5)
    phi, J = nlp.evaluate(expected["x"])
    phi_expected = np.array(expected["phi"])
    # the sign of a quaternion, and so of the change of one, carries no meaning
    sign = np.where((abs(phi - phi_expected) > 1e-6) & (abs(phi + phi_expected) < 1e-6), -1.0, 1.0)
    np.testing.assert_allclose(phi, sign * phi_expected, atol=2e-5)
    shape = (len(phi), nlp.getDimension())
    np.testing.assert_allclose(dense(J, *shape), sign[:, None] * dense(expected["J"], *shape), atol=1e-5)


def panda_and_box(panda, size=0.06) -> ry.Config:
    panda.addFrame("box").setPosition([-0.3, 0.2, 0.65 + size / 2]).setShape(ry.ST.ssBox, [size, size, size, 0.005]).setContact(1)
    panda.addFrame("goal").setPosition([0.3, 0.3, 0.65 + size / 2]).setShape(ry.ST.marker, [0.1])
    return panda


def add_pick_and_place(komo):
    komo.addModeSwitch([1.0, 2.0], SY.stable, ["l_gripper", "box"], True)
    komo.addObjective([1.0], FS.positionDiff, ["l_gripper", "box"], OT.eq, [1e1])
    komo.addObjective([1.0], FS.scalarProductXZ, ["l_gripper", "box"], OT.eq, [1e1])
    komo.addObjective([1.0], FS.scalarProductXX, ["l_gripper", "box"], OT.eq, [1e1])
    komo.addModeSwitch([2.0, -1.0], SY.stableOn, ["table", "box"], False)
    komo.addObjective([2.0], FS.positionDiff, ["box", "goal"], OT.eq, [[1e1, 0, 0], [0, 1e1, 0]])


def pnp_waypoints(C) -> ry.KOMO:
    komo = ry.KOMO(C, 3, 1, 1, True)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 1, 1e-1)
    komo.addObjective([], FS.accumulatedCollisions, [], OT.eq, [1e0])
    komo.addObjective([], FS.jointLimits, [], OT.ineq, [1e0])
    komo.addQuaternionNorms()
    komo.addObjective([3.0], FS.jointState, [], OT.eq, [1e0], C.getJointState())
    add_pick_and_place(komo)
    return komo


def pnp_path(C) -> ry.KOMO:
    komo = ry.KOMO(C, 2, 16, 2, True)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([], FS.accumulatedCollisions, [], OT.eq, [1e0])
    komo.addObjective([], FS.jointLimits, [], OT.ineq, [1e0])
    komo.addQuaternionNorms()
    komo.addObjective([2.0], FS.jointState, [], OT.eq, [1e0], [], 1)
    add_pick_and_place(komo)
    komo.addObjective([1.5], FS.position, ["box"], OT.ineq, [[0, 0, -1e1]], [0, 0, 0.9])
    return komo


def path_obstacle(C) -> ry.KOMO:
    C.addFrame("way").setPosition([0.4, 0.4, 0.9]).setShape(ry.ST.marker, [0.1])
    C.addFrame("obst").setPosition([0.2, 0.38, 0.95]).setShape(ry.ST.ssBox, [0.06, 0.06, 0.6, 0.005]).setContact(1)
    komo = ry.KOMO(C, 1, 32, 2, True)
    komo.addControlObjective([], 0, 1e-2)
    komo.addControlObjective([], 2, 1e-1)
    komo.addObjective([], FS.accumulatedCollisions, [], OT.eq, [1e0])
    komo.addObjective([], FS.jointLimits, [], OT.ineq, [1e0])
    komo.addObjective([1.0], FS.positionDiff, ["l_gripper", "way"], OT.eq, [1e1])
    komo.addObjective([1.0], FS.jointState, [], OT.eq, [1e0], [], 1)
    return komo


def ik_pose(C) -> ry.KOMO:
    C.addFrame("target").setPosition([0.3, 0.3, 1.0]).setQuaternion([0.0, 1.0, 0.3, 0.1]).setShape(ry.ST.marker, [0.1])
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], FS.jointState, [], OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], FS.positionDiff, ["l_gripper", "target"], OT.eq, [1e1])
    komo.addObjective([], FS.quaternionDiff, ["l_gripper", "target"], OT.eq, [1e1])
    return komo


def joint_limits(C) -> ry.KOMO:
    C.addFrame("target").setPosition([-0.6, 0.2, 1.0]).setShape(ry.ST.marker, [0.1])
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], FS.jointState, [], OT.sos, [1e-1], C.getJointLimits()[0] - 0.3)
    komo.addObjective([], FS.jointLimits, [], OT.ineq, [1e1])
    komo.addObjective([], FS.positionDiff, ["l_gripper", "target"], OT.eq, [1e1])
    komo.addObjective([], FS.vectorZ, ["l_gripper"], OT.sos, [1e0], [0, 0, 1])
    return komo


RECORDED = {
    "pnp_waypoints": lambda C: pnp_waypoints(panda_and_box(C)),
    "pnp_path": lambda C: pnp_path(panda_and_box(C)),
    "path_obstacle": path_obstacle,
    "ik_pose": ik_pose,
    "joint_limits": joint_limits,
}


@pytest.mark.parametrize("name", RECORDED)
def test_problems_of_the_panda_have_the_recorded_residuals(panda, name):
    expected = recorded("komo_problems")["cases"][name]
    nlp = RECORDED[name](panda).nlp()
    assert type_names(nlp) == expected["types"]
    np.testing.assert_allclose(nlp.getBounds(), expected["bounds"], atol=2e-5)
    phi, _ = nlp.evaluate(expected["x"])
    phi_expected = np.array(expected["phi"])
    sign = np.where((abs(phi - phi_expected) > 1e-6) & (abs(phi + phi_expected) < 1e-6), -1.0, 1.0)
    np.testing.assert_allclose(phi, sign * phi_expected, atol=2e-5)
