#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/control/diff_ik.h"
#include "kinegraph/control/target_file.h"
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

/// The same along the way of a motion, whose times do not count: a spline (SplineTrajectory), a plan, a tool path. The
/// motion stops where the direction jumps. `options.corners`, `tolerance` and `is_free` are not used. With torques or
/// `tool_speed`, some 1000 `options.intervals` give shorter motions.
TimedPath retime(const Config& config, const Trajectory& motion, const RobotLimits& limits,
                 const RetimeOptions& options = {});

/// A stretch of a motion on which one limit is the nearest.
struct ActiveLimit {
  double from = 0., to = 0.;  ///< times, s
  double share = 0.;          ///< the largest share of the limit there; 1: it is reached
  std::string cause;          ///< "velocity of 'wrist_2'", "torque of 'elbow'", "speed of 'tool'"
};

/// Returns the limits that make a motion as slow as it is, in the order of time; stretches at rest are left out. Limits
/// are those of `retime`. Throws as `retime` does, and ValueError if there is no motion.
std::vector<ActiveLimit> activeLimits(const Config& config, const TimedPath& motion, const RobotLimits& limits);

/// Returns the target at a time in s: a position (3,) or a pose (7,). A TargetFile is one.
using TargetSource = std::function<VectorXd(double t)>;

struct ServoOptions {
  double seconds = 10.;      ///< s
  double dt = .005;          ///< s, of one step
  std::optional<bool> show;  ///< shows the scene at 30 Hz; by default only if users are to drag the target
  bool realtime = true;      ///< steps in real time; else as fast as possible

  /// Shows the scene and applies users' edits; empty: Config::view.
  std::function<void(Config&)> view;
  CancellationToken cancellation;  ///< checked while waiting and after each step; its exceptions end the call
};

/// Steps a DiffIk with a task at the frame `target` while that frame moves: by a file or a function, by a gamepad, or
/// by hand in the browser. Throws ValueError for times that are not positive and for invalid poses, and FrameNotFound.
void servo(DiffIk& ik, Config& config, const std::string& target, const TargetSource& source,
           const ServoOptions& options = {});
/// The same with a gamepad, which moves the target.
void servo(DiffIk& ik, Config& config, const std::string& target, Gamepad& gamepad, const ServoOptions& options = {});
/// The same with a target that users drag in the browser.
void servo(DiffIk& ik, Config& config, const std::string& target, const ServoOptions& options = {});

}  // namespace kinegraph
