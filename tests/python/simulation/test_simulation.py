"""Simulation in Python: grasps, replays, measurements and errors."""

import warnings

import numpy as np
import pytest

import kinegraph as ry
from panda_scenes import add_box, panda

DOWN = {"z": [0, 0, 1]}


def reach(position, side):
    C = panda()
    C.addFrame("target").setPosition(position)
    result = ry.solveIk(C, {"l_gripper": {"position": "target", "y": side, **DOWN}})
    assert result.feasible
    return np.array(result.q)


def smooth(s):
    return 10 * s**3 - 15 * s**4 + 6 * s**5


def go(S, start, end, seconds):
    steps = round(seconds / 0.01)
    for i in range(steps):
        S.step(start + smooth((i + 1) / steps) * (end - start), 0.01, ry.ControlMode.position)


def in_hand(C):
    hand, box = C.getFrame("l_gripper"), C.getFrame("box")
    return hand.getRotationMatrix().T @ (box.getPosition() - hand.getPosition())


@pytest.mark.parametrize("side", [[1, 0, 0], [0, 1, 0]])  # fingers close across and along the radius of the rotation
def test_a_box_of_one_kilogram_does_not_slip_in_the_hand(side):
    start = np.array([0.0, 0.3, 0.68])
    above, at, up = (reach(start + np.array([0, 0, z]), side) for z in (0.12, 0.0, 0.2))
    turned = up + np.eye(7)[0]
    C = panda()
    add_box(C, start, 1.0)
    C.setJointState(above)
    S = ry.Simulation(C)
    go(S, above, at, 1.0)
    S.closeGripper("l_gripper", 0.0, 0.1, 30.0)
    for _ in range(100):
        S.step()
        if S.gripperIsDone("l_gripper"):
            break
    assert S.gripperIsDone("l_gripper")
    assert S.getGripperWidth("l_gripper") == pytest.approx(0.06, abs=2e-4)
    before = in_hand(C)
    go(S, at, up, 1.0)
    lifted = in_hand(C)
    assert np.linalg.norm(lifted - before) < 5e-5
    for _ in range(100):
        S.step()
    assert np.linalg.norm(in_hand(C) - lifted) < 1e-5
    lifted = in_hand(C)
    go(S, up, turned, 1.0)
    assert np.linalg.norm(in_hand(C) - lifted) < 1e-5
    go(S, turned, up, 1.0)
    go(S, up, at, 1.0)
    assert np.linalg.norm(C.getFrame("box").getPosition() - start) < 2e-4


def test_joints_follow_a_spline_to_a_tenth_of_a_milliradian():
    C = panda()
    q = C.getJointState()
    S = ry.Simulation(C)
    S.setSplineRef(q + 0.5, [1.0])
    assert S.getTimeToSplineEnd() == pytest.approx(1.0)
    spline = ry.BSpline().set(3, np.array([q, q + 0.5]), [0.0, 1.0])
    for _ in range(100):
        S.step([], 0.01, ry.ControlMode.spline)
        assert np.abs(S.get_q() - spline.eval([S.get_t()])[0]).max() < 1e-4
    S.multi_step(0.2, 0.01)
    assert S.getTimeToSplineEnd() == pytest.approx(-0.2)
    assert np.abs(S.get_q() - q - 0.5).max() < 1e-6
    assert np.allclose(C.getJointState(), S.get_q(), atol=0)


@pytest.mark.parametrize("engine", [ry.SimulationEngine.physx, ry.SimulationEngine.kinematic])
def test_velocities_and_accelerations_move_as_far_as_they_say(engine):
    C = panda()
    S = ry.Simulation(C, engine)
    start = S.get_q()[0]
    for _ in range(50):
        S.step([0.3] + [0] * 6, 0.01, ry.ControlMode.velocity)
    assert S.get_q()[0] - start == pytest.approx(0.15, abs=1e-3)
    for _ in range(20):
        S.step()
    start = S.get_q()[0]
    for _ in range(50):
        S.step([1.0] + [0] * 6, 0.01, ry.ControlMode.acceleration)
    assert S.get_q()[0] - start == pytest.approx(0.125, abs=1e-3)


@pytest.mark.parametrize("mode", [ry.ControlMode.velocity, ry.ControlMode.acceleration])
def test_a_blocked_joint_does_not_wind_up(mode):
    """A slide pushes against a wall for long; told to go back, it does at once, and nothing has jumped."""
    C = ry.Config()
    C.addText(
        "rail: { multibody: true, X: [0 0 1] } slide (rail): { joint: transX, ctrl_limits: [2 100 -1], shape: box, "
        "size: [.1 .1 .1], mass: 2 } wall: { X: [.2 0 1], shape: box, size: [.1 .5 .5] }"
    )
    S = ry.Simulation(C)
    for _ in range(300):
        S.step([0.5], 0.01, mode)
    assert S.get_q()[0] == pytest.approx(0.1, abs=1e-3)  # at the wall
    assert S.get_qRef()[0] - S.get_q()[0] == pytest.approx(0.05, abs=2e-2)
    assert abs(S.getExternalTorques()[0]) == pytest.approx(100, rel=0.02)  # as strong as its motor
    C.getFrame("wall").setPosition([5, 0, 1])
    S.pushConfigToSim()
    for _ in range(30):
        S.step([-0.5], 0.01, ry.ControlMode.velocity)
    assert S.get_q()[0] < 0.0


def test_a_far_target_is_reached_within_the_limits_of_velocity():
    C = panda()
    S = ry.Simulation(C)
    goal = C.getJointState() + np.array([1.0, 0.3, -0.5, 0.4, 0.8, 0.3, -0.6])
    fastest = np.zeros(7)
    for _ in range(150):
        S.step(goal, 0.01, ry.ControlMode.position)
        fastest = np.maximum(fastest, np.abs(S.get_qDot()))
    assert np.abs(S.get_q() - goal).max() < 1e-5
    assert (fastest <= 1.01 * np.array(C.getVelocityLimits())).all()


def test_torque_mode_accelerates_as_the_equation_of_motion_says():
    C = ry.Config()
    C.addFrame("hub").setPosition([0, 0, 1])
    C.addFrame("arm", "hub").setJoint(ry.JT.hingeZ).setMass(2.0, [0.2, 0.2, 0.3])
    S = ry.Simulation(C, options={"armature": 0.0})
    for _ in range(50):
        S.step([0.6], 0.01, ry.ControlMode.torque)
    assert S.get_qDot()[0] == pytest.approx(0.6 / 0.3 * 0.5, rel=1e-6)
    assert S.getJointTorques()[0] == pytest.approx(0.6)


def test_frames_that_are_added_later_take_part():
    C = panda()
    S = ry.Simulation(C)
    go(S, C.getJointState(), C.getJointState() + 0.1, 0.2)
    q, t = S.get_q(), S.get_t()
    add_box(C, [-0.3, 0.35, 0.9])
    S.step()
    assert [frame.name for frame in S.getFreeFrames()] == ["box"]
    assert S.get_t() == pytest.approx(t + 0.01)
    assert np.allclose(S.get_q(), q, atol=1e-6)
    for _ in range(100):
        S.step()
    assert C.getFrame("box").getPosition()[2] == pytest.approx(0.68, abs=1e-3)


def test_pushing_the_config_moves_things():
    C = panda()
    add_box(C, [-0.3, 0.35, 0.68])
    S = ry.Simulation(C)
    C.getFrame("box").setPosition([-0.3, 0.35, 2.0])
    S.step()
    assert C.getFrame("box").getPosition()[2] < 1.0  # what is set in the Config alone does not count
    C.getFrame("box").setPosition([-0.3, 0.35, 2.0])
    S.pushConfigToSim([[[1, 0, 0], [0, 0, 2]]])
    assert np.allclose(S.get_frameVelocities(), [[[1, 0, 0], [0, 0, 2]]])
    S.step()
    assert np.allclose(C.getFrame("box").getPosition(), [-0.29, 0.35, 2.0], atol=1e-3)


def test_contacts_carry_the_weight():
    C = panda()
    add_box(C, [-0.3, 0.35, 0.68], 2.0)
    S = ry.Simulation(C)
    for _ in range(50):
        S.step()
    contacts = S.getContacts()
    assert {name for contact in contacts for name in contact["frames"]} == {"box", "table"}
    down = sum(contact["force"] if contact["frames"][0] == "box" else -contact["force"] for contact in contacts)
    assert np.allclose(down, [0, 0, -2 * 9.81], atol=1e-3)
    assert all(abs(contact["normal"][2]) == pytest.approx(1, abs=1e-6) for contact in contacts)
    assert all(-1e-4 < contact["distance"] < 0 for contact in contacts)  # of rounded shapes, too


def test_a_force_sensor_weighs_the_hand_and_an_accelerometer_knows_down():
    C = panda()
    S = ry.Simulation(C)
    S.addForceTorqueSensor("l_panda_joint8")
    S.addAccelerometer("l_gripper")
    for _ in range(20):
        S.step()
    weight = (0.73 + 0.015 + 0.015) * 9.81
    assert np.linalg.norm(S.getForceTorque("l_panda_joint8")[:3]) == pytest.approx(weight, rel=1e-3)
    up = C.getFrame("l_gripper").getRotationMatrix() @ S.getAcceleration("l_gripper")
    assert np.allclose(up, [0, 0, 9.81], atol=1e-3)
    with pytest.raises(ry.ArgumentError, match="addAccelerometer"):
        S.getAcceleration("table")


def test_a_push_is_felt_by_the_joints():
    C = panda()
    S = ry.Simulation(C)
    S.applyForce("l_gripper", [0, 0, -10.0])
    for _ in range(20):
        S.step()
    J = C.eval(ry.FS.position, ["l_gripper"])[1]
    assert np.allclose(S.getExternalTorques(), J.T @ [0, 0, -10.0], atol=1e-2)
    S.clearForces()
    S.step()
    assert np.abs(S.getExternalTorques()).max() < 1e-6


def test_an_attached_object_moves_along_until_it_is_detached():
    C = panda()
    gripper = C.getFrame("l_gripper").getPosition()
    add_box(C, gripper - np.array([0, 0, 0.15]), 0.5)
    S = ry.Simulation(C)
    S.attach("l_gripper", "box")
    before = in_hand(C)
    q = C.getJointState()
    go(S, q, q + np.eye(7)[0], 1.0)
    assert np.linalg.norm(in_hand(C) - before) < 1e-4
    S.detach("l_gripper", "box")
    for _ in range(20):
        S.step()
    assert in_hand(C)[2] < before[2] - 0.1
    with pytest.raises(ry.ArgumentError, match="not attached"):
        S.detach("l_gripper", "box")


def test_a_camera_sees_falling_objects():
    C = panda()
    add_box(C, [0, 0.2, 1.2])
    S = ry.Simulation(C)
    S.setCamera("cameraTop")
    rgb, depth = S.getImageAndDepth()
    assert rgb.shape == (360, 640, 3) and depth.shape == (360, 640)
    for _ in range(30):
        S.step()
    assert not np.array_equal(S.getImageAndDepth()[1], depth)
    S.setSimulateDepthNoise(True)
    assert np.array_equal(S.getImageAndDepth()[1], S.getImageAndDepth()[1])
    assert S.depthData2pointCloud(depth, S.getFxycxy()).shape == (360, 640, 3)


def test_a_robot_without_contacts_passes_through_its_own_base():
    C = ry.Config()
    C.addFile(ry.raiPath("ur10/ur10.g"))
    bot = ry.BotOp(C)
    bot.moveTo([0.86, -2.32, 0.55, -0.78, 0.87, 0.1])
    bot.wait(C, forKeyPressed=False)
    np.testing.assert_allclose(bot.get_q(), [0.86, -2.32, 0.55, -0.78, 0.87, 0.1], atol=1e-3)


def test_what_stands_beside_the_first_joint_of_a_robot_is_no_part_of_its_base():
    C = ry.Config()
    C.addText(
        "base: {}\ntable (base): { shape: box, size: [.4 2 .1], X: [.5 0 .4] }\n"
        "j1 (base): { joint: hingeY, pre: [0 0 .8], limits: [-3 3] }\n"
        "arm (j1): { shape: box, size: [.8 .05 .05], Q: [.4 0 0], mass: 1 }\n"
        "anvil: { shape: box, size: [.2 .2 .2], X: [3 0 .1], mass: 5000 }"
    )
    bot = ry.BotOp(C)
    bot.sync(C, 0.1)
    assert max(np.linalg.norm(c["force"]) for c in bot.getContacts()) > 1e4  # the anvil presses more, on the ground
    bot.moveTo([1.2])
    with pytest.raises(
        ry.RobotFault, match=r"does an obstacle block it\? 'arm' and 'table' press on each other with \d+ N"
    ):
        bot.wait(C, forKeyPressed=False)


@pytest.mark.parametrize("height", [0, 0.5])
def test_a_floating_robot_that_begins_in_the_ground_is_told_how_far_to_raise_it(height):
    C = ry.Config()
    C.addText(
        f"world: {{}}\nbody (world): {{ joint: free, q: [0 0 {height} 1 0 0 0], shape: box, size: [.2 .2 .2], mass: 5, "
        "multibody: true }\n"
        "leg (body): { joint: hingeY, limits: [-1 1], shape: box, size: [.05 .05 .4], pre: [0 0 -.3], mass: 1 }"
    )
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        ry.Simulation(C)
    depth = [
        str(w.message) for w in told if "'leg' of a floating robot begins 0.5 m below the ground" in str(w.message)
    ]
    assert len(depth) == (height == 0)


def test_a_floating_robot_is_raised_by_as_much_as_its_base_needs():
    C = ry.Config()
    C.addText(
        "world: {}\nbody (world): { joint: free, q: [0 0 -.3 1 0 0 0], shape: box, size: [.2 .2 .4], mass: 5 }\n"
        "arm (body): { joint: hingeY, limits: [-1 1], shape: box, size: [.05 .05 .2], pre: [0 0 .3], mass: 1 }\n"
        "stone (world): { joint: free, q: [2 0 -9 1 0 0 0], shape: sphere, size: [.1], mass: 1 }"
    )
    with pytest.warns(ry.KinegraphWarning, match="'arm' .* begins 0.1 m below the ground, .* base by 0.5 m or more"):
        ry.Simulation(C)
