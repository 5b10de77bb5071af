"""The SO-101 has the kinematics of its public description, and its five joints reach positions with a direction."""

import numpy as np
import pytest

import kinegraph as ry

# xyz (m) and rpy (rad) of each joint's frame in the one before, and of the frame of the gripper: so101_new_calib.urdf.
JOINTS = {
    "shoulder_pan": ([0.0388353, 0, 0.0624], [np.pi, 0, -np.pi]),
    "shoulder_lift": ([-0.0303992, -0.0182778, -0.0542], [-np.pi / 2, -np.pi / 2, 0]),
    "elbow_flex": ([-0.11257, -0.028, 0], [0, 0, np.pi / 2]),
    "wrist_flex": ([-0.1349, 0.0052, 0], [0, 0, -np.pi / 2]),
    "wrist_roll": ([0, -0.0611, 0.0181], [np.pi / 2, 0.0486795, np.pi]),
}
TOOL = ([-0.0079, -0.000218, -0.0981274], [0, np.pi, 0])
LIMITS = [[-1.91986, -1.74533, -1.69, -1.65806, -2.74385], [1.91986, 1.74533, 1.69, 1.65806, 2.84121]]


def transform(xyz, rpy):
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = z @ y @ x, xyz
    return X


def loaded():
    C = ry.Config()
    C.addFile(ry.raiPath("so101/so101.g"))
    return C


def test_poses_are_those_of_the_description():
    C = loaded()
    assert C.getJointNames() == list(JOINTS)
    np.testing.assert_allclose(C.getJointLimits(), LIMITS)
    for q in np.random.default_rng(0).uniform(*LIMITS, (50, 5)):
        C.setJointState(q)
        X = np.eye(4)
        for origin, angle in zip(JOINTS.values(), q, strict=True):
            X = X @ transform(*origin) @ transform([0, 0, 0], [0, 0, angle])
        np.testing.assert_allclose(C.getFrame("gripper_frame").getTransform(), X @ transform(*TOOL), atol=1e-7)


def test_positions_with_a_direction_are_reached():
    C = loaded()
    rng = np.random.default_rng(1)
    for q in rng.uniform(*LIMITS, (100, 5)):
        C.setJointState(q)
        gripper = C.getFrame("gripper")
        position, back = gripper.getPosition(), gripper.getRotationMatrix()[:, 2]
        C.setJointState(np.zeros(5))
        result = ry.solveIk(C, {"gripper": {"position": position, "z": back}}, collisions=False)
        assert result.feasible
        C.setJointState(result.q)
        np.testing.assert_allclose(gripper.getPosition(), position, atol=1e-4)
        np.testing.assert_allclose(gripper.getRotationMatrix()[:, 2], back, atol=1e-3)


@pytest.mark.parametrize("degrees", [60, 90])
def test_things_on_the_table_are_reached_from_above(degrees):
    C = loaded()
    for angle in (-1.0, 0.0, 0.7):
        outward = np.array([np.cos(angle), np.sin(angle), 0.0])
        back = np.sin(np.radians(degrees)) * np.array([0, 0, 1]) - np.cos(np.radians(degrees)) * outward
        position = [0.0388, 0, 0.03] + 0.2 * outward
        assert ry.solveIk(C, {"gripper": {"position": position, "z": back}}).feasible


def test_the_jaw_opens_by_what_its_tip_can():
    C = loaded()
    bot = ry.BotOp(C)
    (gripper,) = bot.getInfo().grippers
    assert gripper.name == "gripper"
    assert gripper.min_width < 2e-3 and 0.08 < gripper.max_width < 0.1
    bot.gripperMove(0, 0.06)
    bot.wait(C, forTimeToEnd=False, forGripper=True)
    assert bot.getGripperPos(0) == pytest.approx(0.06, abs=3e-3)


def test_a_motion_is_planned_and_executed():
    C = loaded()
    C.setJointState([0, -1.0, 1.0, 0.9, 0])
    start = C.getFrame("gripper").getPosition()
    goal = {"gripper": {"position": start + np.array([0, 0.12, -0.03]), "z": [0, 0, 1]}}
    plan = ry.planMotion(C, goal, margin=0.005, velocity=[2.0] * 5, acceleration=[8.0] * 5)
    assert plan.feasible
    bot = ry.BotOp(C)
    bot.follow(plan)
    bot.wait(C)
    np.testing.assert_allclose(C.getJointState(), plan.path[-1], atol=0.02)
