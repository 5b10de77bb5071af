"""Laws of mechanics that have an answer on paper: a heavy top, and a cradle. Others are in
tests/simulation/laws_test.cpp."""

import numpy as np
import pytest

import kinegraph as ry

G = 9.81


def multiplied(a, b):
    """The product of two quaternions."""
    w, v = a[0], np.array(a[1:])
    return np.array([w * b[0] - v @ b[1:], *(w * np.array(b[1:]) + b[0] * v + np.cross(v, b[1:]))])


@pytest.mark.parametrize("lean, spin", [(0.4, 40.0), (0.9, 60.0)])
def test_a_spinning_top_precesses_as_lagrange_says(lean, spin):
    """In steady precession W about the vertical: I1 W^2 cos(lean) - I3 w3 W + m g l = 0, I1 about the tip."""
    mass, length, around, across = 0.5, 0.05, 0.0016, 0.0008
    inertia, c = across + mass * length**2, np.cos(lean)
    L = around * spin
    rate = (L - np.sqrt(L**2 - 4 * inertia * c * mass * G * length)) / (2 * inertia * c)
    C = ry.Config()
    C.addText(
        "tip: { X: [0 0 1] } top (tip): { joint: quatBall, noMotor: true } "
        f"disc (top): {{ Q: [0 0 {length}], mass: {mass}, inertia: [{across} {across} {around}] }}"
    )
    q = np.array([np.cos(lean / 2), np.sin(lean / 2), 0, 0])
    C.setJointState(q)
    S = ry.Simulation(C)
    # in its own axes: the rotation about the vertical, and the rest of the spin about the third
    turn = [0, rate * np.sin(lean), spin]
    S.pushConfigToSim(jointVelocities=multiplied(q, [0, *np.multiply(turn, 0.5)]))
    angle, before, leans = 0.0, -np.pi / 2, []
    for _ in range(200):
        S.step()
        axis = (C.getFrame("disc").getPosition() - [0, 0, 1]) / length
        leans.append(np.arccos(axis[2]))
        now = np.arctan2(axis[1], axis[0])
        angle += (now - before + np.pi) % (2 * np.pi) - np.pi
        before = now
    assert angle / 2.0 == pytest.approx(rate, rel=0.01)
    assert np.abs(np.array(leans) - lean).max() < 0.03


def test_a_cradle_keeps_its_momentum_and_the_last_ball_leaves_first():
    """Bodies bounce little here, and energy is lost; momentum is known on paper for any bounce."""
    count, length, mass, start = 5, 0.5, 0.2, 0.6
    C = ry.Config()
    for i in range(count):
        C.addText(
            f"hub{i}: {{ X: [{0.1 * i} 0 1] }} arm{i} (hub{i}): {{ joint: hingeY, noMotor: true }} "
            f"ball{i} (arm{i}): {{ Q: [0 0 {-length}], shape: sphere, size: [.05], mass: {mass}, friction: 0 }}"
        )
    C.setJointState([start, *[0.0] * (count - 1)])
    S = ry.Simulation(C)

    def momentum():
        return -mass * length * S.get_qDot().sum()

    fastest = 0.0
    while S.get_t() < 2 and S.get_q()[0] > 0.02:
        S.step([], 0.002)
        fastest = max(fastest, momentum())
    assert fastest == pytest.approx(mass * np.sqrt(2 * G * length * (1 - np.cos(start))), rel=0.02)
    while S.get_t() < 2 and S.get_qDot()[-1] > -0.01:
        S.step([], 0.002)
    for _ in range(10):
        S.step([], 0.002)
    speed = -length * S.get_qDot()
    assert momentum() == pytest.approx(fastest, rel=0.03)
    assert 0.5 * mass * speed @ speed < fastest**2 / (2 * mass)
    assert speed[-1] >= speed.max() - 1e-9
