"""Plans with room: placements, grasps, margins, tolerances, and long goals. Scenes of the first day, with a Panda at a
table.
"""

import numpy as np
import pytest

import kinegraph as ry
from task_scenes import panda_tasks, planned

TABLE_TOP = 0.05  # above the table's frame, m


def panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


def plate(C: ry.Config, name: str, at: list[float], width: float) -> None:
    frame = C.addFrame(name, "table").setRelativePosition([*at, TABLE_TOP + 0.005])
    frame.setShape(ry.ST.ssBox, [width, width, 0.01, 0.004]).setContact(1)


def box(C: ry.Config, name: str, at: list[float], width: float = 0.05, height: float = 0.07, on: str = "table") -> None:
    top = TABLE_TOP if on == "table" else C.getFrame(on).getSize()[2] / 2
    frame = C.addFrame(name, on).setRelativePosition([*at, top + height / 2]).setJoint(ry.JT.rigid)
    frame.setShape(ry.ST.ssBox, [width, width, height, 0.004]).setContact(1).setMass(500 * width * width * height)


def after(C: ry.Config, plan: ry.TaskPlan, seconds: float = 2.0) -> ry.Config:
    """The world after an execution."""
    bot = ry.BotOp(C)
    plan.execute(bot)
    D = C.copy()
    bot.sync(D, seconds)
    return D


def overhang(C: ry.Config, name: str, place: str) -> float:
    """Returns the overhang of the footprint of a box over its place, m."""
    a, b = C.getFrame(place), C.getFrame(name)
    R = a.getRotationMatrix().T @ b.getRotationMatrix()
    at = a.getRotationMatrix().T @ (b.getPosition() - a.getPosition())
    half = 0.5 * np.asarray(b.getSize()[:2])
    reach = np.abs(R[:2, :2]) @ half
    return float((np.abs(at[:2]) + reach - 0.5 * np.asarray(a.getSize()[:2])).max())


@pytest.mark.parametrize("seed", range(3))
def test_boxes_stand_on_a_tray_with_their_whole_footprints(seed: int) -> None:
    C, rng = panda(), np.random.default_rng(seed)
    plate(C, "tray", [0.14 + rng.uniform(-0.05, 0.05), 0.39], 0.22)
    box(C, "b0", [-0.45 + rng.uniform(-0.05, 0.05), 0.25])
    box(C, "b1", [-0.18 + rng.uniform(-0.03, 0.03), 0.15])
    plan = ry.planTask(C, "(on tray b0) (on tray b1)")
    assert plan.feasible and not plan.warnings
    assert plan.margin == pytest.approx(0.005) and ry.checkTaskPlan(C, plan, margin=0.005) == []
    assert min(error for error, _ in plan.tolerances) > 0.003
    assert "weakest step" in plan.explain()
    D = after(C, plan)
    for name in ("b0", "b1"):
        assert overhang(D, name, "tray") < 0.0
        assert D.getFrame(name).getPosition()[2] - D.getFrame("tray").getPosition()[2] == pytest.approx(0.04, abs=3e-3)


def test_one_object_comes_to_the_middle() -> None:
    C = panda()
    plate(C, "tray", [0.2, 0.4], 0.2)
    box(C, "b", [-0.3, 0.3])
    plan = ry.planTask(C, "(on tray b)")
    last = plan.scenes[-1]
    last.setJointState(plan.path[-1])
    off = last.getFrame("b").getPosition() - last.getFrame("tray").getPosition()
    assert np.linalg.norm(off[:2]) < 0.01


@pytest.mark.parametrize("at", [(-0.3, 0.2), (-0.2, 0.4), (0.0, 0.35), (0.3, 0.05)])
def test_a_can_is_grasped_where_the_palm_has_room(at: tuple[float, float]) -> None:
    C = panda()
    can = C.addFrame("can", "table").setRelativePosition([*at, TABLE_TOP + 0.05]).setJoint(ry.JT.rigid)
    can.setShape(ry.ST.cylinder, [0.1, 0.033]).setContact(1).setMass(0.17)
    plate(C, "pad", [0.25, 0.35], 0.12)
    plan = ry.planTask(C, "(on pad can)")
    assert plan.feasible and len(plan.actions) == 2, plan


def test_three_slabs_move_in_pieces() -> None:
    C = panda()
    for name, x in (("left", -0.35), ("middle", 0.0), ("right", 0.35)):
        plate(C, name, [x, 0.35], 0.18)
    below = "left"
    for i, width in enumerate((0.07, 0.06, 0.05)):
        box(C, f"slab{i}", [0.0, 0.0], width, 0.04, on=below)
        below = f"slab{i}"
    plan = ry.planTask(C, "(on right slab0) (on slab0 slab1) (on slab1 slab2)")
    assert plan.feasible and ry.checkTaskPlan(C, plan) == [], plan.message
    again = ry.planTask(C, "(on right slab0) (on slab0 slab1) (on slab1 slab2)", threads=2)
    np.testing.assert_array_equal(again.path, plan.path)


def test_where_there_is_less_room_a_warning_says_between_what() -> None:
    C = panda()
    plate(C, "pad", [0.3, 0.35], 0.12)
    box(C, "a", [-0.2, 0.3])
    for i, (x, y) in enumerate([(-0.0575, 0), (0.0575, 0), (0, -0.0575), (0, 0.0575)]):  # no hand passes with 5 mm
        wall = C.addFrame(f"wall{i}", "table").setRelativePosition([-0.2 + x, 0.3 + y, TABLE_TOP + 0.03])
        wall.setShape(ry.ST.ssBox, [0.02, 0.2, 0.06, 0.004] if y == 0 else [0.2, 0.02, 0.06, 0.004]).setContact(1)
    plan = ry.planTask(C, "(on pad a)")
    assert plan.feasible
    assert 0 <= plan.margin < 0.005
    assert "'wall" in plan.warnings[0] and "mm apart on the way" in plan.warnings[0]
    assert ry.checkTaskPlan(C, plan, margin=0.005)
    assert ry.checkTaskPlan(C, plan) == []


def slowZone(C: ry.Config, plan: ry.TaskPlan) -> tuple[float, float]:
    """The speed of the hand up to 5 cm away from where it takes the object, and everywhere else; m/s."""
    D, hand = C.copy(), []
    for q in plan.path:
        D.setJointState(q)
        hand.append(D.getFrame("l_gripper").getPosition())
    at, grasp = np.array(hand), plan.segments[0].stop - 1
    steps = np.diff(plan.times)
    speeds = np.linalg.norm(np.diff(at, axis=0), axis=1) / np.where(steps > 0, steps, np.inf)
    near = np.linalg.norm(0.5 * (at[1:] + at[:-1]) - at[grasp], axis=1) < 0.05
    return float(speeds[near].max()), float(speeds[~near].max())


def test_hands_are_slow_where_they_take_something() -> None:
    C = panda()
    plate(C, "tray", [-0.3, 0.3], 0.2)
    box(C, "b", [0.3, 0.3])
    plan, fast = (ry.planTask(C, "(on tray b)", contact_speed=v) for v in (0.15, float("inf")))
    np.testing.assert_array_equal(plan.path, fast.path)
    assert slowZone(C, plan)[0] < 0.151 < 0.25 < slowZone(C, fast)[0]
    assert slowZone(C, plan)[1] == pytest.approx(slowZone(C, fast)[1], rel=0.2)
    assert fast.duration < plan.duration < 1.3 * fast.duration
    assert ry.checkTaskPlan(C, plan) == []
    with pytest.raises(ry.ArgumentError, match="contact_speed is 0 m/s; expected a number > 0, or infinity"):
        ry.planTask(C, "(on tray b)", contact_speed=0.0)


def test_a_margin_is_a_number_of_meters() -> None:
    C = panda()
    box(C, "b", [-0.3, 0.3])
    with pytest.raises(ry.ArgumentError, match="margin is -1"):
        ry.planTask(C, "(on table b)", margin=-1.0)


@pytest.mark.parametrize(("scene", "open_width"), [("panda_fixRobotiq.g", 0.085), ("panda_fixGripper.g", 0.08)])
def test_the_width_of_a_hand_is_its_opening_in_meters(scene: str, open_width: float) -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/" + scene))
    bot = ry.BotOp(C)
    D = C.copy()
    with pytest.warns(ry.KinegraphWarning, match="1 m is beyond the opening"):
        bot.gripperMove(0, 1.0)
    bot.sync(D, 3.0)
    assert bot.getGripperPos(0) == pytest.approx(open_width, abs=0.012)
    bot.gripperMove(0, 0.03)
    bot.sync(D, 3.0)
    assert bot.getGripperPos(0) == pytest.approx(0.03, abs=4e-3)
    bot.gripperClose(0)
    bot.sync(D, 3.0)
    assert bot.getGripperPos(0) < 0.005


@pytest.mark.parametrize("seed", [0, 3, 7])
def test_a_drawer_is_opened_with_room_for_errors_of_pose(seed: int) -> None:
    C, plan = planned(panda_tasks.stow(seed))  # from above, the camera of the hand passes the roof at 2 mm
    assert min(error for error, _ in plan.tolerances) >= 3e-3, plan.explain()
    assert ry.checkTaskPlan(C, plan) == []


@pytest.mark.parametrize("seed", [1, 6, 9, 11, 14])
def test_a_hand_takes_a_handle_without_reaching_into_the_door(seed: int) -> None:
    _, plan = planned(panda_tasks.door(seed))
    assert min(error for error, _ in plan.tolerances) >= 3e-3, plan.explain()


@pytest.mark.parametrize("seed", [2, 14])
def test_a_tool_keeps_the_margin_to_its_object_until_it_is_behind_it(seed: int) -> None:
    problem = panda_tasks.hook(seed)
    plan = ry.planTask(problem.C, problem.goal, seed=seed)
    assert [action[0] for action in plan.actions[:2]] == ["pick", "hook_start"]
    scene, least = plan.scenes[1], 1.0
    rows = plan.path[plan.segments[1]]
    scene.setJointState(rows[-1])
    end = scene.getFrame("l_gripper").getPosition()
    for q in rows[::2]:
        scene.setJointState(q)
        if np.linalg.norm(scene.getFrame("l_gripper").getPosition() - end) > 0.08:
            gaps = [d for a, b, d in scene.getCollisions(0.01) if {a, b} in ({"stick", "cup"}, {"bar", "cup"})]
            least = min([least, *gaps])
    assert least > 0.0045


@pytest.mark.filterwarnings("ignore:.*overlap at a constant relative pose")
def test_a_base_on_the_floor_costs_no_margin() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))  # its shoulder is 3 mm above the floor, wherever the arm is
    C.addFrame("floor").setShape(ry.ST.ssBox, [3.0, 3.0, 0.1, 0.01]).setPosition([0, 0, -0.05]).setContact(1)
    red = C.addFrame("red", "floor").setShape(ry.ST.ssBox, [0.05, 0.05, 0.08, 0.004]).setPosition([0.5, 0.2, 0.04])
    red.setJoint(ry.JT.rigid).setContact(1).setMass(0.1)
    tray = C.addFrame("tray", "floor").setShape(ry.ST.ssBox, [0.2, 0.2, 0.02, 0.004])
    tray.setPosition([0.5, -0.2, 0.01]).setContact(1)
    plan = ry.planTask(C, "(on tray red)")
    assert plan.margin == pytest.approx(0.005) and plan.warnings == []
    assert min(error for error, _ in plan.tolerances) > 5e-3
    assert ry.checkTaskPlan(C, plan, margin=0.005) == []


def test_a_ball_falls_over_nowhere() -> None:
    C = panda()
    plate(C, "bowl", [-0.3, 0.3], 0.16)
    for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
        rim = C.addFrame(f"rim{k}", "bowl").setRelativePosition([0.08 * x, 0.08 * y, 0.015])
        rim.setShape(ry.ST.ssBox, [0.01 if x else 0.17, 0.01 if y else 0.17, 0.04, 0.004]).setContact(1)
    ball = C.addFrame("ball", "table").setShape(ry.ST.sphere, [0.03]).setRelativePosition([0.3, 0.3, TABLE_TOP + 0.03])
    ball.setJoint(ry.JT.rigid).setContact(1).setMass(0.05)
    plan = ry.planTask(C, "(on bowl ball)")
    assert min(error for error, _ in plan.tolerances) > 3e-3, plan.explain()
