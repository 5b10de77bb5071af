"""Scenes as a person sets them up on the first day: planned from what stands where, or refused with the reason."""

import numpy as np
import pytest

import kinegraph as ry

TOP = 0.65  # m: height of the table


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def box(C, name, parent, position, size=(0.05, 0.05, 0.07)) -> ry.Frame:
    frame = C.addFrame(name, parent).setPosition([*position[:2], position[2] + 0.5 * size[2]])
    return frame.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1).setMass(0.1).setJoint(ry.JT.rigid)


def tray(C, size=(0.2, 0.2, 0.01)) -> ry.Frame:
    frame = C.addFrame("tray", "table").setPosition([-0.3, 0.3, TOP + 0.5 * size[2]])
    return frame.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1)


def executed(C, plan) -> ry.Config:
    """The simulated world 2 s after the execution of a plan."""
    assert plan.feasible, plan
    assert ry.checkTaskPlan(C, plan) == []
    bot = ry.BotOp(C)
    run = plan.execute(bot, repairs=0)
    assert run.feasible, run
    world = C.copy()
    bot.sync(world, 2.0)
    return world


def stands(world, name, place, top, radius) -> bool:
    """Whether an object rests on a place whose top has a height, within a radius around its center."""
    at, center = world.getFrame(name).getPosition(), world.getFrame(place).getPosition()
    upright = world.getFrame(name).getRotationMatrix()[2, 2] > 0.99
    return bool(upright and abs(at[2] - top) < 4e-3 and np.linalg.norm((at - center)[:2]) < radius)


def test_objects_hang_below_any_frame() -> None:
    C = scene()
    tray(C)
    box(C, "red", "world", (0.3, 0.3, TOP))
    plan = ry.planTask(C, "(on tray red)")
    assert plan.actions[0] == ["pick", "red", "table", "l_gripper"]
    assert stands(executed(C, plan), "red", "tray", TOP + 0.01 + 0.035, 0.1)


def test_an_object_is_where_it_stands_and_not_where_it_hangs() -> None:
    C = scene()
    tray(C)
    box(C, "red", "tray", (0.3, 0.3, TOP))  # below the tray in the tree, on the table in the world
    plan = ry.planTask(C, "(on tray red)")
    assert plan.actions[0] == ["pick", "red", "table", "l_gripper"]
    assert stands(executed(C, plan), "red", "tray", TOP + 0.01 + 0.035, 0.1)
    C = scene()
    tray(C)
    box(C, "red", "table", (-0.3, 0.3, TOP + 0.01))  # the reverse
    plan = ry.planTask(C, "(on tray red)")
    assert plan.feasible and plan.actions == [] and plan.warnings == ["the goal already holds"]


def test_an_object_under_another_waits_whatever_both_hang_below() -> None:
    C = scene()
    tray(C)
    box(C, "low", "table", (0.3, 0.3, TOP), (0.06, 0.06, 0.05))
    box(C, "up", "table", (0.3, 0.3, TOP + 0.05), (0.05, 0.05, 0.05))
    plan = ry.planTask(C, "(on tray low) (on low up)")
    assert plan.actions[0] == ["pick", "up", "low", "l_gripper"]
    world = executed(C, plan)
    assert stands(world, "low", "tray", TOP + 0.01 + 0.025, 0.1)
    assert stands(world, "up", "low", TOP + 0.06 + 0.025, 0.02)


def test_round_things_are_places() -> None:
    C = scene()
    plate = C.addFrame("plate", "table").setPosition([-0.3, 0.3, TOP + 0.005])
    plate.setShape(ry.ST.cylinder, [0.01, 0.1]).setContact(1)
    can = C.addFrame("can", "table").setPosition([0.0, 0.4, TOP + 0.05]).setJoint(ry.JT.rigid)
    can.setShape(ry.ST.cylinder, [0.1, 0.033]).setContact(1).setMass(0.2)
    box(C, "red", "table", (0.3, 0.3, TOP), (0.04, 0.04, 0.07))
    box(C, "blue", "table", (0.15, 0.2, TOP), (0.04, 0.04, 0.05))
    world = executed(C, ry.planTask(C, "(on plate red) (on can blue)"))
    assert stands(world, "red", "plate", TOP + 0.01 + 0.035, 0.08)
    assert stands(world, "blue", "can", TOP + 0.1 + 0.025, 0.015)


@pytest.mark.parametrize("low", [-0.04, 0.0, -0.02])
def test_meshes_are_put_down_on_their_lowest_point(low) -> None:
    C = scene()
    tray(C)
    corners = np.array([[x, y, z] for x in (-0.025, 0.025) for y in (-0.03, 0.03) for z in (low, low + 0.08)])
    mug = C.addFrame("mug", "table").setPosition([0.3, 0.3, TOP - low]).setJoint(ry.JT.rigid)
    mug.setConvexMesh(corners).setContact(1).setMass(0.1)
    world = executed(C, ry.planTask(C, "(on tray mug)"))
    assert stands(world, "mug", "tray", TOP + 0.01 - low, 0.1)


def test_an_object_with_a_foot_stands_on_it() -> None:
    C = scene()
    tray(C)
    box(C, "lamp", "table", (0.3, 0.3, TOP + 0.04), (0.04, 0.04, 0.07))
    foot = C.addFrame("foot", "lamp").setRelativePosition([0, 0, -0.055])
    foot.setShape(ry.ST.ssBox, [0.06, 0.06, 0.04, 0.004]).setContact(1).setMass(0.2)
    world = executed(C, ry.planTask(C, "(on tray lamp)"))
    assert stands(world, "lamp", "tray", TOP + 0.01 + 0.075, 0.1)


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
        (None, "(held red)", "no action makes (held red) true; a goal is (on place object), (on hand object)"),
        (None, "(opened tray)", "'tray' is no door or drawer"),
        (None, "(posed red tray)", "'tray' is no pose; label it with"),
        (
            lambda C: C.getFrame("red").setPosition([0.3, 0.3, 0.9]).setParent(C.getFrame("world"), True),
            "(on tray red)",
            "'red' stands on no place (it hangs below 'world'); put it on a place",
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
