#pragma once

#include "kinegraph/trajectories/time_optimal.h"

namespace kinegraph {

/// What a law with limits of the jerk came to.
struct JerkLimitedScaling {
  TimeScaling scaling;
  ScalingFailure failure = ScalingFailure::none;
  double place = 0.;
};

/// The fastest law that keeps the limits of the jerk, too. `first` are the fastest speeds without them, on `grid`. Where it
/// does not begin at rest, s'' is `start_acceleration` there.
///
/// Between two stops s'^2 =: b(s) is a quadratic spline, so that s'' is continuous; where the motion begins or ends at
/// rest, s is a cubic of time. Velocities, accelerations and rows are linear in its coefficients, the time taken is convex
/// in them, and so is what the jerk leaves,
///
///     |q''' b + 3/2 q'' b' + 1/2 q' b''| <= jerk / sqrt(b),
///
/// once the right side is replaced by its tangent, which lies below it. A primal-dual interior-point method takes a step
/// from tangent to tangent; its matrices have five diagonals. Limits that the answer exceeds between the places are then
/// tightened there, and what is left is taken off all speeds; so all limits hold all along, which Bernstein coefficients
/// of q' ^2 b, (q' b'/2 + q'' b) and b (...)^2 prove. A line between two stops has the seven phases that are known.
/// Source: Verscheure, Demeulenaere, Swevers, De Schutter, Diehl, Time-optimal path tracking for robots: a convex
/// optimization approach, 2009; Lipp, Boyd, Variations and extension of the convex-concave procedure, 2016.
JerkLimitedScaling jerkLimitedScaling(const ScalingGrid& grid, const SquaredSpeeds& first, double start_acceleration,
                                      const MotionLimits& limits, const ConstraintSource& rows,
                                      const ScalingBudget& effort);

}  // namespace kinegraph
