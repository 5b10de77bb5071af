#pragma once

#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline trajectories_internal {

/// Cause of an infeasible time parameterization.
enum class ScalingFailure {
  none,
  start_too_fast,  ///< the speed at the start exceeds the limits, or is too high to brake in time
  end_too_fast,    ///< the speed at the end exceeds the limits, or is unreachable
  cannot_move,     ///< constraints of the caller hold for no speed at some gridpoint
};

/// s'^2 on a grid: quadratic in each interval, with Bernstein coefficients at[i], middle[i], at[i + 1].
struct SquaredSpeeds {
  std::vector<double> at, middle;
  ScalingFailure failure = ScalingFailure::none;
  double place = 0.;  ///< cannot_move: s
  int row = -1;       ///< cannot_move: the caller's constraint with the largest violation at rest
};

/// Computes the fastest s'^2 within velocity and acceleration limits and constraints, from one speed ds/dt to another.
///
/// Reachability analysis in two passes over b = s'^2: the backward pass computes the range of b at each gridpoint from
/// which the rest of the path is feasible, by a two-variable linear program per interval; the forward pass takes the
/// largest b in that range. b is quadratic in an interval, so that s'' can follow the limits. Accelerations are
/// polynomials; bounds on their Bernstein coefficients hold throughout the interval. Constraints of the caller hold at
/// both ends of each interval. On lines the result is exact. Source: Pham, Pham, A new approach to time-optimal path
/// parameterization based on reachability analysis, 2018.
SquaredSpeeds fastestSpeeds(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& rows,
                            double start_speed, double end_speed, const ScalingBudget& budget);

/// Returns the time scaling of these speeds. On lines it accelerates, cruises and brakes within the interval.
TimeScaling scalingOf(const ScalingGrid& grid, const MotionLimits& limits, const SquaredSpeeds& speeds,
                      const ScalingBudget& budget);

}  // namespace kinegraph::inline trajectories_internal
