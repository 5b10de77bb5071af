#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What is known of where a robot in motion may go on: curves that begin where it is, in the direction of its velocity.
struct KnownCurves {
  struct Timed {
    PathCurve curve;
    TimeScaling scaling;  ///< that goes on as it moves now and keeps the limits; no phases: none
  };
  std::vector<Timed> to_goal;      ///< all the way
  std::vector<PathCurve> to_rest;  ///< as far as it takes to come to rest, the shortest first
  std::vector<Timed> to_stop;      ///< to where it would stand still next
};

/// Limits that a motion keeps which begins with options.start_velocity and start_acceleration: where rounding has made these
/// larger than the limits, they are the limits.
MotionLimits limitsFromStart(MotionLimits limits, const PlanOptions& options);

/// planMotion among obstacles that stand still, from options.start_velocity: from rest if that is empty or zero.
///
/// A known curve to the goal is taken if it is free. Otherwise the motion first goes straight on, as far as it takes to
/// come to rest, and farther; a way from the end of that line is planned, and the corner between them is rounded, or
/// the motion stops there. The fastest of these counts. Known curves to where it is at rest come last.
///
/// With options.start_acceleration a curve leads to the line, on which each dof's acceleration goes to zero at a constant jerk.
MotionPlan planFromVelocity(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                            const VectorXd& start, const CancellationToken& cancellation,
                            const KnownCurves& known = {});

}  // namespace kinegraph
