#pragma once

#include "kinegraph/trajectories/time_optimal.h"

namespace kinegraph::inline trajectories_internal {

/// A jerk-limited time scaling, or the cause of its failure at s = place.
struct JerkLimitedScaling {
  TimeScaling scaling;
  ScalingFailure failure = ScalingFailure::none;
  double place = 0.;
};

/// Computes the fastest time scaling with jerk limits. `first` are the fastest speeds without jerk limits on `grid`. If
/// the motion does not start at rest, s'' is `start_acceleration` at the start.
///
/// Between two stops s'^2 =: b(s) is a quadratic spline, so that s'' is continuous; at a start or end at rest, s is a
/// cubic of time. Velocities, accelerations and constraints are linear in the coefficients of b, and the duration is
/// convex. The jerk limit
///
///     |q''' b + 3/2 q'' b' + 1/2 q' b''| <= jerk / sqrt(b)
///
/// is convex if the right side is replaced by its tangent, which lies below it. A primal-dual interior-point method
/// updates the tangent in each step; its matrices have five diagonals. Limits that the solution violates between
/// gridpoints are tightened there, several times if `budget.tight`, and the motion is slowed down by the remaining
/// violation. Then all limits hold at all times, by bounds on the Bernstein coefficients of q'^2 b, (q' b'/2 + q'' b)
/// and b (...)^2. A line between two stops has the S-curve profile. Source: Verscheure, Demeulenaere, Swevers, De
/// Schutter, Diehl, Time-optimal path tracking for robots: a convex optimization approach, 2009; Lipp, Boyd, Variations
/// and extension of the convex-concave procedure, 2016.
JerkLimitedScaling jerkLimitedScaling(const ScalingGrid& grid, const SquaredSpeeds& first, double start_acceleration,
                                      const MotionLimits& limits, const ConstraintSource& rows,
                                      const ScalingBudget& budget);

}  // namespace kinegraph::inline trajectories_internal
