#pragma once

#include <optional>

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

/// The largest velocity and acceleration of each number of a motion, without sign, and when.
struct MotionPeaks {
  VectorXd velocity, velocity_time;
  VectorXd acceleration, acceleration_time;

  /// By which factor the motion must take longer so that it is within these limits; 1 if it is.
  double slowdown(const VectorXd& velocity_limits, const VectorXd& acceleration_limits) const;
};

/// Those of a spline of degree 3 or less from a time on, exactly.
MotionPeaks peaksOf(const BSpline& motion, double from);

/// Which limit a motion does not respect from a time on, in a sentence with the joint, the time and what would do; none
/// if it respects all. Positions and velocities may be beyond by rounding, positions by 1e-3.
std::optional<std::string> brokenLimit(const BSpline& motion, double from, const RobotInfo& robot);

/// The same for efforts, by the masses of `model`, at times `period` apart, a thousand at most: which joint would need more
/// than it can.
/// Nothing is known, and none is told, where masses or limits are not.
std::optional<std::string> brokenEffort(const BSpline& motion, double from, double period, const RobotInfo& robot,
                                        Config& model);

}  // namespace kinegraph
