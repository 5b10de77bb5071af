#pragma once

#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/retime.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline planning_internal {

/// The limits of |dq/dt|, |d2q/dt2| and |d3q/dt3| per dof. Defaults: the velocities of the model, or 1 rad/s or m/s if
/// it has none, and accelerations that reach them in a quarter of a second.
MotionLimits planLimits(const Config& config, const PlanOptions& options);

/// A check that a rounded corner keeps the margins and constraints of a Steering continuously. The Steering must
/// outlive it.
BlendCheck collisionFreeBlends(Steering& steering);

/// Whether a curve keeps the margins and constraints of a Steering continuously. Checks the chords of so many `parts`
/// of each curved piece, with margins that include the deviation of the curve from its chords.
bool isFree(Steering& steering, const PathCurve& curve, int parts);

/// The timed path of a known time scaling along a curve. `waypoints` are the points at the marks of the curve. Assigns
/// each phase of the scaling to the piece at its s.
TimedPath timedBy(TimeScaling scaling, const MatrixXd& waypoints, const PathCurve& curve);

/// Concatenates two timed paths: the first ends at rest, and the second begins there at rest.
TimedPath concatenated(const TimedPath& first, const TimedPath& second);

/// The fastest motion along a path. Rounds corners if that keeps the margins and constraints, and stops at others.
TimedPath timeMotion(Steering& steering, const MatrixXd& path, const MotionLimits& limits, double blend);

}  // namespace kinegraph::inline planning_internal
