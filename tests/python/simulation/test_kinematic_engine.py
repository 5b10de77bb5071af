"""The engine `kinematic` does exactly what it is told; joints with equal limits stay in both engines."""

import numpy as np
import pytest

import kinegraph as ry


def arm() -> ry.Config:
    C = ry.Config()
    C.addText("""base: { multibody: True }
a (base): { joint: hingeZ, limits: [-3 3] }
link (a): { Q: [.2 0 0], shape: capsule, size: [.3 .03], mass: 1 }
b (link): { joint: hingeY, limits: [.3 .3], q: .3 }
tip (b): { Q: [.2 0 0], shape: sphere, size: [.03], mass: .1 }""")
    return C


def test_commanded_positions_are_reached_however_far_away() -> None:
    C = arm()
    S = ry.Simulation(C, ry.SimulationEngine.kinematic, verbose=0)
    for q in (2.5, -2.5, 0.1):
        S.step([q, 0.3], 0.01, ry.ControlMode.position)
        assert C.getJointState()[0] == q and S.get_q()[0] == q
    assert S.get_qDot()[0] == pytest.approx(260, rel=1e-6)


def test_a_state_is_restored_exactly_and_torques_move_nothing() -> None:
    C = arm()
    S = ry.Simulation(C, ry.SimulationEngine.kinematic, verbose=0)
    S.step([1.0, 0.3], 0.01, ry.ControlMode.position)
    state = S.getState()
    S.step([-1.0, 0.3], 0.01, ry.ControlMode.position)
    S.setState(state)
    assert np.array_equal(C.getJointState(), [1.0, 0.3]) and np.array_equal(S.get_qDot(), state.qDot)
    for _ in range(3):
        S.step([5.0, 0.0], 0.01, ry.ControlMode.torque)
    assert np.array_equal(C.getJointState(), [1.0, 0.3])
    assert np.array_equal(S.get_qDot(), [0.0, 0.0])
    S.step([1.2, 0.3], 0.01, ry.ControlMode.position)
    assert C.getJointState()[0] == 1.2


def test_a_joint_with_equal_limits_stays() -> None:
    C = arm()
    S = ry.Simulation(C, verbose=0)
    for _ in range(100):
        S.step([0.5, 1.0], 0.01, ry.ControlMode.position)
        assert abs(C.getJointState()[1] - 0.3) < 0.05
