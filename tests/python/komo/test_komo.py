"""Motion problems: recorded numbers, mode switches, and independent checks of solutions."""

import numpy as np
import pytest

import kinegraph as ry
from conftest import recorded

FS, OT, SY, JT = ry.FS, ry.OT, ry.SY, ry.JT


def small_scene() -> ry.Config:
    C = ry.Config()
    C.addText(recorded("komo_modes")["scene"])
    C.addFrame("box").setPosition([0.3, 0.2, 0.63]).setQuaternion([0.9, 0.1, -0.2, 0.3]).setShape(
        ry.ST.ssBox, [0.12, 0.1, 0.16, 0.01]
    ).setMass(0.7)
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
    # the sign of a quaternion, and of its change, is arbitrary
    sign = np.where((abs(phi - phi_expected) > 1e-6) & (abs(phi + phi_expected) < 1e-6), -1.0, 1.0)
    np.testing.assert_allclose(phi, sign * phi_expected, atol=2e-5)
    shape = (len(phi), nlp.getDimension())
    np.testing.assert_allclose(dense(J, *shape), sign[:, None] * dense(expected["J"], *shape), atol=1e-5)


def panda_and_box(panda, size=0.06) -> ry.Config:
    panda.addFrame("box").setPosition([-0.3, 0.2, 0.65 + size / 2]).setShape(
        ry.ST.ssBox, [size, size, size, 0.005]
    ).setContact(1)
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


def solved(komo):
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert ret.feasible, ret.message
    return ret


def check_pick_and_place(C, komo, grasp, place, tolerance=1e-3):
    """The path itself, in plain configurations: no jump of the box, a grasp that stays, a box that stands at the
    goal."""
    path, poses = komo.getPath(), komo.getPathFrames()
    names = C.getFrameNames()
    box, gripper = names.index("box"), names.index("l_gripper")
    lower, upper = C.getJointLimits()
    check = ry.Config()
    check.addConfigurationCopy(C)
    start = poses[0, box] if grasp > 0 else C.getFrame("box").getPose()
    for t, q in enumerate(path):
        assert np.all(q >= lower - tolerance) and np.all(q <= upper + tolerance)
        check.setJointState(q)
        np.testing.assert_allclose(check.getFrame("l_gripper").getPosition(), poses[t, gripper, :3], atol=1e-9)
        if t < place:  # while it is held, the box does not move in the hand
            expected = start if t < grasp else None
            if expected is not None:
                np.testing.assert_allclose(poses[t, box], expected, atol=tolerance)
        check.getFrame("box").setPose(poses[t, box])
        assert check.getCollisionsTotalPenetration() < 2 * tolerance
    held = [hand_to_box(poses[t, gripper], poses[t, box]) for t in range(grasp, place + 1)]
    np.testing.assert_allclose(held, np.tile(held[0], (len(held), 1)), atol=5 * tolerance)
    np.testing.assert_allclose(held[0][:3], 0, atol=tolerance)
    np.testing.assert_allclose(poses[grasp, box, :3], C.getFrame("box").getPosition(), atol=tolerance)
    np.testing.assert_allclose(poses[place, box, :3], C.getFrame("goal").getPosition(), atol=tolerance)
    np.testing.assert_allclose(poses[-1, box], poses[place, box], atol=1e-9)


def hand_to_box(hand, box):
    """The box's position in the hand, and the (sign-free) products of their axes."""
    R, S = rotation(hand[3:]), rotation(box[3:])
    return np.concatenate([R.T @ (box[:3] - hand[:3]), (R.T @ S).ravel()])


def rotation(q):
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def test_waypoints_of_pick_and_place_are_solved_and_hold_in_plain_configurations(panda):
    C = panda_and_box(panda, 0.04)
    komo = pnp_waypoints(C)
    ret = solved(komo)
    assert ret.sos < 1.05 * 0.0549
    check_pick_and_place(C, komo, grasp=0, place=1)
    np.testing.assert_allclose(komo.getPath()[2], C.getJointState(), atol=1e-3)


def test_a_path_of_pick_and_place_is_solved_and_holds_in_plain_configurations(panda):
    C = panda_and_box(panda, 0.04)
    komo = pnp_path(C)
    ret = solved(komo)
    assert ret.sos < 1.1 * 0.5921
    check_pick_and_place(C, komo, grasp=15, place=31)
    names = C.getFrameNames()
    assert komo.getPathFrames()[23, names.index("box"), 2] > 0.9 - 1e-3


def test_a_box_too_large_for_the_hand_is_called_infeasible_with_its_penetration(panda):
    komo = pnp_waypoints(panda_and_box(panda, 0.06))
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert not ret.feasible
    assert ret.violation == pytest.approx(0.003, abs=2e-4)
    (sums,) = [c for c in komo.conflicts() if c["name"].startswith("accumulatedCollisions")]
    assert sums["suffices"]
    assert sums["by_meters"] == pytest.approx(0.00303, abs=2e-5)
    assert "panda_collCameraWrist and box overlap" in komo.explain()


def test_waypoints_start_a_path_with_the_same_switches(panda):
    C = panda_and_box(panda, 0.04)
    waypoints = pnp_waypoints(C)
    solved(waypoints)
    komo = ry.KOMO(C, 3, 8, 2, True)
    komo.addControlObjective([], 2, 1e-1)
    komo.addQuaternionNorms()
    add_pick_and_place(komo)
    cold = komo.report()["totals"]["eq"]
    for form in (
        waypoints.getPath_qAll(),
        [list(q) for q in waypoints.getPath_qAll()],
        tuple(waypoints.getPath_qAll()),
    ):
        assert list(komo.initWithWaypoints(form, 1, True)) == [7, 15, 23]
    np.testing.assert_allclose(komo.getPath()[[7, 15, 23]], waypoints.getPath(), atol=1e-12)
    assert komo.report()["totals"]["eq"] < 0.7 * cold
    solved(komo)


@pytest.mark.parametrize("form", [lambda q: [q], lambda q: np.array([q]), lambda q: [list(q)], lambda q: (q,)])
def test_waypoints_may_be_lists_or_arrays(panda, form):
    komo = ry.KOMO(panda, 1, 4, 1, False)
    q = panda.getJointState() + 0.1
    assert list(komo.initWithWaypoints(form(q))) == [3]
    np.testing.assert_allclose(komo.getPath()[3], q)


def test_a_sub_problem_keeps_what_is_held(panda):
    C = panda_and_box(panda, 0.04)
    komo = pnp_waypoints(C)
    solved(komo)
    held, start, end = komo.getSubProblem(1)
    np.testing.assert_allclose(start, komo.getPath()[0])
    np.testing.assert_allclose(end, komo.getPath()[1])
    assert held.getJointDimension() == 7
    assert held.getFrame("box").getParent().name == "l_gripper"
    held.setJointState(end)
    np.testing.assert_allclose(held.getFrame("box").getPosition(), C.getFrame("goal").getPosition(), atol=2e-3)
    with pytest.raises(ry.Error, match="one slice per phase"):
        pnp_path(C).getSubProblem(1)


def test_the_problem_outlives_the_variable_that_made_it(panda):
    def make():
        komo = ry.KOMO(panda, 1, 1, 0, False)
        komo.addObjective([], FS.jointState, [], OT.sos, [1e-1], panda.getJointState())
        return komo.nlp()

    assert ry.NLP_Solver(make(), verbose=0).solve().feasible


def test_reports_list_objectives_by_error(panda):
    komo = pnp_path(panda_and_box(panda))
    komo.nlp().evaluate(recorded("komo_problems")["cases"]["pnp_path"]["x"])
    report = komo.report(True)
    errors = [entry["err"] for key, entry in report.items() if key not in ("specs", "totals")]
    assert errors == sorted(errors) and len(errors) == 14
    assert report["specs"]["x_dim"] == 234 and report["specs"]["T"] == 32 and report["specs"]["tau"] == 1 / 16
    assert report["totals"]["eq"] == pytest.approx(506.9, abs=0.1)
    traces = komo.info_objectiveErrorTraces()
    assert traces.shape == (32, 14)
    names = komo.info_objectiveNames()
    assert names[:3] == ["F_qItself[#14]", "F_qItself/acc[#14]", "F_AccumulatedCollisions[#44]"]
    first = komo.info_sliceErrors(15, traces).splitlines()[0]
    assert first.startswith("t:15 #6F_Pose/vel[box] eq 131.97")
    assert "box" in komo.info_sliceCollisions(0, 0.5)


def test_what_is_not_available_says_so(panda):
    komo = ry.KOMO(panda, 1, 1, 1, False)
    with pytest.raises(ry.Error, match="addTimeOptimization is not available"):
        komo.addTimeOptimization()
    with pytest.raises(ry.Error, match="contact does not attach an object"):
        komo.addModeSwitch([1.0, -1.0], SY.contact, ["table", "l_gripper"])
    with pytest.raises(ry.FrameNotFound, match="zzz"):
        komo.getFrame("zzz", 1.0)
    with pytest.raises(ry.Error, match="slice"):
        komo.getFrame("table", 9.0)
    with pytest.warns(ry.KinegraphWarning, match="selects no slice"):
        komo.addObjective([3.0], FS.position, ["l_gripper"], OT.eq)
    with pytest.raises(TypeError):
        ry.KOMO(panda, 1, 1)


def test_a_bare_number_is_a_time(panda):
    komo = ry.KOMO(panda, 2, 5, 1, False)
    komo.addObjective(1.0, FS.position, ["l_gripper"], OT.eq)
    assert komo.report()["o0"]["slices"] == [4, 4]


def test_older_scripts_build_their_problems(panda):
    panda.addFrame("target").setPosition([0.3, 0.3, 1.0]).setShape(ry.ST.marker, [0.1])
    komo = panda.komo_IK()
    komo.addObjective(type=OT.eq, feature=FS.positionDiff, frames=["l_gripper", "target"], scale=[1e1])
    komo.optimize(0.01)
    assert komo.getConstraintViolations() < 1e-3
    C = komo.getConfiguration(0)
    np.testing.assert_allclose(C.getFrame("l_gripper").getPosition(), [0.3, 0.3, 1.0], atol=1e-3)

    komo = panda.komo_path(1.0, 10, 2.0)
    assert komo.getPathTau().tolist() == [0.2] * 10
    komo.addObjective(time=[1.0], feature=FS.positionDiff, frames=["l_gripper", "target"], type=OT.eq, scale=[1e1])
    komo.addObjective(time=[1.0], feature=FS.jointState, type=OT.eq, order=1)
    komo.optimize()
    assert komo.getConstraintViolations() < 1e-2
    assert komo.getPath_qOrg().shape == (10, 7) and komo.getReport()["totals"]["eq"] < 1e-2


def test_configuration_and_timing_come_in_either_order(panda):
    for first in (True, False):
        komo = ry.KOMO()
        if first:
            komo.setConfig(panda, False)
        komo.setTiming(2.0, 4, 5.0, 2)
        if not first:
            komo.setConfig(panda, False)
        komo.addControlObjective([], 2)
        assert komo.getT() == 8 and komo.getPathTau()[0] == 1.25


def test_the_initial_configuration_counts(panda):
    komo = ry.KOMO(panda, 1, 2, 1, False)
    panda.getFrame("table").setPosition([5.0, 0.0, 0.0])
    panda.setJointState(panda.getJointState() + 0.5)
    assert abs(komo.getConfiguration(-1).getFrame("table").getPosition()[0]) < 1
    panda.addFrame("later")
    assert komo.getConfig().getFrame("table") is not None
    assert "later" not in komo.getConfig().getFrameNames()


def test_a_mode_switch_without_velocities_follows_its_own_advice():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.addFrame("box", "table").setJoint(ry.JT.rigid).setShape(ry.ST.box, [0.06] * 3).setRelativePosition([0, 0.3, 0.08])
    komo = ry.KOMO(C, 2, 1, 0, False)
    with pytest.raises(ry.ArgumentError, match=r"firstSwitch=False and times \[1, -1\]"):
        komo.addModeSwitch([1.0, 2.0], ry.SY.stable, ["l_gripper", "box"])
    komo.addModeSwitch([1.0, -1.0], ry.SY.stable, ["l_gripper", "box"], firstSwitch=False)
    komo.addObjective([2.0], ry.FS.position, ["box"], ry.OT.eq, [10.0], [0.2, 0.3, 1.0])
    komo.addObjective([1.0], ry.FS.positionDiff, ["l_gripper", "box"], ry.OT.eq, [10.0])
    assert ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible
    with pytest.warns(ry.KinegraphWarning, match="selects no slice"):
        komo.addObjective([7.0], ry.FS.vectorZ, ["box"], ry.OT.eq, [1.0])
    names = komo.info_objectiveNames()
    assert len(names) == 3 and "box" in names[-1]  # those without slices, too


def test_more_slices_than_memory_holds_are_refused():
    with pytest.raises(ry.ArgumentError, match=r"1e\+09 phases of 1000 slices are more than 10000000"):
        ry.KOMO(ry.Config(), 1e9, 1000, 2, False)


def test_a_start_at_no_waypoints_is_a_mistake():
    C = ry.Config()
    C.addText("world: {}\nj (world): { joint: hingeX }")
    with pytest.raises(ry.ArgumentError, match="there are no waypoints"):
        ry.KOMO(C, 2, 1, 0, False).initWithWaypoints([])


def test_an_empty_komo_has_no_picture_and_says_so():
    for call in (lambda k: k._repr_html_(), lambda k: k.view_play()):
        with pytest.raises(ry.Error, match="a view needs a configuration and a timing; call setConfig"):
            call(ry.KOMO())
