#pragma once

#include <optional>

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline robot_internal {

/// The largest absolute velocity and acceleration of each dof of a motion, and their times (s); (n,) each.
struct MotionPeaks {
  VectorXd velocity, velocity_time;
  VectorXd acceleration, acceleration_time;

  /// Returns the factor on the motion's duration that keeps these limits; 1 if it keeps them already.
  double slowdown(const VectorXd& velocity_limits, const VectorXd& acceleration_limits) const;
};

/// Computes the exact peaks of a spline of degree 3 or less from a time on.
MotionPeaks peaksOf(const BSpline& motion, double from);

/// Describes the first limit of position, velocity or acceleration that a motion violates from a time on: joint, time,
/// and the factor on its duration that would do. Empty if it keeps all of them. Velocities and accelerations may exceed
/// their limits by rounding, positions by 1e-3 (rad or m).
std::optional<std::string> violatedLimit(const BSpline& motion, double from, const RobotInfo& robot);

/// The same for the states of control periods. Differences of q and velocity between two periods count, too, so that
/// `limitCommand` leaves such a motion unchanged.
std::optional<std::string> violatedLimit(const MotionStates& motion, const RobotInfo& robot);

/// Describes the first joint whose effort exceeds its limit, from the masses of `model` by inverse dynamics: at times
/// `period` apart, at most a thousand of them. Empty if none does, and if masses or limits are unknown. Sets q of
/// `model`.
std::optional<std::string> violatedEffort(const BSpline& motion, double from, double period, const RobotInfo& robot,
                                          Config& model);

/// The same at the times of given states, at most about a thousand of them.
std::optional<std::string> violatedEffort(const MotionStates& motion, const RobotInfo& robot, Config& model);

}  // namespace kinegraph::inline robot_internal
