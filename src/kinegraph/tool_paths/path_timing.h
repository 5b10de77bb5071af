#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/tool_paths/joint_curve.h"
#include "kinegraph/tool_paths/plan_tool_path.h"

namespace kinegraph::inline tool_paths_internal {

/// The timing of a tool along its curve: the way of the tool is one more dof, whose speed, acceleration and jerk are
/// limited, too. The arguments must outlive it.
class PathTiming {
 public:
  /// `limits` are those of the joints.
  PathTiming(ToolKinematics& tool, const ToolCurve& curve, const JointCurve& joints, const MotionLimits& limits,
             const ToolPathOptions& options, const CancellationToken& cancellation);

  /// The limits of the joints, and of the tool's way.
  const MotionLimits& limits() const { return limits_; }

  /// The speed asked at s, m/s.
  double speedAt(double s) const;

  /// The largest ds/dt with which the motion may start within the limits at that place.
  double fastestStart() const;

  /// The fastest motion that starts with ds/dt = `start` and d2s/dt2 = 0. It ends at rest.
  TimedPath timed(double start = 0.) const;

  /// An estimate of the duration, s, without regard to jerks; infinity if there is no timing.
  double estimatedDuration() const;

 private:
  TimedPath timedOn(int intervals, double start) const;

  const ToolCurve& curve_;
  const ToolPathOptions& options_;
  const CancellationToken& cancellation_;
  const bool has_speeds_;       ///< of its own
  MotionLimits limits_, all_;   ///< the latter also of the speed share if the path has several speeds
  const PathCurve way_, path_;  ///< with the tool's way; the latter with the speed share, too
  MatrixXd points_;
};

}  // namespace kinegraph::inline tool_paths_internal
