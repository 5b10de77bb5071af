#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline trajectories_internal {

/// The number of intervals of a time scaling, and a token to cancel its computation.
struct ScalingBudget {
  int intervals = 100;
  CancellationToken cancellation;
  bool tight = false;  ///< tightens limits again, for less slow-down (retimeTightly)

  /// Checks for cancellation in every 64th step i of a loop.
  void poll(int i) const {
    if (i % 64 == 0 && cancellation) cancellation.check();
  }
};

/// The gridpoints of a time scaling, with dq/ds between them as Bernstein polynomials.
class ScalingGrid {
 public:
  using Coefficients = Eigen::ArrayXXd;

  /// Divides a curve into about `budget.intervals` intervals, shorter ones on slow parts of the curve. A line is one
  /// interval unless `divide_lines` is set.
  ScalingGrid(const PathCurve& curve, const MotionLimits& limits, const ScalingBudget& budget, bool divide_lines);

  /// Takes the gridpoints, which include all knots of the curve.
  ScalingGrid(const PathCurve& curve, std::vector<double> places, const ScalingBudget& budget);

  const PathCurve& curve() const { return *curve_; }
  int intervals() const { return int(piece_.size()); }
  double place(int i) const { return places_[i]; }
  double width(int i) const { return places_[i + 1] - places_[i]; }
  int piece(int i) const { return piece_[i]; }
  /// Tells whether the interval is a whole line; its acceleration may change within the interval.
  bool isLine(int i) const { return whole_lines_ && curve_->isLine(piece_[i]); }
  const std::vector<double>& places() const { return places_; }

  /// Tells whether the direction jumps at the start of this interval.
  bool stopsAt(int i) const { return stops_[i]; }

  /// Degree of dq/ds.
  int degree() const { return curve_->degree() - 1; }

  /// Bernstein coefficients of dq/ds over interval i, one per column: (dofs, degree() + 1).
  auto tangent(int i) const { return tangents_.middleCols(i * (degree() + 1), degree() + 1); }

  /// Returns the largest s'^2 at each gridpoint whose linear interpolation keeps the velocity limits; 0 at stops.
  std::vector<double> caps(const VectorXd& velocity, const ScalingBudget& budget) const;

 private:
  void expand(const ScalingBudget& budget);

  const PathCurve* curve_;
  bool whole_lines_;
  std::vector<double> places_;
  std::vector<int> piece_;
  std::vector<char> stops_;
  Coefficients tangents_;
};

}  // namespace kinegraph::inline trajectories_internal
