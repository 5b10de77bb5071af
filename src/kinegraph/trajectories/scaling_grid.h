#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/trajectories/path_curve.h"

namespace kinegraph {

/// What a motion must keep, per dof: |dq/dt| <= velocity, |d2q/dt2| <= acceleration, |d3q/dt3| <= jerk. Positive, in
/// rad or m, s; infinity for none. No jerk is limited where `jerk` is empty.
struct MotionLimits {
  VectorXd velocity, acceleration, jerk;

  bool limitsJerk() const { return jerk.size() > 0; }
  void validate(int dofs) const;  ///< throws ValueError
};

/// Linear rows at a place of the curve, such as torques: low <= a s'' + b s'^2 + c <= high, (m,) each.
struct ScalingConstraints {
  VectorXd a, b, c;
};

/// Rows that the caller knows: `at(s, piece)` gives m of them, within limits that are the same everywhere.
struct ConstraintSource {
  VectorXd low, high;  ///< (m,); infinity for none
  std::function<ScalingConstraints(double s, int piece)> at;
  std::vector<std::string> names;  ///< of the rows, for messages
  std::string unit;
  explicit operator bool() const { return bool(at); }
};

/// How finely a law is computed, and what is called now and then meanwhile, if anything is; it may throw to end it.
struct ScalingBudget {
  int intervals = 100;
  CancellationToken cancellation;

  /// Asked at the i-th step of what takes many.
  void pause(int i) const {
    if (i % 64 == 0 && cancellation) cancellation.check();
  }
};

/// The places where a law is computed, and dq/ds between them as Bernstein polynomials.
class ScalingGrid {
 public:
  using Coefficients = Eigen::ArrayXXd;

  /// About `effort.intervals` of them, more where a motion within the limits will take longer; lines are one each unless
  /// `divide_lines`.
  ScalingGrid(const PathCurve& curve, const MotionLimits& limits, const ScalingBudget& effort, bool divide_lines);

  /// At these places, which include all knots of the curve.
  ScalingGrid(const PathCurve& curve, std::vector<double> places, const ScalingBudget& effort);

  const PathCurve& curve() const { return *curve_; }
  int intervals() const { return int(piece_.size()); }
  double place(int i) const { return places_[i]; }
  double width(int i) const { return places_[i + 1] - places_[i]; }
  int piece(int i) const { return piece_[i]; }
  /// Whether the interval is a whole line, within which a law may change its acceleration.
  bool isLine(int i) const { return whole_lines_ && curve_->isLine(piece_[i]); }
  const std::vector<double>& places() const { return places_; }

  /// Whether the direction jumps where this interval begins.
  bool stopsAt(int i) const { return stops_[i]; }

  /// Degree of dq/ds.
  int degree() const { return curve_->degree() - 1; }

  /// Bernstein coefficients of dq/ds over interval i, a column each: (dofs, degree() + 1).
  auto tangent(int i) const { return tangents_.middleCols(i * (degree() + 1), degree() + 1); }

  /// The largest s'^2 at each place that, interpolated, keeps the velocities between them, too; 0 where it must stop.
  std::vector<double> caps(const VectorXd& velocity, const ScalingBudget& effort) const;

 private:
  void expand(const ScalingBudget& effort);

  const PathCurve* curve_;
  bool whole_lines_;
  std::vector<double> places_;
  std::vector<int> piece_;
  std::vector<char> stops_;
  Coefficients tangents_;
};

}  // namespace kinegraph
