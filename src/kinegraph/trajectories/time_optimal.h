#pragma once

#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

/// Why a curve cannot be followed as asked.
enum class ScalingFailure {
  none,
  start_too_fast,  ///< the speed at the start is above what the limits allow, or cannot be braked in time
  end_too_fast,    ///< the speed at the end is above what the limits allow, or cannot be reached
  cannot_move,     ///< rows of the caller hold for no speed at some place
};

/// s'^2 along a grid: quadratic in each interval, in Bernstein form at[i], middle[i], at[i + 1].
struct SquaredSpeeds {
  std::vector<double> at, middle;
  ScalingFailure failure = ScalingFailure::none;
  double place = 0.;  ///< cannot_move: s
  int row = -1;       ///< cannot_move: of the caller's rows, the one that is missed by most when standing still
};

/// The fastest law that keeps velocity, acceleration and rows, from one speed ds/dt to another.
///
/// Two passes over b = s'^2 (Pham, Pham: A new approach to time-optimal path parameterization based on reachability
/// analysis, 2018): backwards, what b may be at each place so that the rest of the way is possible, by a linear program
/// in the plane for each interval; forwards, the largest b that it leaves. b is quadratic in an interval, so that s'' may
/// follow the limits there; every acceleration is a polynomial, and keeps what its Bernstein coefficients keep. Rows of
/// the caller hold at both ends of each interval. Where all is linear (lines), the answer is exact.
SquaredSpeeds fastestSpeeds(const ScalingGrid& grid, const MotionLimits& limits, const ConstraintSource& rows,
                            double start_speed, double end_speed, const ScalingBudget& effort);

/// The law of these speeds. On lines it accelerates, cruises and brakes within the interval.
TimeScaling scalingOf(const ScalingGrid& grid, const MotionLimits& limits, const SquaredSpeeds& speeds,
                      const ScalingBudget& effort);

}  // namespace kinegraph
