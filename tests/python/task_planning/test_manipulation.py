"""KOMO_ManipulationHelper: the problems that it states, and that they are solved."""

import itertools
import json
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
import robotic

RECORDED = json.loads((Path(__file__).parent.parent.parent / "data" / "manipulation.json").read_text())["problems"]
OVERLAPS = ("F_PairCollision", "F_AccumulatedCollisions")  # the reference's depths of flat boxes are off
GRIPPER, PALM = "l_gripper", "l_palm"


def scene(kind="box"):
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    obj = C.addFrame("obj", "table").setRelativePosition([-0.25, 0.3, 0.13]).setJoint(ry.JT.rigid)
    if kind == "cylinder":
        obj.setShape(ry.ST.ssCylinder, [0.12, 0.025, 0.005])
    else:
        obj.setShape(ry.ST.ssBox, {"box": [0.06, 0.05, 0.12, 0.005], "flat": [0.12, 0.05, 0.06, 0.005]}[kind])
    obj.setContact(1)
    goal = C.addFrame("goal", "table").setRelativePosition([0.3, 0.3, 0.055])
    goal.setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]).setContact(0)
    wall = C.addFrame("obst", "table").setRelativePosition([0.0, 0.35, 0.2])
    wall.setShape(ry.ST.ssBox, [0.06, 0.3, 0.3, 0.005]).setContact(1)
    return C


def gantry():
    C = ry.Config()
    C.addFrame("world")
    table = C.addFrame("table", "world").setPosition([0.0, 0.0, 0.6])
    table.setShape(ry.ST.ssBox, [2.0, 2.0, 0.1, 0.02]).setContact(1)
    slide = C.addFrame("slide", "world").setPosition([0.0, 0.0, 1.2])
    slide.setJoint(ry.JT.trans3, [-1.0, -1.0, -0.6, 1.0, 1.0, 0.4])
    wrist = C.addFrame("wrist", "slide").setJoint(ry.JT.hingeZ, [-3.0, 3.0])
    wrist.setShape(ry.ST.ssBox, [0.08, 0.08, 0.1, 0.01]).setContact(1)
    hand = C.addFrame(GRIPPER, "wrist").setRelativePosition([0.0, 0.0, -0.12])
    hand.setShape(ry.ST.sphere, [0.02]).setContact(0)
    obj = C.addFrame("obj", "table").setRelativePosition([0.2, 0.25, 0.1])
    obj.setShape(ry.ST.ssBox, [0.12, 0.1, 0.1, 0.005]).setJoint(ry.JT.rigid).setContact(1)
    goal = C.addFrame("goal", "table").setRelativePosition([0.3, -0.3, 0.055])
    goal.setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]).setContact(0)
    return C


def helper():
    return robotic.KOMO_ManipulationHelper()


def ik_top(C, m):
    m.setup_inverse_kinematics(C)
    m.grasp_top_box(1.0, GRIPPER, "obj", "xz")


def ik_grasp_x(C, m):
    m.setup_inverse_kinematics(C)
    m.grasp_box(1.0, GRIPPER, "obj", PALM, "x")


def ik_grasp_y_nocoll(C, m):
    m.setup_inverse_kinematics(C, 1e-2, False)
    m.grasp_box(1.0, GRIPPER, "obj", PALM, "y", 0.01)
    m.no_collisions([], [PALM, "obst", "obj", "obst"], 0.01)


def ik_cylinder(C, m):
    m.setup_inverse_kinematics(C)
    m.grasp_cylinder(1.0, GRIPPER, "obj", PALM)


def pick_and_place(C, m, direction, grasp="x", collisions=False):
    m.setup_pick_and_place_waypoints(C, GRIPPER, "obj", 1e-2, 1e-1, collisions)
    m.grasp_box(1.0, GRIPPER, "obj", PALM, grasp)
    m.place_box(2.0, "obj", "goal", PALM, direction)


def pnp_z(C, m):
    pick_and_place(C, m, "z")
    m.target_relative_xy_position(2.0, "obj", "goal", [0.02, -0.03])


def pnp_xneg(C, m):
    pick_and_place(C, m, "xNeg", "y", True)
    m.target_x_orientation(1.0, GRIPPER, [1.0, 0.0, 0.0])


def pnp_freeze(C, m):
    pick_and_place(C, m, "z")
    m.freeze_joint([2.0], ["l_panda_joint7"])
    m.no_collisions([1.0, 2.0], ["obj", "obst"])


def push(C, m):
    C.getFrame("obj").setRelativePosition([-0.2, 0.25, 0.08])
    m.setup_sequence(C, 2, 1e-2, 1e-1, False)
    m.add_stable_frame(ry.JT.free, GRIPPER, "hold", initFrame="obj")
    m.snap_switch(1.0, "hold", "obj")
    m.straight_push([1.0, 2.0], "obj", GRIPPER, "table")
    m.target_relative_xy_position(2.0, "obj", "goal", [-0.3, 0.1])
    m.komo.addObjective([2.0], ry.FS.position, ["obj"], ry.OT.eq, [[0.0, 0.0, 10.0]], [0.0, 0.0, 0.68])


def motion_retract(C, m):
    m.setup_motion(C, 1, 16, 1e-2, 1e-1)
    m.grasp_top_box(1.0, GRIPPER, "obj", "xz")
    m.retract([0.0625, 0.25], GRIPPER)
    m.approach([0.75, 1.0], GRIPPER)


def motion_two(C, m):
    m.setup_motion(C, 2, 8, 1e-2, 1e-1, False)
    m.add_stable_frame(ry.JT.free, GRIPPER, "grasp", initFrame="obj")
    m.snap_switch(1.0, "grasp", "obj")
    m.grasp_box(1.0, GRIPPER, "obj", PALM, "x")
    m.place_box(2.0, "obj", "goal", PALM, "z")
    m.no_collisions([0.5, 2.0], ["obj", "obst"])


def push_gantry(C, m):
    m.setup_sequence(C, 2, 1e-2, 1e-1, False)
    m.add_stable_frame(ry.JT.free, GRIPPER, "hold", initFrame="obj")
    m.snap_switch(1.0, "hold", "obj")
    assert m.straight_push([1.0, 2.0], "obj", GRIPPER, "table") == "_straight_pushStart_l_gripper_obj_1.0"
    m.target_relative_xy_position(2.0, "obj", "goal", [0.05, 0.1])


def motion_carry(C, m):
    C.attach(GRIPPER, "obj")
    m.setup_motion(C, 1, 12, 1e-2, 1e-1, False)
    m.place_box(1.0, "obj", "goal", None, "z")
    m.no_collisions([0.3, 0.7], ["obj", "obst"], 0.02)
    m.freeze_relativePose([0.9, 1.0], "obj", "table")
    m.bias(0.5, np.array([0.0, -0.5, 0.0, -2.0, 0.0, 2.0, -0.5]), 0.1)


def pull_up(C, m):
    C.getFrame("obj").setRelativePosition([-0.2, 0.25, 0.08])
    m.setup_sequence(C, 2, 1e-2, 1e-1, False)
    m.add_stable_frame(ry.JT.free, GRIPPER, "hold", initFrame="obj")
    m.snap_switch(1.0, "hold", "obj")
    m.pull([1.0, 2.0], "obj", GRIPPER, "table")
    m.target_relative_xy_position(2.0, "obj", "table", [-0.1, 0.35])


def place_cylinder_down(C, m):
    m.setup_pick_and_place_waypoints(C, GRIPPER, "obj", 1e-2, 1e-1, False)
    m.grasp_cylinder(1.0, GRIPPER, "obj", PALM)
    m.place_box(2.0, "obj", "goal", None, "zNeg")


PROBLEMS = {
    f.__name__: f
    for f in (
        ik_top,
        ik_grasp_x,
        ik_grasp_y_nocoll,
        ik_cylinder,
        pnp_z,
        pnp_xneg,
        pnp_freeze,
        push,
        motion_retract,
        motion_two,
        push_gantry,
        motion_carry,
        pull_up,
        place_cylinder_down,
    )
}
KINDS = {
    "ik_grasp_y_nocoll": "flat",
    "ik_cylinder": "cylinder",
    "pnp_xneg": "flat",
    "push": "flat",
    "pull_up": "flat",
    "place_cylinder_down": "cylinder",
}


def build(name):
    C, m = gantry() if name == "push_gantry" else scene(KINDS.get(name, "box")), helper()
    PROBLEMS[name](C, m)
    return C, m


def runs(values):
    return [[value, len(list(run))] for value, run in itertools.groupby(values)]


def objectives(komo):
    """Returns the recorded fields of each, without its name and the number that it gives for all frames."""
    out = []
    for o in komo.report(False, True, False, False).values():
        if not isinstance(o, dict) or "name" not in o:
            continue
        frames = o["frames"] if o["frames"] and not o["frames"][0].startswith("#") else []
        out.append([frames, int(o["order"]), o["type"], [float(t) for t in o["times"]], [int(s) for s in o["slices"]]])
    return out


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_layout_is_that_of_the_reference(name):
    _, m = build(name)
    recorded, nlp = RECORDED[name], m.komo.nlp()
    assert nlp.getDimension() == recorded["dim"]
    assert runs(str(t).split(".")[-1] for t in nlp.getTypes()) == recorded["types"]
    expected = [
        [o[1] if o[1] and not o[1][0].startswith("#") else [], o[2], o[3], o[6], o[7]] for o in recorded["objectives"]
    ]
    for o, e in zip(objectives(m.komo), expected, strict=True):
        # If a hand closes, the reference lists accelerations one slice before the slice in which it measures them.
        assert o[:3] == e[:3] and (o[3:] == e[3:] or (o[1] == 2 and o[4] == [s + 1 for s in e[4]]))
    assert runs(n.replace("AlignYWith", "AlignWith").split("[")[0] for n in m.komo.getFeatureNames()) == runs(
        f[0].split("[")[0] for f in recorded["features"] for _ in range(f[1])
    )


@pytest.mark.parametrize("name", PROBLEMS)
def test_values_and_derivatives_are_those_of_the_reference(name):
    _, m = build(name)
    recorded, nlp = RECORDED[name], m.komo.nlp()
    phi, J = nlp.evaluate(np.array(recorded["x"]))
    expected = np.array(recorded["phi"])
    tags = np.repeat([f[0] for f in recorded["features"]], [f[1] for f in recorded["features"]])
    assert len(phi) == recorded["phi_dim"]
    Jv = np.zeros(len(phi))
    np.add.at(Jv, J[:, 0].astype(int), J[:, 2] * np.array(recorded["v"])[J[:, 1].astype(int)])
    # The sign of a quaternion carries no meaning. Short motions soften their direction differently.
    sign = np.where([t.startswith("F_QuaternionDiff") for t in tags] & (np.sign(phi) != np.sign(expected)), -1.0, 1.0)
    loose = np.array([t.startswith("F_AlignWith") for t in tags])
    compared = ~np.array([t.startswith(OVERLAPS) for t in tags])
    error, error_v = abs(phi - sign * expected), abs(Jv - sign * np.array(recorded["Jv"]))
    sizes, sizes_v = 1.0 + 2.0 * abs(expected), 1.0 + abs(np.array(recorded["Jv"]))  # x and v have 8 digits
    assert (error / sizes)[compared & ~loose].max() < 2e-6 and (error_v / sizes_v)[compared & ~loose].max() < 1e-5
    assert not loose.any() or (error[loose].max() < 5e-3 and (error_v / sizes_v)[loose].max() < 0.03)


def test_a_box_is_picked_and_placed_and_moved_between() -> None:
    C, m = scene(), robotic.KOMO_ManipulationHelper("pick and place")
    pick_and_place(C, m, "z")
    m.solve(verbose=0)
    assert m.feasible and m.path.shape == (2, 7)
    assert m.komo.getFrame("obj", 2.0).getPosition()[2] == pytest.approx(
        C.getFrame("goal").getPosition()[2] + 0.065, abs=2e-3
    )
    motion = m.sub_motion(0)
    motion.no_collisions([], ["l_palm", "obst"])
    motion.solve(verbose=0)
    assert motion.feasible and "sub_motion 0" in motion.info
    np.testing.assert_allclose(motion.path[-1], m.path[0], atol=1e-2)


@pytest.mark.parametrize("package", [ry, robotic])
def test_a_derived_helper_has_its_methods_in_motions_too(package) -> None:
    class Helper(package.KOMO_ManipulationHelper):
        def __init__(self) -> None:
            super().__init__()
            self.obstacle = "obst"

        def keep_off(self) -> None:
            self.no_collisions([], ["l_palm", self.obstacle])

    C, m = scene(), Helper()
    pick_and_place(C, m, "z")
    m.solve(verbose=0)
    motion = m.sub_motion(0)
    before = len(motion.komo.getFeatureNames())
    motion.keep_off()
    assert motion.info == "sub_motion 0" and len(motion.komo.getFeatureNames()) > before


@pytest.mark.parametrize("direction", ["xz", "yz", "yx", "zx"])  # the Panda reaches these from its place
def test_a_box_is_grasped_along_its_axes(direction) -> None:
    C, m = scene(), ry.KOMO_ManipulationHelper()
    C.getFrame("obj").setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.005]).setPosition([-0.25, 0.1, 1.0])
    m.setup_inverse_kinematics(C, accumulated_collisions=False)
    m.grasp_top_box(1.0, GRIPPER, "obj", direction)
    assert m.solve(verbose=0).feasible, direction
    C.setJointState(m.path[0])
    gripper, obj = (C.getFrame(n).getRotationMatrix() for n in (GRIPPER, "obj"))
    fingers, hand = "xyz".index(direction[0]), "xyz".index(direction[1])
    assert abs(gripper[:, 0] @ obj[:, fingers]) == pytest.approx(1.0, abs=1e-3)
    assert abs(gripper[:, 2] @ obj[:, hand]) == pytest.approx(1.0, abs=1e-3)


def test_a_hand_approaches_straight_to_where_its_path_ends() -> None:
    C, target = scene(), ry.KOMO_ManipulationHelper()
    target.setup_inverse_kinematics(C)
    target.grasp_box(1.0, GRIPPER, "obj", PALM, "x")
    target.solve(verbose=0)
    m = ry.KOMO_ManipulationHelper()
    m.setup_point_to_point_motion(C, target.path[0], accumulated_collisions=False)
    m.retract([0.02, 0.2], GRIPPER)
    m.approach([0.8, 1.0], GRIPPER, 0.05)
    assert m.solve(verbose=0).feasible
    C.setJointState(m.path[-1])
    end, R = C.getFrame(GRIPPER).getPosition(), C.getFrame(GRIPPER).getRotationMatrix()
    C.setJointState(m.path[39])
    before = R.T @ (C.getFrame(GRIPPER).getPosition() - end)
    assert before[2] >= 0.049 and abs(before[0]) < 2e-3


def test_waypoints_of_a_pull_slide_an_object_over_the_table() -> None:
    C, m = scene("flat"), ry.KOMO_ManipulationHelper()
    C.getFrame("obj").setRelativePosition([-0.2, 0.25, 0.08])
    m.setup_sequence(C, 2, accumulated_collisions=False)
    m.add_stable_frame(ry.JT.free, GRIPPER, "hold", initFrame="obj")
    m.snap_switch(1.0, "hold", "obj")
    m.pull([1.0, 2.0], "obj", GRIPPER, "table")
    m.target_relative_xy_position(2.0, "obj", "table", [-0.1, 0.35])
    assert m.solve(verbose=0).feasible
    there = m.komo.getFrame("obj", 2.0)
    np.testing.assert_allclose(there.getPosition()[2], C.getFrame("obj").getPosition()[2], atol=2e-3)
    np.testing.assert_allclose(there.getRotationMatrix()[:, 2], [0, 0, 1], atol=1e-2)


def test_frames_are_given_by_name_or_as_frames() -> None:
    C, by_name, by_frame = scene(), helper(), helper()
    pick_and_place(C, by_name, "z")
    gripper, obj, palm, goal = (C.getFrame(name) for name in (GRIPPER, "obj", PALM, "goal"))
    by_frame.setup_pick_and_place_waypoints(C, gripper, obj, 1e-2, 1e-1, False)
    by_frame.grasp_box(1.0, gripper, obj, palm, "x")
    by_frame.place_box(2.0, obj, goal, palm, "z")
    for m, pair in ((by_name, ["obj", "obst"]), (by_frame, [obj, C.getFrame("obst")])):
        m.no_collisions([1.0, 2.0], pair)
        m.freeze_joint([2.0], ["l_panda_joint7"] if m is by_name else [C.getFrame("l_panda_joint7")])
        m.target_relative_xy_position(2.0, pair[0], "goal" if m is by_name else goal, [0.02, 0.0])
    assert objectives(by_name.komo) == objectives(by_frame.komo)
    x = by_name.x
    values = [m.komo.nlp().evaluate(x)[0] for m in (by_name, by_frame)]
    np.testing.assert_allclose(*values, atol=1e-12)
    with pytest.raises(TypeError, match="obj is 3"):
        by_name.grasp_box(1.0, GRIPPER, 3, PALM)


@pytest.mark.parametrize("direction", ["z", "zNeg", "x"])
def test_a_cylinder_is_placed_without_a_palm(direction: str) -> None:
    C, m = scene("cylinder"), helper()
    held = C.addFrame("held", "table").setShape(ry.ST.ssCylinder, [0.12, 0.025, 0.005])
    held.setJoint(ry.JT.free).setRelativeQuaternion(
        [0.2, 0.9, 0.3, 0.1] if direction == "zNeg" else [0.8, 0.5, 0.2, 0.1]
    )
    m.setup_inverse_kinematics(C, accumulated_collisions=False)
    m.place_box(1.0, "held", "goal", None, direction)
    assert m.solve(verbose=0).feasible
    C.setJointState(m.path[0])
    R, height = C.getFrame("held").getRotationMatrix(), C.eval(ry.FS.positionDiff, ["held", "goal"])[0][2]
    up = R[2, "xyz".index(direction[0])]
    assert up == pytest.approx(-1.0 if "Neg" in direction else 1.0, abs=5e-3)
    assert height == pytest.approx(0.005 + (0.025 if direction == "x" else 0.06), abs=2e-3)


def test_a_second_push_from_the_same_time_shares_the_line() -> None:
    C, m = gantry(), helper()
    m.setup_sequence(C, 2, accumulated_collisions=False)
    lines = [m.straight_push([1.0, 2.0], "obj", GRIPPER, "table") for _ in range(2)]
    assert lines[0] == lines[1] and m.komo.getConfig().getFrame(lines[0]).getParent().name == "obj"
    m.pull([1.0, 2.0], "obj", GRIPPER, "table")
    m.pull([1.0, 2.0], "obj", GRIPPER, "table")
    names = m.komo.getConfig().getFrameNames()
    assert "_pull_end" in names and "_pull_end_l_gripper_obj_2.0" in names


def test_the_problem_of_a_helper_can_be_set_up_by_hand() -> None:
    C, m = scene(), robotic.KOMO_ManipulationHelper(info="by hand")
    assert m.info == "by hand"
    m.komo.setConfig(C, False)
    m.komo.setTiming(1.0, 1, 1.0, 0)
    m.komo.addControlObjective([], 0, 1e-1)
    m.grasp_top_box(1.0, GRIPPER, "obj", "xz")
    assert m.solve(verbose=0).feasible and m.path.shape == (1, 7)


def test_mistakes_are_reported() -> None:
    C, m = scene(), ry.KOMO_ManipulationHelper()
    with pytest.raises(ry.Error, match="grasp_box: there is no problem yet; call one of the setups"):
        m.grasp_box(1.0, GRIPPER, "obj", PALM)
    with pytest.raises(ry.Error, match="solve: there is no problem yet"):
        m.solve()
    m.setup_inverse_kinematics(C)
    with pytest.raises(ry.ArgumentError, match="grasp_direction is 'w'; expected x, y or z"):
        m.grasp_box(1.0, GRIPPER, "obj", PALM, "w")
    with pytest.raises(ry.ArgumentError, match="expected one of xz, yz"):
        m.grasp_top_box(1.0, GRIPPER, "obj", "xx")
    with pytest.raises(ry.ArgumentError, match="frame 'l_gripper' has no box"):
        m.grasp_box(1.0, GRIPPER, GRIPPER, PALM)
    with pytest.raises(ry.FrameNotFound, match="obj"):
        m.grasp_box(1.0, GRIPPER, "obi", PALM)
    with pytest.raises(ry.ArgumentError, match="position has 1 numbers"):
        m.target_relative_xy_position(1.0, "obj", "goal", [1.0])
    with pytest.raises(ry.ArgumentError, match="pairs, got 3"):
        m.no_collisions([], ["obj", "goal", "table"])
    position = [0.1, 0.2]
    m.target_relative_xy_position(1.0, "obj", "goal", position)
    assert position == [0.1, 0.2]  # nothing is appended to the user's list


def test_scripts_import_it_as_they_do() -> None:
    from robotic import manipulation
    from robotic import ry as inner

    assert robotic.KOMO_ManipulationHelper is manipulation.KOMO_ManipulationHelper is inner.ManipulationModelling
    assert manipulation.ManipulationModelling is robotic.KOMO_ManipulationHelper
    assert issubclass(robotic.KOMO_ManipulationHelper, ry.KOMO_ManipulationHelper)
    assert ry.ManipulationModelling is ry.KOMO_ManipulationHelper


def test_results_speak_the_rule_of_the_package() -> None:
    C, m = scene(), robotic.KOMO_ManipulationHelper()
    m.setup_inverse_kinematics(C)
    assert isinstance(m.solve(verbose=0), robotic.SolverReturn)
    m.debug(listObjectives=True)
