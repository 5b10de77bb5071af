"""Scenes of one's own: towers, arms that face away, hands that do not reach everything, shelves. Each plan is found
quickly, and survives its execution.
"""

import numpy as np
import pytest

import kinegraph as ry
from executed_plans import executed

QUICK = 20000  # evaluations: several times what the search needs


def body(C: ry.Config, name: str, parent: str, at: list[float], size: list[float], mass: float = 0.0) -> ry.Frame:
    """Adds a box; an object if it has a mass."""
    frame = C.addFrame(name, parent).setRelativePosition(at).setShape(ry.ST.ssBox, [*size, 0.003]).setContact(1)
    return frame.setJoint(ry.JT.rigid).setMass(mass) if mass else frame


def stands(world: ry.Config, name: str, place: str) -> bool:
    """Whether the bottom of a box is on the top of another, with its center above it."""
    thing, base = world.getFrame(name), world.getFrame(place)
    at = base.getRotationMatrix().T @ (thing.getPosition() - base.getPosition())
    height = 0.5 * (thing.getSize()[2] + base.getSize()[2])
    return bool(abs(at[2] - height) < 4e-3 and np.all(np.abs(at[:2]) < 0.5 * np.asarray(base.getSize()[:2])))


def test_a_tower_moves_and_no_object_passes_through_the_one_below_it() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    for name, at in (("here", [-0.26, 0.4, 0.055]), ("there", [0.13, 0.23, 0.055])):
        body(C, name, "table", at, [0.14, 0.14, 0.01])
    below, top = "here", 0.005
    for name, width, height in (("a", 0.06, 0.052), ("b", 0.052, 0.04), ("c", 0.045, 0.048)):
        body(C, name, below, [0, 0, top + 0.5 * height], [width, width, height], 0.1)
        below, top = name, 0.5 * height
    plan = ry.planTask(C, "(on there a) (on a b) (on b c)", max_evaluations=QUICK)
    assert len(plan.actions) == 10, plan
    world = executed(C, plan)
    assert stands(world, "a", "there") and stands(world, "b", "a") and stands(world, "c", "b")


@pytest.mark.parametrize("arm", ["ur5e", "ur10e"])
def test_an_arm_that_faces_away_turns_to_the_table(arm: str) -> None:
    C = ry.Config()
    C.addText(f"""
        world: {{}}
        Include: <{ry.raiPath(f"{arm}/{arm}.g")}>
        Include: <{ry.raiPath("robotiq/robotiq.g")}>
        Edit robotiq_base (tool0): {{ Q: [0 0 .04] }}
        Edit finger_joint: {{ joint_active: false }}
    """)
    C.getFrame("base").setParent(C.getFrame("world")).setRelativePosition([0, 0, 0.7])
    C.addFrame("post", "world").setRelativePosition([0, 0, 0.35]).setShape(ry.ST.cylinder, [0.7, 0.1]).setContact(1)
    body(C, "desk", "world", [0.65, 0, 0.68], [0.8, 1.4, 0.04])
    body(C, "tray", "desk", [-0.1, 0.3, 0.026], [0.2, 0.2, 0.012])
    body(C, "box", "desk", [-0.1, -0.2, 0.06], [0.05, 0.06, 0.08], 0.1)
    assert C.getFrame("gripper").getPosition()[0] < -0.4  # behind the base
    world = executed(C, ry.planTask(C, "(on tray box)", max_evaluations=QUICK))
    assert stands(world, "box", "tray")


def test_each_of_two_arms_takes_what_it_reaches() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    body(C, "left", "table", [-0.5, 0.25, 0.056], [0.2, 0.2, 0.012])
    body(C, "right", "table", [0.5, 0.25, 0.056], [0.2, 0.2, 0.012])
    for name, x, y in (("a", -0.7, 0.1), ("b", 0.7, 0.1), ("c", -0.25, 0.1), ("d", 0.8, -0.1)):
        body(C, name, "table", [x, y, 0.09], [0.045, 0.045, 0.08], 0.1)
    plan = ry.planTask(C, "(on left a) (on right b) (on left c) (on right d)", max_evaluations=QUICK)
    world = executed(C, plan)
    assert all(
        stands(world, name, place) for name, place in zip("abcd", ("left", "right", "left", "right"), strict=True)
    )


def test_a_box_is_taken_out_of_a_shelf() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    body(C, "back", "table", [0, 0.57, 0.2], [0.4, 0.015, 0.3])
    for i in (-1, 1):
        body(C, f"side{i}", "table", [0.2 * i, 0.46, 0.2], [0.015, 0.2, 0.3])
    body(C, "upper", "table", [0, 0.46, 0.35], [0.4, 0.2, 0.015])
    body(C, "lower", "table", [0, 0.46, 0.061], [0.38, 0.2, 0.012])
    body(C, "box", "lower", [0.03, -0.03, 0.056], [0.05, 0.05, 0.1], 0.1)
    body(C, "tray", "table", [-0.4, 0.1, 0.056], [0.18, 0.18, 0.012])
    world = executed(C, ry.planTask(C, "(on tray box)", max_evaluations=QUICK))
    assert stands(world, "box", "tray")


def test_what_makes_way_is_put_on_the_table_and_not_onto_another_object() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    for name, pad, x in (("a", "pad0", -0.3), ("b", "pad1", 0.3)):
        body(C, pad, "table", [x, 0.25, 0.055], [0.11, 0.11, 0.01])
        body(C, name, pad, [0, 0, 0.055], [0.05, 0.06, 0.1], 0.1)
    body(C, "block", "table", [0, 0.4, 0.075], [0.06, 0.05, 0.05], 0.1)
    plan = ry.planTask(C, "(on pad0 b) (on pad1 a)", max_evaluations=QUICK)
    assert next(action[3] for action in plan.actions if action[0] == "place") == "table"
    world = executed(C, plan)
    assert stands(world, "a", "pad1") and stands(world, "b", "pad0")


def test_an_object_from_afar_stands_well_inside_a_large_place() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/panda_mobile.g"))
    C.addFrame("floor")
    for name, x in (("kitchen", 2.0), ("desk", -2.0)):
        body(C, name, "floor", [x, 0, 0.35], [0.8, 1.2, 0.7])
    body(C, "box", "kitchen", [-0.2, 0.1, 0.4], [0.05, 0.05, 0.1], 0.2)
    world = executed(C, ry.planTask(C, "(on desk box)", max_evaluations=QUICK))
    at = world.getFrame("box").getPosition() - world.getFrame("desk").getPosition()
    assert stands(world, "box", "desk") and np.all(np.abs(at[:2]) < [0.37, 0.57])


def pens_and_a_cup(apart: float) -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    cup = C.addFrame("cup", "table").setRelativePosition([0.2, 0.3, 0.053]).setJoint(ry.JT.rigid).setMass(0.3)
    cup.setShape(ry.ST.cylinder, [0.006, 0.035]).setContact(1)
    for k in range(8):
        a = 0.25 * np.pi * k
        wall = C.addFrame(f"wall{k}", "cup").setRelativePosition([0.035 * np.cos(a), 0.035 * np.sin(a), 0.05])
        wall.setRelativeQuaternion([np.cos(0.5 * a), 0, 0, np.sin(0.5 * a)])
        wall.setShape(ry.ST.ssBox, [0.004, 0.03, 0.1, 0.001]).setContact(1)
    for i in range(2):
        pen = C.addFrame(f"pen{i}", "table").setRelativePosition([-0.3 + apart * i, 0.3, 0.057]).setJoint(ry.JT.rigid)
        pen.setRelativeQuaternion([1, 1, 0, 0]).setShape(ry.ST.capsule, [0.13, 0.006]).setContact(1).setMass(0.02)
    return C


def test_a_pen_that_leans_in_a_cup_has_not_fallen_and_a_neighbor_is_left_alone() -> None:
    C = pens_and_a_cup(apart=0.06)
    plan = ry.planTask(C, "(on cup pen0)")
    assert any("hands open to 26 mm only" in warning for warning in plan.warnings)
    assert min(error for error, _ in plan.tolerances) > 2e-3
    world = executed(C, plan)
    up = world.getFrame("pen0").getRotationMatrix()[2, 2]
    assert 0.7 < up < 0.985 and world.getFrame("pen0").getPosition()[2] > 0.7


def test_a_tray_that_is_called_a_carrier_needs_no_other_label() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    body(C, "tray", "table", [-0.3, 0.3, 0.058], [0.2, 0.06, 0.016], 0.3)
    C.getFrame("tray").setAttributes({"logical": {"is_carrier": True}})
    body(C, "glass", "tray", [0, 0, 0.058], [0.04, 0.04, 0.1], 0.1)
    body(C, "board", "table", [0.3, 0.35, 0.055], [0.3, 0.3, 0.01])
    plan = ry.planTask(C, "(on board tray)", max_evaluations=QUICK)
    assert [action[0] for action in plan.actions] == ["lift", "place"], plan
    world = executed(C, plan)
    assert stands(world, "tray", "board") and stands(world, "glass", "tray")


def test_a_hand_with_one_moving_jaw_takes_a_cube() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("so101/so101.g"))
    C.addFrame("desk").setPosition([0.2, 0, -0.02]).setShape(ry.ST.ssBox, [0.8, 0.8, 0.04, 0.005]).setContact(1)
    body(C, "cube", "desk", [0.05, 0.1, 0.035], [0.02, 0.02, 0.03], 0.03)
    body(C, "pad", "desk", [0.05, -0.12, 0.025], [0.08, 0.08, 0.01])
    plan = ry.planTask(C, "(on pad cube)", max_evaluations=QUICK)
    assert not any("axis of 'gripper'" in warning for warning in plan.warnings), plan.warnings
    assert stands(executed(C, plan), "cube", "pad")
