"""ToolControl moves tools by velocities within the limits of the joints."""

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.robots import ToolControl

PERIOD = 0.02


def so101():
    C = ry.Config()
    C.addFile(ry.raiPath("so101/so101.g"))
    C.setJointState([0, -1.0, 1.0, 0.9, 0])
    return C, C.getFrame("gripper")


def inclination(frame):
    return np.arcsin(frame.getRotationMatrix()[2, 2])


@pytest.mark.parametrize("velocity", [[0, 0.05, 0], [0.03, 0, 0.03], [0, 0, -0.05]])
def test_the_tool_moves_straight_and_keeps_its_inclination(velocity):
    C, tool = so101()
    start, inclined = tool.getPosition(), inclination(tool)
    control = ToolControl(C)
    for k in range(1, 51):
        control.step(velocity, PERIOD)
        np.testing.assert_allclose(tool.getPosition(), start + k * PERIOD * np.array(velocity), atol=1e-3)
    assert inclination(tool) == pytest.approx(inclined, abs=2e-3)


def test_the_tool_inclines_and_turns_in_place():
    C, tool = so101()
    start, inclined = tool.getPosition(), inclination(tool)
    control = ToolControl(C)
    for _ in range(50):
        control.step([0, 0, 0], PERIOD, incline=0.3)
    np.testing.assert_allclose(tool.getPosition(), start, atol=1e-3)
    assert inclination(tool) == pytest.approx(inclined + 0.3, abs=5e-3)
    for _ in range(50):
        q = control.step([0, 0, 0], PERIOD, turn=-0.5)
    assert q[4] == pytest.approx(-0.5, abs=5e-3)
    np.testing.assert_allclose(tool.getPosition(), start, atol=1e-3)


def test_a_vertical_tool_passes_and_returns():
    C, tool = so101()
    control = ToolControl(C)
    for rate in (0.5, -0.5):
        for _ in range(100):
            q = control.step([0, 0, 0], PERIOD, incline=rate)
            assert np.isfinite(q).all()
        if rate > 0:
            assert inclination(tool) == pytest.approx(np.pi / 2, abs=0.02)
    assert inclination(tool) == pytest.approx(np.pi / 2 - 1.0, abs=0.02)


def test_limits_and_collisions_hold_and_the_tool_returns_at_once():
    C, tool = so101()
    control = ToolControl(C, velocity=2.0)
    lower, upper = C.getJointLimits()
    before = C.getJointState()
    for velocity in ([0.3, 0, 0], [0, 0, -0.3], [-0.3, 0, 0]):
        for _ in range(100):
            q = control.step(velocity, PERIOD)
            assert (q >= lower - 1e-9).all() and (q <= upper + 1e-9).all()
            assert np.abs(q - before).max() <= 2.0 * PERIOD + 1e-9
            assert C.getTotalPenetration() < 1e-6
            before = q
    for _ in range(100):
        control.step([0.4, 0, 0], PERIOD)
    far = tool.getPosition()[0]
    for _ in range(25):
        control.step([-0.1, 0, 0], PERIOD)  # no need to wind back
    assert tool.getPosition()[0] < far - 0.015


def test_an_arm_with_seven_joints_moves_too():
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    tool = C.getFrame("l_gripper")
    start = tool.getPosition()
    control = ToolControl(C, "l_gripper")
    for _ in range(50):
        control.step([0, 0.1, 0], PERIOD)
    np.testing.assert_allclose(tool.getPosition(), start + np.array([0, 0.1, 0]), atol=2e-3)


def test_wrong_arguments_are_named():
    C, _ = so101()
    with pytest.raises(ry.ArgumentError, match="roll is 'wrist'; expected one of shoulder_pan"):
        ToolControl(C, roll="wrist")
    with pytest.raises(ry.FrameNotFound, match="griper"):
        ToolControl(C, "griper")
    control = ToolControl(C)
    for arguments in (([0, 0], 0.02), ([0, np.nan, 0], 0.02), ([0, 0, 0], 0.0), ([0, 0, 0], np.inf)):
        with pytest.raises(ry.ArgumentError, match=r"ToolControl\.step"):
            control.step(*arguments)
    with pytest.raises(ry.ArgumentError, match="incline nan"):
        control.step([0, 0, 0], 0.02, incline=np.nan)
