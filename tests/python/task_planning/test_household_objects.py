"""Household objects: bodies of several shapes are held by their parts, and low ones by the tips of the fingers."""

import numpy as np
import pytest

import kinegraph as ry
from executed_plans import executed

TOP = 0.65  # m: height of the table
LYING = [np.sqrt(0.5), 0.0, np.sqrt(0.5), 0.0]  # z along x


def scene(size=(0.26, 0.26)) -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    tray = C.addFrame("tray", "table").setRelativePosition([-0.3, 0.3, 0.055])
    tray.setShape(ry.ST.ssBox, [*size, 0.01, 0.004]).setContact(1)
    return C


def body(C, name, height, mass=0.1, at=(0.25, 0.25), turn=0.4, tilt=(1.0, 0.0, 0.0, 0.0)) -> ry.Frame:
    """A thing without a shape whose lowest point is half of `height` below its frame."""
    frame = C.addFrame(name, "table").setJoint(ry.JT.rigid).setMass(mass)
    about = ry.Quaternion().setRad(turn, [0, 0, 1]) * ry.Quaternion().set(list(tilt))
    frame.setRelativePosition([*at, 0.05 + 0.5 * height])
    return frame.setRelativeQuaternion(about.asArr())


def part(C, name, parent, at, shape, size) -> None:
    C.addFrame(name, parent).setRelativePosition(at).setShape(shape, size).setContact(1)


def walls(C, name, sides, height, thick=0.005) -> None:
    x, y = sides
    for k, (a, b) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
        at = [0.5 * a * (x - thick), 0.5 * b * (y - thick), 0.5 * height]
        size = [thick, y, height] if a else [x - 2 * thick, thick, height]
        part(C, f"{name}{k}", name, at, ry.ST.ssBox, [*size, 0.001])


def is_on_tray(before, world, name, height) -> bool:
    """Whether an object lies on the tray with the same side up as before."""
    now, then = (C.getFrame(name) for C in (world, before))
    at = now.getPosition() - world.getFrame("tray").getPosition()
    up, before_up = now.getRotationMatrix()[2], then.getRotationMatrix()[2]
    same = abs(up[2] - before_up[2]) < 0.02 if now.getShapeType() == ry.ST.cylinder else up @ before_up > 0.99
    return bool(same and np.all(np.abs(at[:2]) < 0.13) and abs(at[2] - 0.005 - 0.5 * height) < 4e-3)


def mug(C, side) -> None:
    body(C, "mug", 0.006, 0.2).setShape(ry.ST.ssBox, [side, side, 0.006, 0.001]).setContact(1)
    walls(C, "mug", (side, side), 0.09)


@pytest.mark.parametrize("side", [0.07, 0.09])
def test_a_mug_is_held_across_or_by_a_wall(side) -> None:
    C = scene()
    mug(C, side)
    plan = ry.planTask(C, "(on tray mug)")
    assert is_on_tray(C, executed(C, plan), "mug", 0.006)


def test_a_bowl_that_is_wider_than_the_hand_is_held_by_its_rim() -> None:
    C, n = scene(), 12
    body(C, "bowl", 0.008, 0.2).setShape(ry.ST.cylinder, [0.008, 0.05]).setContact(1)
    for k in range(n):
        a = 2 * np.pi * k / n
        wall = C.addFrame(f"bowl{k}", "bowl").setRelativePosition([0.055 * np.cos(a), 0.055 * np.sin(a), 0.025])
        wall.setRelativeQuaternion(ry.Quaternion().setRad(a, [0, 0, 1]).asArr())
        wall.setShape(ry.ST.ssBox, [0.006, 0.03, 0.05, 0.002]).setContact(1)
    assert is_on_tray(C, executed(C, ry.planTask(C, "(on tray bowl)")), "bowl", 0.008)


def test_a_wide_lid_is_held_by_its_knob_and_a_wide_bottle_by_its_neck() -> None:
    C = scene()
    body(C, "lid", 0.008, 0.2).setShape(ry.ST.cylinder, [0.008, 0.07]).setContact(1)
    part(C, "knob", "lid", [0, 0, 0.0165], ry.ST.cylinder, [0.025, 0.014])
    assert is_on_tray(C, executed(C, ry.planTask(C, "(on tray lid)")), "lid", 0.008)
    C = scene()
    body(C, "bottle", 0.13, 0.3).setShape(ry.ST.cylinder, [0.13, 0.045]).setContact(1)
    part(C, "neck", "bottle", [0, 0, 0.09], ry.ST.cylinder, [0.05, 0.013])
    assert is_on_tray(C, executed(C, ry.planTask(C, "(on tray bottle)")), "bottle", 0.13)


def test_parts_without_a_shape_of_the_whole_are_an_object() -> None:
    C = scene()
    body(C, "cup", 0.09)
    part(C, "cup_body", "cup", [0, 0, 0], ry.ST.cylinder, [0.09, 0.028])
    assert "(is_object cup)" in ry.sceneFacts(C) and "(is_object cup_body)" not in ry.sceneFacts(C)
    assert is_on_tray(C, executed(C, ry.planTask(C, "(on tray cup)")), "cup", 0.09)
    body(C, "nothing", 0.09)
    message = ry.planTask(C, "(on tray nothing)").message
    assert "'nothing' is no object: neither it nor a part fixed to it has a shape that collides" in message


@pytest.mark.parametrize("height", [0.006, 0.012, 0.02])
def test_a_card_on_the_table_is_held_by_the_tips_of_the_fingers(height) -> None:
    C = scene()
    body(C, "card", height, 0.05).setShape(ry.ST.ssBox, [0.06, 0.09, height, 0.001]).setContact(1)
    assert is_on_tray(C, executed(C, ry.planTask(C, "(on tray card)")), "card", height)


@pytest.mark.parametrize("radius", [0.006, 0.01, 0.028])
def test_what_lies_stays_lying(radius) -> None:
    C = scene()
    body(C, "pen", 2 * radius, 0.05, tilt=LYING).setShape(ry.ST.cylinder, [0.14, radius]).setContact(1)
    assert is_on_tray(C, executed(C, ry.planTask(C, "(on tray pen)")), "pen", 2 * radius)


def test_what_no_finger_gets_around_is_said() -> None:
    C = scene()
    body(C, "book", 0.02).setShape(ry.ST.ssBox, [0.12, 0.17, 0.02, 0.002]).setContact(1)
    message = ry.planTask(C, "(on tray book)").message
    assert "'book' is wider than 'l_gripper' opens (0.080 m) along its level axes, and no finger gets below" in message
    C = scene()
    body(C, "card", 0.003).setShape(ry.ST.ssBox, [0.06, 0.09, 0.003, 0.001]).setContact(1)
    message = ry.planTask(C, "(on tray card)").message
    assert "'card' is 3.0 mm high, too thin for the tips of 'l_gripper' (4 mm) while it lies flat on 'table'" in message


def test_a_heavy_kettle_is_held_in_the_middle_of_its_bow() -> None:
    C = scene()
    body(C, "kettle", 0.14, mass=0.9)
    part(C, "pot", "kettle", [0, 0, 0], ry.ST.cylinder, [0.14, 0.07])
    part(C, "bow", "kettle", [0, 0, 0.12], ry.ST.ssBox, [0.11, 0.02, 0.02, 0.004])
    for side in (-1, 1):
        part(C, f"post{side}", "kettle", [0.05 * side, 0, 0.095], ry.ST.ssBox, [0.012, 0.02, 0.05, 0.003])
    plan = ry.planTask(C, "(on tray kettle)")
    assert min(error for error, _ in plan.tolerances) > 3e-3, plan.explain()
    assert is_on_tray(C, executed(C, plan), "kettle", 0.14)


def test_a_bottle_is_held_across_where_its_sides_are() -> None:
    C = scene()
    body(C, "bottle", 0.145, mass=0.3).setShape(ry.ST.cylinder, [0.145, 0.0304]).setContact(1)
    part(C, "neck", "bottle", [0, 0, 0.0975], ry.ST.cylinder, [0.05, 0.013])
    plan = ry.planTask(C, "(on tray bottle)")
    C.setJointState(plan.waypoints[0])
    grip = C.getFrame("l_gripper").getPosition() - C.getFrame("bottle").getPosition()
    assert np.hypot(*grip[:2]) < 0.006, grip  # not beside its axis


def test_a_bottle_between_boards_that_meets_the_camera_of_the_hand_is_held_off_center() -> None:
    C = scene()
    body(C, "bottle", 0.2, mass=0.2, at=(0.0, 0.5)).setShape(ry.ST.cylinder, [0.2, 0.03]).setContact(1)
    part(C, "neck", "bottle", [0, 0, 0.125], ry.ST.cylinder, [0.05, 0.013])
    for name, at, size in (
        ("left", [-0.21, 0.55, 0.225], [0.02, 0.3, 0.35]),
        ("right", [0.21, 0.55, 0.225], [0.02, 0.3, 0.35]),
        ("back", [0, 0.71, 0.225], [0.44, 0.02, 0.35]),
        ("roof", [0, 0.55, 0.41], [0.44, 0.3, 0.02]),
    ):
        part(C, name, "table", at, ry.ST.ssBox, [*size, 0.004])
    plan = ry.planTask(C, "(on l_gripper bottle)")
    assert plan.feasible and ry.checkTaskPlan(C, plan) == [], plan
