"""Scenes as a person sets them up on the first day: planned from what stands where, or refused with the reason."""

import numpy as np
import pytest

import kinegraph as ry
from executed_plans import executed
from first_day import TOP, box, crane, scene, tray
from task_scenes import everyday_scenes

NARROWER = "hands open to 55 mm only: wider ones have less than the margin, or no room, beside the objects"


def stands(world, name, place, top, radius) -> bool:
    """Whether an object rests on a place whose top has a height, within a radius around its center."""
    at, center = world.getFrame(name).getPosition(), world.getFrame(place).getPosition()
    upright = world.getFrame(name).getRotationMatrix()[2, 2] > 0.99
    return bool(upright and abs(at[2] - top) < 4e-3 and np.linalg.norm((at - center)[:2]) < radius)


def barWithAWeight(mass: float) -> ry.Config:
    C = scene()
    tray(C, (0.3, 0.3, 0.01))
    box(C, "bar", "table", (0.25, 0.25, TOP), (0.24, 0.045, 0.045))
    weight = C.addFrame("weight", "bar").setRelativePosition([0.095, 0, 0])
    weight.setShape(ry.ST.ssBox, [0.03, 0.03, 0.03, 0.004]).setMass(mass)
    return C


def gripOf(C: ry.Config, plan: ry.TaskPlan) -> float:
    """Where along the bar the hand takes it, m."""
    C = C.copy()
    C.setJointState(plan.waypoints[0])
    bar = C.getFrame("bar")
    return float(((C.getFrame("l_gripper").getPosition() - bar.getPosition()) @ bar.getRotationMatrix())[0])


def test_a_search_for_a_more_robust_plan_ends_with_its_evaluations() -> None:
    plan = ry.planTask(barWithAWeight(4.0), "(on tray bar)", max_evaluations=1000)
    assert plan.feasible and plan.tolerances[0][0] == 0.0
    assert plan.evaluations < 2000


def test_a_heavy_object_is_held_close_to_its_center_of_mass() -> None:
    C = barWithAWeight(0.6)
    plan = ry.planTask(C, "(on tray bar)")
    assert abs(gripOf(C, plan) - 0.095 * 0.6 / 0.7) < 0.025
    assert stands(executed(C, plan), "bar", "tray", TOP + 0.01 + 0.0225, 0.15)


def test_an_object_that_turned_in_the_hand_is_held_closer_to_its_center_of_mass() -> None:
    plan = ry.planTask(barWithAWeight(0.01), "(on tray bar)")
    C = barWithAWeight(0.6)  # nobody has told the plan of it
    bot = ry.BotOp(C)
    run = plan.execute(bot)
    assert run.feasible and run.repairs >= 1, run
    C.getFrame("bar").setAttributes({"lever": 0.01})
    assert abs(gripOf(C, ry.planTask(C, "(on tray bar)")) - 0.095 * 0.6 / 0.7) < 0.012


def test_an_object_that_is_too_heavy_for_the_fingers_is_told() -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP)).setMass(12.0)
    plan = ry.planTask(C, "(on tray red)")
    assert "'red' (12.0 kg) slips out of 'l_gripper', which lifts 4.1 kg" in plan.explain()


def bottle(mass: float) -> ry.Config:
    C = scene()
    tray(C, (0.3, 0.3, 0.01))
    frame = C.addFrame("bottle", "table").setPosition([0.25, 0.3, TOP + 0.11]).setJoint(ry.JT.rigid)
    frame.setShape(ry.ST.cylinder, [0.22, 0.035]).setContact(1).setMass(mass)
    neck = C.addFrame("neck", "bottle").setRelativePosition([0, 0, 0.14])
    neck.setShape(ry.ST.cylinder, [0.06, 0.013]).setContact(1)
    return C


def test_a_heavy_bottle_does_not_swing_in_the_hand() -> None:
    C = bottle(1.0)
    world = executed(C, ry.planTask(C, "(on tray bottle)"))
    assert stands(world, "bottle", "tray", TOP + 0.01 + 0.11, 0.17)


def test_what_turns_in_the_hand_wherever_it_is_taken_is_told() -> None:
    C = scene()
    tray(C, (0.3, 0.3, 0.01))
    pan = C.addFrame("pan", "table").setPosition([0.2, 0.3, TOP + 0.02]).setJoint(ry.JT.rigid)
    pan.setShape(ry.ST.cylinder, [0.04, 0.11]).setContact(1).setMass(1.5)
    handle = C.addFrame("handle", "pan").setRelativePosition([0.2, 0, 0.011])
    handle.setShape(ry.ST.ssBox, [0.18, 0.024, 0.018, 0.004]).setContact(1)
    plan = ry.planTask(C, "(on tray pan)")
    told = "'pan' turns in 'l_gripper': its center of mass is "
    assert any(told in warning and "mm beside the fingers" in warning for warning in plan.warnings), plan.explain()


def test_what_is_a_little_too_far_is_not_reached() -> None:
    C = scene()
    tray(C).setPosition([0.8, 0.5, TOP + 0.005])
    box(C, "red", "table", (0.3, 0.3, TOP))
    plan = ry.planTask(C, "(on tray red)")
    assert "with nothing in the way: 'l_gripper' does not reach 'tray'" in plan.message, plan


def betweenWalls(C: ry.Config) -> ry.Config:
    """A tray, and a red box with a wall on two sides."""
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP))
    for name, at, size in (("wall", (0.355, 0.3), (0.02, 0.2, 0.07)), ("other", (0.3, 0.355), (0.2, 0.02, 0.07))):
        wall = C.addFrame(name, "table").setPosition([*at, TOP + 0.035])
        wall.setShape(ry.ST.ssBox, [*size, 0.004]).setContact(1)
    return C


def test_hands_open_less_where_wide_ones_have_no_room() -> None:
    C = betweenWalls(scene())
    plan = ry.planTask(C, "(on tray red)")
    assert NARROWER in plan.warnings, plan
    assert stands(executed(C, plan), "red", "tray", TOP + 0.01 + 0.035, 0.1)


SMALL_HAND = """
stand: { X: [-1.5 0 1] }
rail (stand): { joint: transX, limits: [-.1 .1] }
a_gripper (rail): { shape: marker, size: [.02] }
a_palm (rail): { shape: ssBox, size: [.1 .04 .03 .005], rel: [0 0 .08], contact: 1 }
a_finger1 (rail): { joint: transX, limits: [0 .02], joint_active: False }
a_finger2 (rail): { joint: transX, mimic: a_finger1, joint_scale: -1, joint_active: False }
Edit a_finger1: { shape: ssBox, size: [.01 .02 .05 .004], contact: 1 }
Edit a_finger2: { shape: ssBox, size: [.01 .02 .05 .004], contact: 1 }
"""


def test_a_small_hand_elsewhere_lets_another_one_open_less() -> None:
    C = ry.Config()
    C.addText(SMALL_HAND)
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    plan = ry.planTask(betweenWalls(C), "(on tray red)")
    assert NARROWER in plan.warnings, plan


def test_names_that_contain_those_of_a_hand_do_not_change_the_search() -> None:
    evaluations = []
    for name in ("red", "the_l_palm"):
        C = scene()
        tray(C)
        box(C, name, "table", (0.75, 0.35, TOP))
        plan = ry.planTask(C, f"(on tray {name})")
        assert f"'l_gripper' misses its grasp of '{name}'" in plan.message, plan
        evaluations.append(plan.evaluations)
    assert evaluations[0] == evaluations[1]


@pytest.mark.parametrize("radius", [0.035, 0.0375])
def test_a_ball_that_meets_the_camera_of_the_hand_is_held_off_center(radius) -> None:
    C = scene()
    tray(C)
    ball = C.addFrame("ball", "table").setPosition([0.3, 0.3, TOP + radius]).setJoint(ry.JT.rigid)
    ball.setShape(ry.ST.sphere, [radius]).setContact(1).setMass(0.15)
    world = executed(C, ry.planTask(C, "(on tray ball)"))
    assert stands(world, "ball", "tray", TOP + 0.01 + radius, 0.05)


def test_a_robotiq_takes_a_low_bar_with_its_fingertips() -> None:
    C = everyday_scenes.urRobotiq(np.random.default_rng(0)).C
    low = C.getFrame("box0").setShape(ry.ST.ssBox, [0.12, 0.03, 0.02, 0.004])
    low.setPosition([*low.getPosition()[:2], TOP + 0.01])
    plan = ry.planTask(C, "(on gripper box0)")
    assert plan.feasible, plan
    executed(C, plan)  # pressed by the fingers


def test_an_object_that_is_held_and_stands_still_is_lifted_first() -> None:
    C = scene()
    tray(C)
    box(C, "red", "table", (0.3, 0.3, TOP))
    C.setJointState(ry.planTask(C, "(on l_gripper red)").path[-1])
    red = C.getFrame("red")
    red.setPosition(red.getPosition() - [0, 0, 2e-6])  # as it stands in a simulation
    red.setParent(C.getFrame("l_gripper"), True).setJoint(ry.JT.rigid)
    plan = ry.planTask(C, "(on tray red)")
    assert plan.feasible and len(plan.actions) == 1, plan
    heights = []
    for q in plan.path[:: len(plan.path) // 20]:
        C.setJointState(q)
        heights.append(red.getPosition()[2])
    assert max(heights) > heights[0] + 0.03


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


def test_a_place_is_cleared_of_whatever_stands_there() -> None:
    C = scene()
    tray(C)
    for name, x in (("red", -0.33), ("blue", -0.25)):
        box(C, name, "tray", (x, 0.3, TOP + 0.01))
    plan = ry.planTask(C, "(on tray ANY)!")
    world = executed(C, plan)  # the last one is in the hand
    first = plan.actions[0][1]
    assert first in ("red", "blue") and not stands(world, first, "tray", TOP + 0.01 + 0.035, 0.14)


def test_things_that_change_places_wait_where_there_is_room() -> None:
    C = scene()
    for k, x in enumerate((-0.3, 0.3)):
        pad = C.addFrame(f"pad{k}", "table").setPosition([x, 0.3, TOP + 0.005])
        pad.setShape(ry.ST.ssBox, [0.1, 0.1, 0.01, 0.004]).setContact(1)
        box(C, f"box{k}", f"pad{k}", (x, 0.3, TOP + 0.01))
    plan = ry.planTask(C, "(on pad1 box0) (on pad0 box1)")
    assert len(plan.actions) == 6  # one waits on the table, and not on the edge of the other's pad
    world = executed(C, plan)
    for name, place in (("box0", "pad1"), ("box1", "pad0")):
        assert stands(world, name, place, TOP + 0.01 + 0.035, 0.02)


def test_a_place_without_room_for_both_takes_both_if_the_goal_says_so() -> None:
    C = scene()
    tray(C, (0.12, 0.06, 0.01))
    box(C, "red", "table", (0.3, 0.3, TOP), (0.05, 0.05, 0.07))
    box(C, "blue", "table", (0.1, 0.4, TOP), (0.065, 0.05, 0.07))
    plan = ry.planTask(C, "(on tray red) (on tray blue)")
    assert plan.feasible, plan


HAND = """<robot name="arm">
<link name="base"/>{links}
<joint name="j1" type="revolute"><parent link="base"/><child link="l1"/><origin xyz="0 0 .15"/><axis xyz="0 0 1"/>
  <limit lower="-2.8" upper="2.8" velocity="2" effort="100"/></joint>
<joint name="j2" type="revolute"><parent link="l1"/><child link="l2"/><origin xyz="0 0 .15"/><axis xyz="0 1 0"/>
  <limit lower="-2.8" upper="2.8" velocity="2" effort="100"/></joint>
<joint name="j3" type="revolute"><parent link="l2"/><child link="l3"/><origin xyz="0 0 .35"/><axis xyz="0 1 0"/>
  <limit lower="-2.8" upper="2.8" velocity="2" effort="100"/></joint>
<joint name="j4" type="revolute"><parent link="l3"/><child link="l4"/><origin xyz="0 0 .3"/><axis xyz="0 1 0"/>
  <limit lower="-2.8" upper="2.8" velocity="2" effort="100"/></joint>
<joint name="j5" type="revolute"><parent link="l4"/><child link="hand"/><origin xyz="0 0 .1"/><axis xyz="0 0 1"/>
  <limit lower="-2.8" upper="2.8" velocity="2" effort="100"/></joint>
<joint name="left" type="prismatic"><parent link="hand"/><child link="finger1"/><origin xyz="0 0 .04"/><axis xyz="0 1 0"/>
  <limit lower="0" upper=".05" velocity="2" effort="100"/></joint>
<joint name="right" type="prismatic"><parent link="hand"/><child link="finger2"/><origin xyz="0 0 .04"/><axis xyz="0 -1 0"/>
  <limit lower="0" upper=".05" velocity="2" effort="100"/><mimic joint="left"/></joint>
<link name="gripper"/>
<joint name="tool" type="fixed"><parent link="hand"/><child link="gripper"/><origin xyz="0 0 .09" rpy="3.14159265 0 0"/></joint>
</robot>"""


def link(name, size, center, mass=1.0) -> str:
    inertia = '<inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/>'
    return (
        f'<link name="{name}"><inertial><origin xyz="{center}"/><mass value="{mass}"/>{inertia}</inertial>'
        f'<collision><origin xyz="{center}"/><geometry><box size="{size}"/></geometry></collision></link>'
    )


def armOfAUrdfFile(folder) -> ry.Config:
    """An arm with a hand whose fingers are joints of q, as URDF files have them, and a mug and a tray."""
    parts = [("l1", ".05 .05 .09", "0 0 .075"), ("l2", ".05 .05 .29", "0 0 .175"), ("l3", ".05 .05 .24", "0 0 .15")]
    parts += [("l4", ".05 .05 .04", "0 0 .05"), ("hand", ".05 .14 .04", "0 0 .02")]
    links = [link(*part) for part in parts]
    links += [link(f"finger{k}", ".02 .01 .07", f"0 {y} .035", 0.05) for k, y in ((1, 0.005), (2, -0.005))]
    (folder / "arm.urdf").write_text(HAND.format(links="".join(links)))
    C = ry.Config()
    C.addFile(str(folder / "arm.urdf"))
    C.addFrame("table").setPosition([0, 0, -0.05]).setShape(ry.ST.ssBox, [1.6, 1.6, 0.1, 0.01]).setContact(1)
    C.setJointState([0, 0.5, 1.2, 1.3, 0, 0])
    box(C, "mug", "table", (0.4, 0.25, 0.0), (0.05, 0.05, 0.1))
    frame = C.addFrame("tray", "table").setPosition([0.4, -0.25, 0.005])
    frame.setShape(ry.ST.ssBox, [0.2, 0.2, 0.01, 0.004]).setContact(1)
    return C


def test_fingers_that_are_joints_of_q_are_no_gripper(tmp_path) -> None:
    C = armOfAUrdfFile(tmp_path)
    plan = ry.planTask(C, "(on tray mug)")
    assert plan.feasible
    with pytest.raises(ry.ArgumentError, match=r"fingers of 'gripper' \(left, right\) are joints of q.*selectJoints"):
        plan.execute(ry.BotOp(C))
    C.selectJoints(["j1", "j2", "j3", "j4", "j5"])
    world = executed(C, ry.planTask(C, "(on tray mug)"))
    assert stands(world, "mug", "tray", 0.01 + 0.05, 0.1)


@pytest.mark.parametrize("sign", [1, -1])
def test_turning_fingers_open_at_either_limit(sign: int) -> None:
    C = crane(sign)
    plan = ry.planTask(C, "(on tray box)")
    assert [action[0] for action in plan.actions] == ["pick", "place"]
    assert ry.checkTaskPlan(C, plan) == []
    assert stands(executed(C, plan), "box", "tray", 0.61 + 0.04, 0.15)
