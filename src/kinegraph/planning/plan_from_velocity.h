#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline planning_internal {

/// Known continuations of a running motion: curves that begin at the robot's configuration in the direction of its
/// velocity.
struct KnownCurves {
  struct Timed {
    PathCurve curve;
    TimeScaling scaling;  ///< that continues the motion within the limits; no phases: there is none
  };
  std::vector<Timed> to_goal;      ///< to the goal
  std::vector<PathCurve> to_rest;  ///< long enough to come to rest, the shortest first
  std::vector<Timed> to_stop;      ///< to the next stop of the running motion
};

/// The limits of a motion that begins with options.start_velocity and start_acceleration: enlarged to these if they
/// exceed the limits by rounding only.
MotionLimits limitsFromStart(MotionLimits limits, const PlanOptions& options);

/// planMotion among static obstacles from options.start_velocity; from rest if that is empty or zero.
///
/// A known curve to the goal is used if it is collision-free. Otherwise the motion first continues straight, far enough
/// to come to rest, or farther. A path from the end of that line is planned; the corner between them is rounded, or the
/// motion stops there. The fastest of these motions counts. Known curves on which the robot comes to rest are tried
/// last.
///
/// With options.start_acceleration, an acceleration ramp leads to the line.
MotionPlan planFromVelocity(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                            const VectorXd& start, const CancellationToken& cancellation,
                            const KnownCurves& known = {});

}  // namespace kinegraph::inline planning_internal
