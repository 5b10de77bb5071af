"""Points of JointTrajectory messages, and the trajectories through them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._core import BSpline, SampledTrajectory, SplineTrajectory, Trajectory
from ..errors import ArgumentError
from .node import needed


def throughPoints(
    times: Any, q: Any, velocity: Any = None, acceleration: Any = None, *, start_velocity: Any = None
) -> Trajectory:
    """Returns the trajectory through points, as joint_trajectory_controller interpolates them.

    With velocities and accelerations, it is a quintic spline; with velocities, a cubic one. With positions alone, it is
    the cubic spline with continuous accelerations that rests at both ends, or begins with a given velocity.

    Args:
        times: Shape (T,), s, increasing from 0; T >= 2.
        q: Shape (T, n), rad or m.
        velocity: Shape (T, n), or None.
        acceleration: Shape (T, n), or None; only with velocities.
        start_velocity: Shape (n,), for positions alone; None: 0.
    Returns:
        A trajectory for `bot.follow`, which goes through all points at their times.
    Raises:
        ArgumentError: Sizes differ, times do not increase from 0, or a number is not finite.
    """
    t = np.asarray(times, float)
    points = np.asarray(q, float)
    given = [points] + [np.asarray(x, float) for x in (velocity, acceleration) if x is not None]
    if t.ndim != 1 or len(t) < 2 or points.ndim != 2 or any(x.shape != (len(t), points.shape[1]) for x in given):
        shapes = ", ".join(str(x.shape) for x in given)
        raise ArgumentError(
            f"throughPoints: times have shape {t.shape}, states {shapes}; expected (T,) and (T, n) with T >= 2"
        )
    if not all(np.isfinite(x).all() for x in [t, *given]):
        raise ArgumentError("throughPoints: a number is not finite")
    if t[0] != 0 or (np.diff(t) <= 0).any():
        raise ArgumentError("throughPoints: times do not increase from 0")
    if acceleration is not None and velocity is None:
        raise ArgumentError("throughPoints: accelerations need velocities")
    if acceleration is not None:
        return SampledTrajectory(t, *given)
    if velocity is not None:
        return _cubic(t, points, given[1])
    first = np.zeros(points.shape[1]) if start_velocity is None else np.asarray(start_velocity, float)
    if first.shape != points.shape[1:] or not np.isfinite(first).all():
        raise ArgumentError(f"throughPoints: start_velocity is {first}; expected {points.shape[1]} finite numbers")
    return _cubic(t, points, _smoothVelocities(t, points, first))


def _smoothVelocities(t: np.ndarray, q: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Returns the velocities for which accelerations are continuous, with a given first one, at rest at the end."""
    h = np.diff(t)
    matrix, right = np.eye(len(t)), np.zeros_like(q)
    right[0] = first
    slope = np.diff(q, axis=0) / h[:, None]
    for i in range(1, len(t) - 1):
        matrix[i, i - 1 : i + 2] = h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1]
        right[i] = 3.0 * (h[i] * slope[i - 1] + h[i - 1] * slope[i])
    return np.asarray(np.linalg.solve(matrix, right))


def _cubic(t: np.ndarray, q: np.ndarray, v: np.ndarray) -> Trajectory:
    """Returns the cubic polynomials between states, as a B-spline with double inner knots."""
    h = np.diff(t)[:, None]
    inner = np.empty((2 * len(h), q.shape[1]))
    inner[0::2] = q[:-1] + v[:-1] * h / 3.0
    inner[1::2] = q[1:] - v[1:] * h / 3.0
    knots = np.concatenate([t[:1], np.repeat(t[1:-1], 2), t[-1:]])
    spline = BSpline().setKnots(3, knots).setCtrlPoints(np.vstack([q[:1], inner, q[-1:]]), False, False)
    return SplineTrajectory(spline)


def jointTrajectory(motion: Trajectory, joints: Sequence[str], rate: float = 100.0) -> Any:
    """Converts a motion to a JointTrajectory message, for any joint_trajectory_controller.

    Args:
        motion: A plan, or another Trajectory.
        joints: Names of the joints in ROS, in the order of q: C.getJointNames().
        rate: Points per second, Hz.
    Returns:
        A trajectory_msgs.msg.JointTrajectory with positions, velocities and accelerations, from time 0 to the end.
    Raises:
        ArgumentError: The number of names is not that of q, or the rate is invalid.
        NotFound: A package of ROS 2 is missing.
    """
    messages, builtin = needed("trajectory_msgs.msg"), needed("builtin_interfaces.msg")
    times, *states = motion.sample(rate)
    if states[0].shape[1] != len(joints):
        raise ArgumentError(
            f"jointTrajectory: there are {len(joints)} names of joints; expected {states[0].shape[1]}, as the motion has"
        )
    message = messages.JointTrajectory(joint_names=list(joints))
    for t, q, velocity, acceleration in zip(times, *states, strict=True):
        whole, rest = divmod(round(float(t) * 1e9), 10**9)
        message.points.append(
            messages.JointTrajectoryPoint(
                positions=q.tolist(),
                velocities=velocity.tolist(),
                accelerations=acceleration.tolist(),
                time_from_start=builtin.Duration(sec=whole, nanosec=rest),
            )
        )
    return message
