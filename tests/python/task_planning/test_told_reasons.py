"""Messages of planTask about scenes and calls that cannot be planned, and about grippers that are not as expected."""

import numpy as np
import pytest

import kinegraph as ry
from executed_plans import executed
from first_day import TOP, box, crane, scene, tray


def narrow(C) -> None:
    C.getFrame("tray").setShape(ry.ST.ssBox, [0.03, 0.03, 0.01, 0.004])


def tilted(C) -> None:
    C.getFrame("tray").setQuaternion([0.9962, 0.0872, 0, 0])


def without_shape(C) -> None:
    C.delFrame("tray")
    C.addFrame("tray", "table")
    C.addFrame("floor", "tray").setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004])


def a_mesh(C) -> None:
    C.getFrame("tray").setConvexMesh([[x, y, z] for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (-0.01, 0.01)])


def no_hand(C) -> None:
    C.getFrame("l_gripper").setAttributes({"logical": {}})
    C.getFrame("l_gripper").name = "l_tool"


@pytest.mark.parametrize(
    ("change", "goal", "reason"),
    [
        (narrow, "(on tray red)", "'tray' is no place: it is 0.030 m wide, and a place has 0.050 m or more"),
        (tilted, "(on tray red)", "'tray' is no place: it is tilted"),
        (without_shape, "(on tray red)", "'tray' is no place: it has no shape; places below it are floor"),
        (a_mesh, "(on tray red)", "'tray' is no place: it is neither a box nor a cylinder"),
        (None, "(on l_panda_joint7 red)", "'l_panda_joint7' is no place: it is neither a box nor a cylinder"),
        (None, "(on red red)", "'red' cannot stand on itself"),
        (None, "(on table tray)", "'tray' is no object: it has no rigid joint"),
        (None, "(on red tray)", "'tray' is no object: it has no rigid joint"),
        (None, "(on red tray)", "did you mean (on tray red)? The place comes first"),
        (None, "(held red)", "no action makes (held red) true; a goal is (on place object), (on hand object)"),
        (None, "(opened tray)", "'tray' is no door or drawer"),
        (None, "(posed red tray)", "'tray' is no pose; label it with"),
        (
            lambda C: C.getFrame("red").setPosition([0.3, 0.3, 0.9]).setParent(C.getFrame("world"), True),
            "(on tray red)",
            "'red' stands on no place (it hangs below 'world'); put it on a place",
        ),
        (
            lambda C: C.getFrame("tray").setAttributes({"logical": {"is_place": True}}),
            "(on tray red)",
            "'red' cannot be picked up where it stands: 'table' is no place: only frames with the label is_place are",
        ),
        (
            lambda C: C.getFrame("red").setPosition([1.1, 1.1, 0.685]),
            "(on tray red)",
            "beyond the reach of 'l_gripper'",
        ),
    ],
)
def test_the_reason_is_said_for_a_goal_that_nothing_reaches(change, goal, reason) -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP))
    if change:
        change(C)
    plan = ry.planTask(C, goal)
    assert plan.status == ry.TaskStatus.infeasible
    assert reason in plan.message and "can never fire" not in plan.message


def test_a_scene_without_a_gripper_is_told_so() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/panda_noGripper.g"))
    C.addFrame("table").setPosition([0.5, 0, -0.05]).setShape(ry.ST.ssBox, [1.2, 1.2, 0.1, 0.01]).setContact(1)
    box(C, "red", "table", (0.5, 0.25, 0.0))
    plan = ry.planTask(C, "(on table red)")
    assert plan.actions == [] and plan.feasible
    box(C, "blue", "table", (0.5, -0.25, 0.0))
    plan = ry.planTask(C, "(on blue red)")
    assert plan.status == ry.TaskStatus.infeasible and plan.message.startswith("no frame is a gripper; give the point")


def test_an_empty_goal_is_refused() -> None:
    with pytest.raises(ValueError, match=r"planTask: the goal is empty; expected literals such as \(on tray cup\)"):
        ry.planTask(scene(), " ")


@pytest.mark.parametrize("size", [(0.09, 0.09, 0.07), (0.2, 0.2, 0.02)])
def test_a_slab_that_is_wider_than_the_hand_is_told_so(size) -> None:
    C = scene()
    tray(C, (0.3, 0.3, 0.01))
    box(C, "slab", "table", (0.3, 0.3, TOP), size)
    plan = ry.planTask(C, "(on tray slab)")
    assert not plan.feasible
    assert "'slab' is wider than 'l_gripper' opens (0.080 m) along its level axes" in plan.message


def test_what_occupies_a_place_and_cannot_be_moved_is_named() -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP))
    box(C, "big", "tray", (-0.3, 0.3, TOP + 0.01), (0.2, 0.2, 0.2))
    plan = ry.planTask(C, "(on tray red)", max_evaluations=20000)
    assert not plan.feasible
    assert "while (on tray big)" in plan.message
    assert "'big' is wider than 'l_gripper' opens (0.080 m) along all of its axes" in plan.message


def test_robots_that_overlap_at_the_start_are_told_so_at_once() -> None:
    C = ry.Config()
    for name, x, turn in (("a_", -0.5, 0.0), ("b_", 0.5, np.pi)):  # their hands meet
        C.addFile(ry.raiPath("panda/panda.g"), name)
        base = C.getFrame(f"{name}panda_base").setPosition([x, 0, 0])
        base.setQuaternion([np.cos(turn / 2), 0, 0, np.sin(turn / 2)])
    C.addFrame("floor").setPosition([0, 0, -0.051]).setShape(ry.ST.ssBox, [3, 3, 0.1, 0.01]).setContact(1)
    box(C, "red", "floor", (-0.3, 0.45, -0.001))
    C.addFrame("tray", "floor").setPosition([-0.6, 0.5, 0.004]).setShape(ry.ST.ssBox, [0.15, 0.15, 0.01, 0.004])
    plan = ry.planTask(C, "(on tray red)")
    assert plan.status == ry.TaskStatus.infeasible and plan.evaluations == 0
    assert plan.message.startswith("the start collides: ") and "'a_palm' and 'b_palm' overlap by" in plan.message


def test_what_is_out_of_reach_of_a_robot_on_a_root_with_a_pose_is_told() -> None:
    C = crane(1)
    C.getFrame("tray").setPosition([1.5, 0.3, 0.605])
    plan = ry.planTask(C, "(on tray box)")
    assert plan.status == ry.TaskStatus.infeasible and "beyond the reach of 'gripper'" in plan.message


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"time_limit": np.nan}, "time_limit is nan s; expected a number >= 0"),
        ({"time_limit": -1.0}, "time_limit is -1 s"),
        ({"velocity": -1.0}, "velocity is -1; expected positive numbers"),
        ({"acceleration": [1.0] * 6 + [np.nan]}, "acceleration is nan"),
    ],
)
def test_wrong_options_are_refused_where_the_goal_holds(options: dict, message: str) -> None:
    C = scene()
    tray(C)
    box(C, "red", "tray", (-0.3, 0.3, TOP + 0.01))
    with pytest.raises(ry.ArgumentError, match=message):
        ry.planTask(C, "(on tray red)", **options)


@pytest.mark.parametrize(("turn", "rotation"), [(90, "d(90 0 0 1)"), (45, "d(45 0 0 -1)"), (-60, "d(60 0 0 1)")])
def test_a_gripper_whose_x_axis_is_not_that_of_its_fingers_is_told(turn: float, rotation: str) -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP))
    gripper = C.getFrame("l_gripper")
    (w, x, y, z), angle = gripper.getRelativeQuaternion(), np.radians(turn)
    c, s = np.cos(angle / 2), np.sin(angle / 2)
    gripper.setRelativeQuaternion([w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s])
    plan = ry.planTask(C, "(on tray red)", time_limit=20)
    assert "the x axis of 'l_gripper' is not the direction of its fingers" in plan.warnings[0]
    assert f"append {rotation} to its Q" in plan.warnings[0]
    assert plan.feasible or "is not the direction of its fingers" in plan.message


def test_a_gripper_whose_z_axis_points_out_of_the_hand_is_told() -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP), (0.05, 0.05, 0.02))
    gripper = C.getFrame("l_gripper")
    w, x, y, z = gripper.getRelativeQuaternion()
    gripper.setRelativeQuaternion([-x, w, z, -y])  # half a turn about its x axis
    plan = ry.planTask(C, "(on tray red)", time_limit=20)
    told = "the z axis of 'l_gripper' does not point from the fingers back into the hand"
    assert told in plan.warnings[0] and "append d(180 1 0 0) to its Q" in plan.warnings[0]


def test_an_object_that_does_not_collide_is_told() -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP)).setContact(0)
    plan = ry.planTask(C, "(on tray red)")
    assert plan.feasible and "'red' does not collide, because its contact is 0" in plan.warnings[0]


def test_a_gripper_inside_of_the_palm_is_told() -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP))
    C.getFrame("l_gripper").setPosition(C.getFrame("l_palm").getPosition())
    plan = ry.planTask(C, "(on tray red)", time_limit=5)
    told = " ".join([plan.message, *plan.warnings])
    assert "'l_gripper' lies 70 mm inside 'l_palm'; its place is between the fingertips" in told
    if plan.feasible:  # fingers that reach beyond the frame hold the box all the same
        executed(C, plan)


@pytest.mark.parametrize("file", ["pandaSingle.g", "pandasTable.g", "panda_fixRobotiq.g", "panda_fixGripper.g"])
def test_nothing_is_said_of_the_grippers_of_the_package(file: str) -> None:
    C = ry.Config()
    C.addFile(ry.raiPath(f"scenarios/{file}"))
    C.addFrame("floor").setPosition([0, 0, -3]).setShape(ry.ST.ssBox, [1, 1, 0.1, 0.01]).setContact(1)
    box(C, "red", "floor", (0.3, 0.3, -2.95))
    C.addFrame("place", "floor").setPosition([-0.3, 0, -2.94]).setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.004])
    plan = ry.planTask(C, "(on place red)", time_limit=0.5)
    assert not plan.feasible  # far below the arms
    assert not any("gripper" in warning for warning in plan.warnings)
