"""Setpoints at 100 Hz become a smooth motion at 1 kHz within limits."""

from __future__ import annotations

import numpy as np
import pytest

from kinegraph.robots.franka import ACCELERATION, JERK, VELOCITY
from kinegraph.robots.setpoints import Limits, Setpoints

DT, PERIOD = 1e-3, 0.01
FR3 = Limits(VELOCITY, ACCELERATION, JERK)


def sent(setpoints: Setpoints, reference, seconds: float, start: float = 0.0) -> np.ndarray:
    """Returns the sent rows. Setpoints of a reference, t -> (q, velocity, acceleration), come every 10 ms."""
    rows = []
    for cycle in range(round(seconds / DT)):
        if reference is not None and cycle % 10 == 0:
            t = start + cycle * DT + PERIOD
            setpoints.aim(*[np.array(x, float).tolist() for x in reference(t)], PERIOD)
        rows.append(list(setpoints.advance(DT)))
    return np.array(rows)


def derivatives(rows: np.ndarray) -> list[np.ndarray]:
    """Largest velocity, acceleration and jerk of the sent numbers, by differences, as the arm judges them."""
    found = []
    for _ in range(3):
        rows = np.diff(rows, axis=0) / DT
        found.append(np.abs(rows).max(axis=0))
    return found


def swing(t: float):
    """0.5 rad back and forth, from rest: at most .93 rad/s and 3.5 rad/s^2."""
    w = np.pi
    q, v, a = 0.25 * (1 - np.cos(w * t)), 0.25 * w * np.sin(w * t), 0.25 * w**2 * np.cos(w * t)
    return [q] * 7, [v] * 7, [a] * 7


def test_a_smooth_reference_is_sent_within_a_tenth_of_a_milliradian() -> None:
    setpoints = Setpoints([0.0] * 7, FR3)
    rows = sent(setpoints, swing, 2.0)
    times = DT * np.arange(1, len(rows) + 1)
    error = np.abs(rows[:, 0] - 0.25 * (1 - np.cos(np.pi * times)))
    assert error[100:].max() < 1e-4 and setpoints.fault == ""
    velocity, acceleration, jerk = derivatives(rows)
    assert (velocity < VELOCITY).all() and (acceleration < ACCELERATION).all() and (jerk < JERK).all()


@pytest.mark.parametrize("delay", [0.0015, 0.003])
def test_delays_of_the_program_do_not_disturb_the_motion(delay: float) -> None:
    rng = np.random.default_rng(0)
    setpoints, rows, k = Setpoints([0.0] * 7, FR3), [], 0
    late = rng.uniform(0.0, delay, 1000)
    for cycle in range(4000):
        if cycle * DT >= k * PERIOD + late[k]:
            setpoints.aim(*[np.array(x, float).tolist() for x in swing((k + 1) * PERIOD)], PERIOD)
            k += 1
        rows.append(list(setpoints.advance(DT)))
    assert setpoints.fault == ""
    times = DT * np.arange(1, len(rows) + 1) - 0.5 * delay  # the mean delay remains
    error = np.abs(np.array(rows)[:, 0] - 0.25 * (1 - np.cos(np.pi * times)))
    assert error[300:].max() < 1e-3, "the reference has up to .8 rad/s: 1 ms is .8 mrad"
    velocity, acceleration, jerk = derivatives(np.array(rows))
    assert (velocity < VELOCITY).all() and (acceleration < ACCELERATION).all() and (jerk < JERK).all()


def test_setpoints_at_irregular_times_cause_no_stop() -> None:
    rng = np.random.default_rng(0)
    setpoints = Setpoints([0.0] * 7, FR3)
    rows, due = [], 0.0
    for cycle in range(3000):
        if cycle * DT >= due:
            setpoints.aim(*[np.array(x, float).tolist() for x in swing(due + PERIOD)], PERIOD)
            due = cycle * DT + rng.uniform(0.004, 0.016)
        rows.append(list(setpoints.advance(DT)))
    assert setpoints.fault == ""
    velocity, acceleration, jerk = derivatives(np.array(rows))
    assert (velocity < VELOCITY).all() and (acceleration < ACCELERATION).all() and (jerk < JERK).all()


def test_a_step_is_approached_within_all_limits() -> None:
    setpoints = Setpoints([0.0] * 7, FR3)
    rows = sent(setpoints, lambda t: ([0.002] * 7, [0.0] * 7, [0.0] * 7), 0.5)
    assert rows[-1] == pytest.approx([0.002] * 7, abs=1e-6) and setpoints.fault == ""
    velocity, acceleration, jerk = derivatives(np.vstack([np.zeros((3, 7)), rows]))
    assert (velocity < VELOCITY).all() and (acceleration < ACCELERATION).all() and (jerk < JERK).all()


def test_the_arm_rests_within_limits_if_setpoints_stay_away() -> None:
    setpoints = Setpoints([0.0] * 7, FR3)
    moving = sent(setpoints, swing, 0.5)
    resting = sent(setpoints, None, 1.0)
    rows = np.vstack([moving[50:], resting])
    assert np.ptp(resting[-100:], axis=0).max() == 0 and setpoints.velocity == [0.0] * 7
    velocity, acceleration, jerk = derivatives(rows)
    assert (velocity < VELOCITY).all() and (acceleration < ACCELERATION).all() and (jerk < JERK).all()
    again = sent(setpoints, lambda t: (resting[-1], [0.0] * 7, [0.0] * 7), 0.1)  # and goes on afterwards
    assert setpoints.fault == "" and again[-1] == pytest.approx(resting[-1])


def test_setpoints_beyond_a_limit_end_in_a_stop_within_the_limits() -> None:
    def racing(t: float):
        v = min(20.0 * t, 4.0)  # joint 1 may move at 2.62 rad/s
        return [0.5 * v * t if t < 0.2 else 0.4 + 4 * (t - 0.2), *[0.0] * 6], [v, *[0.0] * 6], [0.0] * 7

    setpoints = Setpoints([0.0] * 7, FR3)
    rows = sent(setpoints, racing, 1.5)
    assert "the setpoints ask for a" in setpoints.fault and "of joint 1; the limit is" in setpoints.fault
    velocity, acceleration, jerk = derivatives(np.vstack([np.zeros((3, 7)), rows]))
    assert (velocity <= VELOCITY).all() and (acceleration <= ACCELERATION).all() and (jerk <= JERK).all()
    assert np.ptp(rows[-50:, 0]) == 0


def test_a_setpoint_that_is_no_number_stops_the_arm() -> None:
    setpoints = Setpoints([0.0] * 7, FR3)
    sent(setpoints, swing, 0.3)
    setpoints.aim([float("nan")] * 7, [0.0] * 7, [0.0] * 7, PERIOD)
    rows = sent(setpoints, None, 1.0)
    assert np.isfinite(rows).all() and "nan" in setpoints.fault
    assert setpoints.velocity == [0.0] * 7
