#pragma once

#include <map>
#include <string>

#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

/// Limits of a robot's motions.
struct RobotLimits {
  MotionLimits
      motion;  ///< velocity empty: the model's (getVelocityLimits); acceleration empty: unlimited, with torque only
  bool torque = false;  ///< respects the model's effort limits (getEffortLimits), by its masses and gravity
  std::map<std::string, double> tool_speed = {};  ///< largest speed of the origins of frames in the world, m/s
};

/// The fastest motion of a robot along a path in its dofs q, rows of `path` (K, n): see `retime`
/// (trajectories/retime.h). With `torque`, the generalized forces of inverse dynamics hold at the ends of all
/// intervals, and so do speeds of frames with `tool_speed`; `options.constraints` is not used then. Throws ValueError
/// if the path has another number of dofs, or the model does not have the limits asked for; FrameNotFound.
TimedPath retime(const Config& config, const MatrixXd& path, const RobotLimits& limits,
                 const RetimeOptions& options = {});

}  // namespace kinegraph
