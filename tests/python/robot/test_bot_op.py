"""BotOp from Python: typical scripts, Ctrl-C, parameters, images, and earlier names."""

from __future__ import annotations

import gc
import signal
import subprocess
import sys
import threading
import time
import warnings
import weakref
from collections.abc import Iterator

import numpy as np
import pytest

import kinegraph as ry
from interrupts import interrupt_after


@pytest.fixture(autouse=True)
def no_parameters() -> Iterator[None]:
    yield
    ry.params_clear()


@pytest.fixture
def bot(panda: ry.Config) -> ry.BotOp:
    return ry.BotOp(panda, False)


def test_a_script_moves_there_and_back_and_sees_it_in_its_configuration(panda: ry.Config, bot: ry.BotOp) -> None:
    home = bot.get_qHome()
    goal = home + 0.2
    bot.move([goal, home], [2.0])
    seen = []
    while bot.getTimeToEnd() > 0:
        assert bot.sync(panda, 0.1) == 0
        seen.append(panda.getJointState())
        np.testing.assert_array_equal(seen[-1], bot.get_q())
    assert len(seen) == 20 and bot.get_t() == pytest.approx(2.0)
    farthest = max(np.abs(q - home).max() for q in seen)
    assert 0.1 < farthest < 0.2  # a control point is not passed
    np.testing.assert_allclose(seen[-1], home, atol=1e-4)


def test_arguments_have_the_names_that_scripts_use(panda: ry.Config) -> None:
    bot = ry.BotOp(C=panda, useRealRobot=False)
    bot.move(path=panda.getJointState()[None, :] + 0.1, times=[1.0])
    bot.moveTo(panda.getJointState(), timeCost=5.0, overwrite=True)
    assert bot.wait(panda, forKeyPressed=False, forTimeToEnd=True) == 0
    bot.gripperClose(ry._left, force=20.0, width=0.02, speed=0.1)
    assert bot.wait(panda, forKeyPressed=False, forTimeToEnd=False, forGripper=True) == ord("g")
    assert bot.sync(panda, viewMsg="done") == bot.getKeyPressed() == 0
    observation = bot.stepObservation()
    assert isinstance(observation, ry.StepObservation) and observation.ctrlTime == bot.get_t()
    assert observation.qpos.shape == observation.qvel.shape == observation.qref.shape == (7,)
    bot.stepAction(np.full(7, 0.01), observation, 0.1, maxAccel=1.0)
    bot.setCompliance(panda.eval(ry.FS.position, ["l_gripper"])[1], compliance=0.5)


def test_the_names_of_earlier_years_are_there(panda: ry.Config, bot: ry.BotOp) -> None:
    bot.gripperClose(ry.ArgWord._left)
    bot.wait(panda, forGripper=True, forTimeToEnd=False)
    assert bot.getGripperPos(0) == pytest.approx(0.0, abs=2e-3)  # there is nothing between the fingers
    bot.gripperOpen(ry.ArgWord._left)
    bot.wait(panda, forGripper=True, forTimeToEnd=False)
    assert bot.getGripperPos(0) == pytest.approx(0.075, abs=1e-3)
    bot.hold(floating=True, damping=False)
    assert bot.getMode() == ry.LoopMode.floating
    bot.hold(False, True)
    assert bot.getMode() == ry.LoopMode.hold
    bot.cheat_setFramePose("table", [1, 2, 3, 1, 0, 0, 0])
    assert bot.getWorld().getFrame("table").getPosition() == pytest.approx([1, 2, 3])
    bot.sound(3)
    with pytest.raises(ry.NotFound, match="driver of the hardware"):
        bot.launch_franka(1)


def test_the_same_script_gives_the_same_bits_and_its_log_gives_them_again(panda: ry.Config, tmp_path) -> None:
    def script() -> tuple[ry.BotOp, np.ndarray]:
        C = ry.Config()
        C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
        bot = ry.BotOp(C, False)
        rng = np.random.default_rng(0)
        for _ in range(5):
            bot.moveTo(bot.get_qHome() + 0.3 * rng.normal(size=7).clip(-1, 1), overwrite=True)
            bot.sync(C, 0.4)
            bot.gripperMove(0, 0.04)
        bot.home(C)
        return bot, C.getFrameState()

    (one, state), (two, other) = script(), script()
    np.testing.assert_array_equal(state, other)
    assert one.getLog() == two.getLog() and len(one.getLog()) == 11
    one.getLog().save(tmp_path / "log.txt")
    again = ry.BotOp(panda, False)
    again.replay(ry.CommandLog.load(tmp_path / "log.txt"))
    np.testing.assert_array_equal(again.get_q(), one.get_q())
    with pytest.raises(ry.ParseError, match="unknown command 'dance'"):
        ry.CommandLog.fromText("kinegraph commands 1\nperiod 0.01\n3 dance\n")


@pytest.mark.parametrize("realtime", [False, True])
def test_ctrl_c_holds_the_robot_then_raises(panda: ry.Config, realtime: bool) -> None:
    ry.params_add({"botsim/tau": 0.001})
    bot = ry.BotOp(panda, realtime=realtime)
    q = bot.get_qHome().copy()
    for _ in range(200):  # more than a minute of motion
        bot.move([q + 0.2 * np.eye(7)[0], q], [2.0])
    with interrupt_after(0.3) as interrupt, pytest.raises(KeyboardInterrupt):
        while True:
            bot.wait(panda)
            bot.moveTo(q + 0.1)
    assert time.perf_counter() - interrupt.time < 0.5
    assert bot.getMode() == ry.LoopMode.hold
    log = bot.getLog().text().splitlines()
    assert " hold " in log[-2]  # the last command
    bot.sync(panda, 0.2)
    assert np.abs(bot.get_qDot()).max() < 1e-3
    bot.close()


def test_ctrl_c_holds_a_robot_in_real_time_whatever_the_script_does(panda: ry.Config) -> None:
    bot = ry.BotOp(panda, realtime=True)
    q = bot.get_qHome().copy()
    for _ in range(200):
        bot.move([q + 0.2 * np.eye(7)[0], q], [2.0])
    with pytest.raises(KeyboardInterrupt):  # no call of BotOp runs
        signal.raise_signal(signal.SIGINT)
    end = time.monotonic() + 20.0
    while bot.getMode() != ry.LoopMode.hold and time.monotonic() < end:
        time.sleep(0.01)
    assert bot.getMode() == ry.LoopMode.hold
    bot.moveTo(q + 0.1)  # it can move again
    assert bot.getMode() == ry.LoopMode.follow
    bot.close()
    with pytest.raises(KeyboardInterrupt):  # the previous handler is restored
        signal.raise_signal(signal.SIGINT)


def test_contacts_of_the_simulated_world(panda: ry.Config) -> None:
    panda.addFrame("box").setShape(ry.ST.ssBox, [0.1, 0.1, 0.1, 0.01]).setPosition([0.0, 0.4, 0.701]).setMass(1.0)
    bot = ry.BotOp(panda)
    bot.sync(panda, 0.5)
    of_box = [contact for contact in bot.getContacts() if "box" in contact["frames"]]
    weight = sum(abs(contact["force"][2]) for contact in of_box)
    assert weight == pytest.approx(9.81, rel=0.05)
    assert set(of_box[0]["frames"]) == {"box", "table"}
    ry.params_add({"botsim/engine": "kinematic"})
    assert ry.BotOp(panda).getContacts() == []


def test_real_time_goes_on_while_the_script_does_something_else(panda: ry.Config) -> None:
    ry.params_add({"botsim/hyperSpeed": 20.0})
    bot = ry.BotOp(panda, realtime=True)
    goal = bot.get_qHome() + 0.1
    bot.moveTo(goal)
    end = time.monotonic() + 20.0
    while bot.getTimeToEnd() > 0.0 and time.monotonic() < end:
        time.sleep(0.01)
    np.testing.assert_allclose(bot.get_q(), goal, atol=1e-3)
    assert bot.sync(panda, 0.1) == 0
    np.testing.assert_allclose(panda.getJointState(), goal, atol=1e-4)


def test_a_bot_that_is_forgotten_ends_its_thread(panda: ry.Config) -> None:
    before = threading.active_count()
    bot = ry.BotOp(panda, realtime=True)
    gone = weakref.ref(bot)
    del bot
    gc.collect()
    assert gone() is None and threading.active_count() == before
    script = (
        "import kinegraph as ry; C = ry.Config(); C.addFrame('a'); C.addFrame('b', 'a', 'joint: hingeX'); "
        "bot = ry.BotOp(C, realtime=True); bot.moveTo([.1])"
    )
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert run.returncode == 0 and run.stderr == ""


def test_parameters_say_how_time_goes(panda: ry.Config) -> None:
    ry.params_add({"botsim/tau": 0.02})
    bot = ry.BotOp(panda)
    bot.get_t()
    assert bot.get_t() == pytest.approx(0.02)
    ry.params_add({"botsim/tau": "fast"})
    with pytest.raises(ry.ArgumentError, match="botsim/tau is 'fast'; expected a time in s"):
        ry.BotOp(panda)
    ry.params_add({"botsim/tau": -1.0})
    with pytest.raises(ry.ArgumentError, match="period is -1"):
        ry.BotOp(panda)


def test_a_real_robot_needs_a_driver(panda: ry.Config) -> None:
    with pytest.raises(ry.ArgumentError, match="useRealRobot needs a driver"):
        ry.BotOp(panda, True)
    ry.params_add({"bot/blockRealRobot": True})
    ry.BotOp(panda, True).moveTo(panda.getJointState() + 0.1)  # simulated


def test_what_a_robot_cannot_do_is_an_error_with_the_reason(panda: ry.Config, bot: ry.BotOp) -> None:
    q = bot.get_qHome()
    with pytest.raises(
        ry.ArgumentError,
        match=r"'l_panda_joint1' would have a velocity of 3 /s .* limit is 2.175 /s; take at least 1.37931 times",
    ):
        bot.move([q + 2.0 * np.eye(7)[0]], [1.0])
    with pytest.raises(ry.ArgumentError, match="would go to 9"):
        bot.moveTo(np.full(7, 9.0))
    with pytest.raises(ry.ArgumentError, match="the time to wait is inf s; expected a finite number"):
        bot.sync(panda, np.inf)
    with pytest.raises(ry.ArgumentError, match="points have 3 numbers; the robot has 7 joints"):
        bot.move([[0.0, 0.0, 0.0]], [1.0])
    with pytest.raises(ry.ArgumentError, match="there is no gripper 3; the robot has 1: l_gripper"):
        bot.gripperMove(3)
    with pytest.raises(ry.FrameNotFound, match="unknown"):
        bot.getImage("unknown")
    with pytest.raises(ry.FrameNotFound):
        bot.attach("l_gripper", "unknown")
    assert len(bot.getLog()) == 0


def test_cameras_see_the_world_as_it_is_now(panda: ry.Config) -> None:
    panda.addFrame("ball").setShape(ry.ST.sphere, [0.1]).setColor([1, 0, 0]).setPosition([0.0, 0.3, 0.8])
    bot = ry.BotOp(panda)
    camera = "cameraTop"
    rgb, depth = bot.getImageAndDepth(camera)
    fxycxy = bot.getCameraFxycxy(camera)
    assert rgb.shape == (*depth.shape, 3) and rgb.dtype == np.uint8 and fxycxy.shape == (4,)
    red = (rgb[:, :, 0] > 150) & (rgb[:, :, 1] < 80)
    assert red.sum() > 20
    _, _, points = bot.getImageDepthPcl(camera, globalCoordinates=True)
    np.testing.assert_allclose(points[red].mean(axis=0), [0.0, 0.3, 0.88], atol=0.03)
    _, _, local = bot.getImageDepthPcl(camera)
    np.testing.assert_allclose(local, ry.depthImage2PointCloud(depth, fxycxy))
    bot.setFramePose("ball", [0, 0, -5, 1, 0, 0, 0])
    gone = bot.getImage(camera)
    assert ((gone[:, :, 0] > 150) & (gone[:, :, 1] < 80)).sum() == 0


@pytest.fixture
def bench() -> ry.Config:
    """A Panda, and a box of .2 kg in reach on the table."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    box = C.addFrame("box").setShape(ry.ST.box, [0.05, 0.05, 0.08]).setColor([1, 0.5, 0])
    box.setPosition([-0.25, 0.1, 0.67]).setMass(0.2)
    return C


def above(C: ry.Config, height: float) -> np.ndarray:
    """Joint values with the gripper around the box, pointing down, `height` above its center."""
    goal = C.getFrame("box").getPosition() + height * np.eye(3)[2]
    answer = ry.solveIk(C, {"l_gripper": {"position": goal, "z": [0, 0, 1], "x": [1, 0, 0]}})
    assert answer.feasible, answer.message
    return answer.q


@pytest.mark.parametrize("shape", [ry.ST.box, ry.ST.ssBox])
def test_a_box_is_grasped_lifted_and_put_down_by_force_alone(bench: ry.Config, shape: ry.ST) -> None:
    bench.getFrame("box").setShape(shape, [0.05, 0.05, 0.08, 0.005][: 3 if shape == ry.ST.box else 4])
    bot = ry.BotOp(bench, False)
    bot.sync(bench, 0.2)  # the box settles
    q_grasp, q_above = above(bench, 0.0), above(bench, 0.15)
    bot.move([q_above, q_grasp], [1.5, 2.5])
    bot.wait(bench)
    start = bench.getFrame("box").getPosition()
    bot.gripperClose(ry._left)
    while not bot.gripperDone(ry._left):
        bot.sync(bench, 0.05)
    assert 0.04 < bot.getGripperPos(ry._left) < 0.055
    bot.moveTo(q_above)
    bot.wait(bench)
    lifted = bench.getFrame("box").getPosition()
    assert lifted - start == pytest.approx([0, 0, 0.15], abs=2e-3)
    bot.sync(bench, 2.0)
    assert bench.getFrame("box").getPosition() == pytest.approx(lifted, abs=1e-4)  # it does not slip
    bot.moveTo(q_grasp)
    bot.wait(bench)
    bot.gripperMove(ry._left, 0.08)
    bot.wait(bench, forTimeToEnd=False, forGripper=True)
    bot.home(bench)
    assert bench.getFrame("box").getPosition() == pytest.approx(start, abs=2e-3)


def test_the_robot_feels_what_touches_it_and_gives_way_where_it_shall(bench: ry.Config) -> None:
    bot = ry.BotOp(bench)
    assert np.abs(bot.get_tauExternal()).max() < 1e-6
    bot.floating(0.1)
    bot.sync(bench, 0.5)
    assert np.abs(bot.get_q() - bot.get_qHome()).max() < 1e-3  # it bears its weight
    bot.hold()
    bot.sync(bench, 0.1)
    J = bench.eval(ry.FS.positionRel, ["l_gripper", "table"])[1][2:]
    bot.setCompliance(J, 0.9)
    bot.moveTo(bot.get_qHome() + 0.1)
    bot.wait(bench)
    bot.sync(bench, 1.0)
    assert bot.get_q() == pytest.approx(bot.get_qHome() + 0.1, abs=5e-3)  # without contacts it arrives


def test_what_is_added_to_the_configuration_later_is_part_of_the_world(bench: ry.Config) -> None:
    bot = ry.BotOp(bench)
    bot.sync(bench)
    ball = bench.addFrame("ball").setShape(ry.ST.sphere, [0.05]).setMass(0.1).setPosition([0.3, 0.3, 1.0])
    bot.sync(bench, 1.0)
    box = bench.getFrame("box").getPosition()
    assert ball.getPosition() == pytest.approx([0.3, 0.3, box[2] + 0.05 - 0.04], abs=2e-3)  # on the table
    assert "ball" in bot.getWorld().getFrameNames()


def test_engines_are_chosen_by_parameter(bench: ry.Config) -> None:
    ry.params_add({"botsim/engine": "kinematic"})
    bot = ry.BotOp(bench)
    bench.getFrame("box").setPosition([0, 0, 3])
    bot.sync(bench, 0.5)
    assert bench.getFrame("box").getPosition() == pytest.approx([-0.25, 0.1, 0.67])  # nothing falls
    with pytest.warns(ry.KinegraphWarning, match="'box' is 0.619.* m from 'l_gripper', not between its fingers"):
        bot.gripperCloseGrasp(0, "box", width=0.05)
    bot.wait(bench, forTimeToEnd=False, forGripper=True)
    bot.moveTo(bot.get_qHome() + 0.2)
    bot.wait(bench)
    assert np.linalg.norm(bench.getFrame("box").getPosition() - [-0.25, 0.1, 0.67]) > 0.05
    ry.params_add({"botsim/engine": "bullet"})
    with pytest.raises(ry.ArgumentError, match="botsim/engine is 'bullet'; expected 'physx' or 'kinematic'"):
        ry.BotOp(bench)


def test_bots_of_several_arms_move_all_and_each_gripper(tmp_path) -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    bot = ry.BotOp(C)
    assert [gripper.name for gripper in bot.getInfo().grippers] == ["l_gripper", "r_gripper"]
    bot.gripperMove(ry._right, 0.02)
    bot.moveTo(bot.get_q() + 0.1)
    bot.wait(C)
    assert bot.getGripperPos(0) == pytest.approx(0.08, abs=1e-3) and bot.getGripperPos(1) == pytest.approx(
        0.02, abs=1e-3
    )
    assert C.getFrame("r_panda_finger_joint1").getJointState() == pytest.approx([0.01], abs=1e-3)
    bot.recordTo(tmp_path / "run.dat")
    bot.sync(C, 0.05)
    bot.recordTo("")
    assert np.loadtxt(tmp_path / "run.dat").shape == (5, 1 + 4 * 14)


def test_a_motion_that_takes_the_place_of_another_begins_where_something_holds_the_robot() -> None:
    C = ry.Config()
    C.addFrame("base").setPosition([0, 0, 1])
    slide = C.addFrame("slide", "base").setJoint(ry.JT.transX, [-1, 1]).setShape(ry.ST.sphere, [0.05])
    slide.setMass(1).setContact(1)
    C.addFrame("wall").setPosition([0.35, 0, 1]).setShape(ry.ST.box, [0.1, 1, 1]).setContact(1)
    bot = ry.BotOp(C, False)
    bot.moveTo([0.4])
    bot.sync(C, 2.0)
    assert C.getJointState() == pytest.approx([0.25], abs=2e-3)  # at the wall
    for add in (bot.moveTo, lambda q: bot.move([q], [1.0])):
        with pytest.raises(ry.RobotFault, match="from the start of the motion; call hold"):
            add([0.4])
    bot.moveTo([0.4], overwrite=True)  # as in a loop that follows a target
    assert bot.get_qDot() == pytest.approx([0.0], abs=1e-2)
    bot.sync(C, 1.0)
    bot.move([[-0.2]], [1.5], overwrite=True)
    bot.sync(C, 2.0)
    assert C.getJointState() == pytest.approx([-0.2], abs=1e-3)


def test_a_scene_without_the_robot_is_refused(panda: ry.Config, bot: ry.BotOp) -> None:
    other = ry.Config()
    other.addFrame("table")
    with pytest.raises(ry.ArgumentError, match="has none of the robot's joints; missing: l_panda_joint1, l_panda"):
        bot.sync(other)
    panda.delFrame("l_panda_joint7")
    with pytest.raises(ry.ArgumentError, match="has only a part of the robot's joints; missing: l_panda_joint7;"):
        bot.wait(panda)


def test_new_objects_with_joints_do_not_change_the_robot(panda: ry.Config, bot: ry.BotOp) -> None:
    panda.addFrame("ball", "world").setJoint(ry.JT.free).setShape(ry.ST.sphere, [0.05]).setMass(0.1)
    panda.getFrame("ball").setJointState([0.3, 0.3, 1.0, 1, 0, 0, 0])
    bot.moveTo(bot.get_qHome() + 0.1)
    bot.wait(panda)
    np.testing.assert_allclose(bot.get_q(), bot.get_qHome() + 0.1, atol=1e-3)
    assert panda.getFrame("ball").getPosition()[2] < 0.9  # it falls


def test_a_width_beyond_the_opening_is_told(panda: ry.Config, bot: ry.BotOp) -> None:
    with pytest.warns(ry.KinegraphWarning, match="0.5 m is beyond the opening of gripper 'l_gripper', 0 to 0.08 m"):
        bot.gripperMove(0, 0.5)
    bot.wait(panda, False, False, True)
    assert bot.getGripperPos(0) == pytest.approx(0.08, abs=1e-3)


def test_the_carriages_of_a_trossen_open_as_far_as_they_are_told() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("trossen/trossen.g"))
    C.selectJoints([name for name in C.getJointNames() if name.startswith("joint")])
    bot = ry.BotOp(C, False)
    for width in (0.06, 0.03):
        bot.gripperMove(0, width)
        bot.wait(C, False, False, True)
        assert bot.getGripperPos(0) == pytest.approx(width, abs=1e-3)
        distance = -C.eval(ry.FS.negDistance, ["gripper_left_0", "gripper_right_0"])[0][0]
        assert distance == pytest.approx(width, abs=1e-3)


def test_frames_that_are_placed_are_there_in_the_configuration_and_joints_are_refused(
    panda: ry.Config, bot: ry.BotOp
) -> None:
    bot.setFramePose("table", [0.1, 0.2, 0.3, 1, 0, 0, 0])
    bot.sync(panda)
    assert panda.getFrame("table").getPosition() == pytest.approx([0.1, 0.2, 0.3])
    with pytest.raises(ry.ArgumentError, match="'l_panda_joint3' is a joint of the robot, which moveTo moves"):
        bot.setFramePose("l_panda_joint3", [0, 0, 1, 1, 0, 0, 0])
    with pytest.raises(ry.ArgumentError, match="'l_palm' is fixed to 'l_panda_joint7', a joint of the robot"):
        bot.setFramePose("l_palm", [0, 0, 1, 1, 0, 0, 0])


def test_an_attached_object_is_placed_and_its_parts_are_fixed_to_the_robot(panda: ry.Config) -> None:
    panda.addFrame("ball", "world").setShape(ry.ST.sphere, [0.03]).setPosition([0.3, 0.4, 1])
    panda.addFrame("label", "ball")
    panda.getFrame("ball").setJoint(ry.JT.rigid)
    panda.attach("l_gripper", "ball")
    bot = ry.BotOp(panda, False)
    bot.setFramePose("ball", [0.3, 0.4, 1.2, 1, 0, 0, 0])
    with pytest.raises(ry.ArgumentError, match="'label' is fixed to 'l_panda_joint7', a joint of the robot"):
        bot.setFramePose("label", [0, 0, 1, 1, 0, 0, 0])


@pytest.mark.parametrize("far", [True, False])
def test_grasping_an_object_that_is_not_between_the_fingers_is_told(panda: ry.Config, far: bool) -> None:
    place = panda.getFrame("l_gripper").getPosition() + np.array([0, 0.5 if far else 0, 0])
    panda.addFrame("can", "world").setShape(ry.ST.ssBox, [0.03, 0.03, 0.03, 0.002]).setPosition(place)
    bot = ry.BotOp(panda, False)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        bot.gripperCloseGrasp(0, "can")
        bot.sync(panda, 0.1)
    distance = [
        str(w.message) for w in told if "'can' is 0.485 m from 'l_gripper', not between its fingers" in str(w.message)
    ]
    assert len(distance) == far


def test_a_robot_whose_base_falls_is_told_that_no_motor_holds_it() -> None:
    C = ry.Config()
    C.addText(
        "world: {}\nbase (world): { joint: free, q: [0 0 2 1 0 0 0], shape: box, size: [.2 .2 .2], mass: 5 }\n"
        "arm (base): { joint: hingeY, limits: [-1 1], shape: box, size: [.1 .1 .3], mass: 1 }"
    )
    bot = ry.BotOp(C, False)
    bot.moveTo([0, 0, 2, 1, 0, 0, 0, 0.5])
    with pytest.raises(ry.RobotFault, match="joint 'base:.' is .* or is it the free joint of a base or an object, wh"):
        bot.wait(C)


@pytest.mark.parametrize("change", ["attach", "delete", "place"])
def test_free_objects_are_no_joints_of_the_robot(panda: ry.Config, change: str) -> None:
    panda.addFrame("ball", "world").setShape(ry.ST.sphere, [0.03]).setPosition([0.3, 0.4, 1]).setJoint(ry.JT.free)
    bot = ry.BotOp(panda, False)
    if change == "attach":
        panda.attach("l_gripper", "ball")
    elif change == "delete":
        panda.delFrame("ball")
    else:
        bot.setFramePose("ball", [0.3, 0.4, 1.2, 1, 0, 0, 0])
    bot.sync(panda)


def test_a_robot_that_begins_outside_of_its_limits_is_told() -> None:
    C = ry.Config()
    C.addText("base: {}\nj (base): { joint: hingeZ, limits: [.5 2] }")
    C.setJointState([0.0])
    bot = ry.BotOp(C, False)
    for call in (lambda: bot.moveTo([1.0]), lambda: bot.move([[1.0]], [2.0])):
        with pytest.raises(ry.ArgumentError, match="'j' is at .*, beyond its limits 0.5 to 2; place it within them"):
            call()


def test_opening_as_far_as_a_small_gripper_opens_is_no_mistake() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda_tight.g"))
    bot = ry.BotOp(C, False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bot.gripperMove(0)
