#pragma once

#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

/// Limits of a robot's motions.
struct RobotLimits {
  MotionLimits
      motion;  ///< velocity empty: the model's (getVelocityLimits); acceleration empty: unlimited, with torque only
  bool torque = false;  ///< respects the model's effort limits (getEffortLimits), by its masses and gravity
};

/// Returns the fastest motion of a robot along a path of its dofs q, rows of `path` (K, n): see `retime`
/// (trajectories/retime.h). With `torque`, the torques of inverse dynamics are within limits at the ends of all
/// intervals, and `options.rows` is ignored. Throws ValueError for a path with another number of dofs, or if the model
/// lacks the limits.
TimedPath retime(const Config& config, const MatrixXd& path, const RobotLimits& limits,
                 const RetimeOptions& options = {});

}  // namespace kinegraph
