"""First notebooks with a robot, step by step: motions, following a target, grasping, cameras."""

from __future__ import annotations

import numpy as np
import pytest

import kinegraph
from robotic import ry


@pytest.fixture
def C() -> ry.Config:
    scene = ry.Config()
    scene.addFile(ry.raiPath("../rai-robotModels/scenarios/pandaSingle.g"))
    return scene


def reach(C: ry.Config, position: np.ndarray, home: np.ndarray) -> tuple[np.ndarray, ry.SolverReturn]:
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], home)
    komo.addObjective([], ry.FS.position, ["l_gripper"], ry.OT.eq, [1e1], position)
    ret = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    return komo.getPath()[0], ret


def test_the_first_motions_of_a_robot(C: ry.Config) -> None:
    bot = ry.BotOp(C, False)
    bot.home(C)
    q_home = bot.get_qHome()
    q1 = q_home.copy()
    q1[1] += 0.2
    bot.moveTo(q1)
    steps = 0
    while bot.getTimeToEnd() > 0:
        bot.sync(C, 0.1)
        steps += 1
    assert steps == pytest.approx(np.sqrt(6 * 0.2) / 0.1, abs=1.0)
    assert C.getJointState() == pytest.approx(q1, abs=1e-4)
    bot.move([q1, q_home, q1, q_home], [1.0, 2.0, 3.0, 4.0])  # there and back and there and back
    bot.wait(C)
    assert C.getJointState() == pytest.approx(q_home, abs=1e-4)
    bot.hold(floating=True, damping=False)
    bot.wait(C, forKeyPressed=True, forTimeToEnd=False)  # no viewer is open
    bot.hold(floating=False, damping=True)
    bot.home(C)
    del bot


def test_a_robot_that_follows_a_target(C: ry.Config) -> None:
    bot = ry.BotOp(C, False)
    target = C.addFrame("target", "table").setShape(ry.ST.marker, [0.1]).setRelativePosition([0.0, 0.3, 0.3])
    position = target.getPosition()
    center = position.copy()
    rng = np.random.default_rng(0)
    for _ in range(30):
        bot.sync(C, 0.1)  # C has the state of the robot
        position = center + 0.98 * (position - center) + 0.02 * rng.normal(size=3)
        target.setPosition(position)
        q, ret = reach(C, position, bot.get_qHome())
        assert ret.feasible
        bot.moveTo(q, timeCost=5.0, overwrite=True)
    bot.wait(C)
    assert C.getFrame("l_gripper").getPosition() == pytest.approx(position, abs=2e-3)


def test_grippers_as_they_are_written_in_scripts_of_all_years(C: ry.Config) -> None:
    bot = ry.BotOp(C, useRealRobot=False)
    for close in (
        lambda: bot.gripperClose(ry._left),
        lambda: bot.gripperClose(ry.ArgWord._left, width=0.0, speed=0.1),
        lambda: bot.gripperMove(ry._left, width=0.02),
    ):
        close()
        while not bot.gripperDone(ry._left):
            bot.sync(C, 0.1)
        assert bot.getGripperPos(ry._left) < 0.021
        bot.gripperMove(ry._left)
        bot.wait(C, forTimeToEnd=False, forGripper=True)
        assert bot.getGripperPos(ry._left) == pytest.approx(0.075, abs=1e-3)


def test_what_the_camera_of_a_robot_sees_becomes_part_of_the_scene(C: ry.Config) -> None:
    C.addFrame("box").setShape(ry.ST.ssBox, [0.12, 0.12, 0.12, 0.005]).setColor([1, 0.5, 0]).setPosition(
        [0.06, 0.35, 0.7]
    )
    bot = ry.BotOp(C, False)
    bot.sync(C, 0.1)
    rgb, depth = bot.getImageAndDepth("cameraTop")
    points = ry.depthImage2PointCloud(depth, bot.getCameraFxycxy("cameraTop"))
    assert points.shape == (*depth.shape, 3)
    cloud = C.addFrame("pcl", "cameraTop")
    cloud.setPointCloud(points, rgb)  # images, as the camera gives them
    np.testing.assert_array_equal(cloud.getMeshPoints(), points.reshape(-1, 3))
    np.testing.assert_array_equal(cloud.getMeshColors()[:, :3], rgb.reshape(-1, 3))
    cloud.setColor([1.0, 0.0, 0.0])
    orange = (rgb[:, :, 0] > 120) & (rgb[:, :, 2] < 80)
    camera = C.getFrame("cameraTop")
    seen = camera.getPosition() + points[orange] @ camera.getRotationMatrix().T
    assert seen.mean(axis=0) == pytest.approx([0.06, 0.35, 0.76], abs=0.03)
    assert cloud.getShapeType() == ry.ST.pointCloud


def test_a_bot_without_a_gripper_says_so() -> None:
    arm = ry.Config()
    arm.addFrame("base")
    arm.addFrame("joint", "base", "joint: hingeX, mass: 1")
    bot = ry.BotOp(arm, False)
    with pytest.raises(ry.ArgumentError, match="there is no gripper 0; the robot has none"):
        bot.gripperMove(ry._left)
    with pytest.raises(ry.FrameNotFound, match="unknown"):
        bot.getImage("unknown")


@pytest.mark.filterwarnings("ignore:BotOp. joint")  # fast motions lag
def test_a_motion_that_is_too_fast_keeps_its_time_in_simulation_with_a_warning(C: ry.Config) -> None:
    """Notebooks lift an object in .1 s; the reference's simulation has no limits."""
    bot = ry.BotOp(C, False)
    q = bot.get_q()
    up, down = q + 0.4, q
    with pytest.warns(ry.KinegraphWarning, match=r"its limit is .* /s; take at least .*; the simulated robot moves"):
        bot.move([up, down], [0.1, 0.3])
    assert bot.getTimeToEnd() == pytest.approx(0.3)
    bot.sync(C, 0.5 * bot.getTimeToEnd())
    assert abs(bot.get_qDot()).max() > 0.3  # it moves there
    bot.wait(C)
    bot.sync(C, 2.0)  # the robot comes after its reference
    np.testing.assert_allclose(bot.get_q(), down, atol=2e-3)
    with pytest.raises(ry.ArgumentError, match="its limits are"):  # no duration helps
        bot.move([q + 10.0], [1.0])
    with pytest.raises(ry.ArgumentError, match="take at least"):
        kinegraph.BotOp(C, False).move([up, down], [0.1, 0.3])


@pytest.mark.filterwarnings("ignore:BotOp. joint")  # fast motions lag
def test_a_grasp_planned_by_the_helper_and_lifted_fast(C: ry.Config) -> None:
    """The helper has the calls of the problem."""
    C.addFrame("obj").setPosition([-0.25, 0.1, 0.7]).setShape(ry.ST.ssBox, [0.04, 0.2, 0.1, 0.005]).setMass(0.1)
    C.getFrame("obj").setContact(1)
    ways = ry.KOMO_ManipulationHelper()
    with pytest.raises(ry.Error, match="addObjective needs a configuration and a timing; call setConfig"):
        ways.addObjective([2.0], ry.FS.position, ["l_gripper"], ry.OT.eq)
    ways.setup_sequence(C, 2, 1e-2, 1e-1, False, False, False)
    ways.grasp_box(1.0, "l_gripper", "obj", "l_palm", "x", 0.02)
    ways.addObjective([2.0], ry.FS.position, ["l_gripper"], ry.OT.eq, scale=[0, 0, 1e0], target=[0, 0, 1])
    assert ways.solve(0).feasible
    np.testing.assert_array_equal(ways.getPath(), ways.komo.getPath())
    with pytest.raises(AttributeError, match="has no 'getPaht'"):
        ways.getPaht()
    paths = []
    for phase in range(2):
        motion = ways.sub_motion(phase)
        if phase == 0:
            motion.approach([0.8, 1.0], "l_gripper")
        assert motion.solve(0).feasible
        paths.append(motion.path)
    bot = ry.BotOp(C, useRealRobot=False)
    with pytest.warns(ry.KinegraphWarning, match="times as long"):
        bot.move(paths[0], [1.0])
    bot.wait(C, forKeyPressed=False, forTimeToEnd=True)
    bot.gripperMove(ry.ArgWord._left, 0.0, 1.5)
    bot.wait(C, forKeyPressed=False, forTimeToEnd=False, forGripper=True)
    bot.move(paths[1], [0.1])  # the limits are not kept after the first warning
    bot.wait(C, forKeyPressed=False, forTimeToEnd=True)
    bot.sync(C, 1.0)  # the robot comes after its reference
    assert C.getFrame("obj").getPosition()[2] > 0.9  # it is held
