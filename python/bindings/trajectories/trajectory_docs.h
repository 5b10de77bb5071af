#pragma once

/// The docstrings of bind_trajectory.cpp, and of SplineTrajectory.
namespace kinegraph::python::docs::trajectory {

inline constexpr char Trajectory[] = R"(A timed motion q(t), 0 <= t <= duration. BotOp.follow executes any of them.

Retimed paths (TimedPath), motion plans, SplineTrajectory and SampledTrajectory are trajectories. A subclass in Python
has a property duration (s) and a method eval(t) that returns q, velocity and acceleration, shape (n,) each, for a
number t:

    class Swing(ry.Trajectory):
        duration = 2.0

        def eval(self, t):
            return [np.sin(np.pi * t)], [np.pi * np.cos(np.pi * t)], [-(np.pi**2) * np.sin(np.pi * t)])";

inline constexpr char make[] = R"(For subclasses, which call it in their __init__.)";

inline constexpr char duration[] = R"(How long the motion takes, s; 0 if there is none.)";

inline constexpr char eval[] = R"(Returns the state of the motion at a time, or at several times.

Args:
    t: Time since the start, s; a number or shape (T,). Times outside of 0 to duration are clamped.
Returns:
    q, velocity, acceleration: shape (n,) each, or (T, n); rad or m, and s.
Raises:
    ArgumentError: There is no motion, or t is NaN.)";

inline constexpr char sample[] = R"(Returns the states at equal steps of time, from 0 to duration, both included.

Args:
    rate: The least number of samples per second, Hz.
Returns:
    times, q, velocity, acceleration: shapes (T,) in s, and (T, n) each.
Raises:
    ArgumentError: There is no motion, or rate is not positive.)";

inline constexpr char writeCsv[] = R"(Writes samples to a text file, separated by commas.

A line of names comes first, then a row per sample: the time, q, velocities and accelerations. Numbers are exact.

Args:
    file: Path of the file.
    rate: The least number of samples per second, Hz.
    names: Names of the dofs, such as those of config.getJointNames() that q has; None: q0, q1, ...
Raises:
    ArgumentError: There is no motion, rate is not positive, or names has another length.
    FileError: The file cannot be written.)";

inline constexpr char read[] = R"(Reads a file of Trajectory.writeCsv.

Args:
    file: Path of the file.
Returns:
    The trajectory through its rows.
Raises:
    FileError: The file cannot be read.
    ParseError: A row has other content; the message has line and column.)";

inline constexpr char SplineTrajectory[] =
    R"(A BSpline as a Trajectory: t = 0 is the spline's first knot, and the trajectory ends with the spline.)";

inline constexpr char SplineTrajectory_make[] = R"(Copies a spline.

Args:
    spline: A BSpline with control points.
Raises:
    ArgumentError: The spline has no control points.)";

inline constexpr char SampledTrajectory[] = R"(A trajectory through given states, such as a recorded motion.

At a sample's time it returns that state to the bit; between two samples, each dof is the quintic polynomial with their
positions, velocities and accelerations.)";

inline constexpr char SampledTrajectory_make[] = R"(Copies the samples.

Args:
    times: Shape (T,), s, increasing from 0.
    q: Shape (T, n), rad or m.
    velocity: Shape (T, n), rad/s or m/s.
    acceleration: Shape (T, n), rad/s^2 or m/s^2.
Raises:
    ArgumentError: Sizes differ, times do not increase from 0, or numbers are not finite.)";

}  // namespace kinegraph::python::docs::trajectory
