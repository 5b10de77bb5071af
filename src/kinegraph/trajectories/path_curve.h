#pragma once

#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline trajectories_internal {

/// A geometric path q(s), 0 <= s <= length(), as a piecewise polynomial.
///
/// s is the Euclidean length, in units of q, along the chords between the points of the path; |dq/ds| is near 1. At the
/// knots of a smooth curve dq/ds is continuous. If the direction jumps (`stopsAt`), a motion has to stop there.
class PathCurve {
 public:
  int dofs() const { return dofs_; }
  int pieces() const { return int(begin_.size()); }
  double length() const { return length_; }
  double begin(int piece) const { return begin_[piece]; }
  double end(int piece) const { return piece + 1 < pieces() ? begin_[piece + 1] : length_; }

  /// Highest degree of the polynomials: 1 for lines only.
  int degree() const { return degree_; }

  bool isLine(int piece) const { return is_line_[piece]; }

  /// Tells whether the direction jumps at the start of this piece.
  bool stopsAt(int piece) const { return stops_[piece]; }

  /// s of each point of the path: of the curve's passage, or of the nearest point of a blend.
  const std::vector<double>& marks() const { return marks_; }

  /// Returns the piece that contains s; at a knot, the later one.
  int pieceAt(double s) const;

  /// Writes the derivative of this order (0: q) at s into `out`, (dofs,), by the polynomial of `piece`.
  void eval(int piece, double s, int order, double* out) const;
  VectorXd eval(double s, int order = 0) const;

  /// All members of a curve, for storage.
  struct Parts {
    int dofs = 0, degree = 1;
    double length = 0.;
    std::vector<double> begin{}, marks{}, coefficients{};
    std::vector<bool> is_line{}, stops{};
  };
  Parts parts() const;
  static PathCurve fromParts(const Parts& parts);  ///< throws ValueError if their sizes do not match

  /// Coefficient of (s - begin(piece))^power, (dofs,).
  const double* coefficient(int piece, int power) const { return &coefficients_[at(piece, power)]; }

 private:
  friend class PathCurveBuilder;
  std::size_t at(int piece, int power) const { return (std::size_t(piece) * (degree_ + 1) + power) * dofs_; }

  int dofs_ = 0, degree_ = 1;
  double length_ = 0.;
  std::vector<double> begin_, marks_, coefficients_;
  std::vector<char> is_line_, stops_;
};

struct BlendOptions {
  double tolerance = .01;  ///< largest distance of a blend from its corner, in every dof (rad or m)
  bool smooth = false;     ///< with a continuous second derivative, for jerk limits
  BlendCheck is_free;      ///< checks each blend, then smaller ones; a corner without a free blend stays
};

/// Returns the lines between consecutive points (K, n). The direction jumps at corners. Points that equal their
/// predecessor have the same s. Throws ValueError without points, and for numbers that are not finite.
PathCurve polyline(const MatrixXd& points);

/// Returns lines with blended corners: parabolas, or quartics if `smooth`. No blend reaches beyond the middle of a
/// line. If `smooth`, corners that reverse the direction to within .4 degrees stay.
PathCurve blendedPolyline(const MatrixXd& points, const BlendOptions& options = {});

/// Returns half the length of each of these blends, one per corner; 0 for a corner that stays. A corner is a point at
/// which the direction changes.
std::vector<double> blendHalves(const MatrixXd& points, const BlendOptions& options = {});

/// Returns lines with blends of given lengths, as from `blendHalves`. Throws ValueError for another number of them.
PathCurve blendedPolyline(const MatrixXd& points, const std::vector<double>& halves, bool smooth);

/// Returns the cubic spline through the points with continuous second derivatives and not-a-knot ends: the first two
/// pieces are one polynomial, and so are the last two. Three points give a parabola, two a line.
///
/// A polynomial that is fixed by a short line would run away along a line that is many times as long. At an end whose
/// line is more than three times as long as the next one, the second derivative is zero instead. Then no slope dq/ds
/// exceeds 20 in any dof, and the curve stays near its points for any spacing.
PathCurve cubicSpline(const MatrixXd& points);

}  // namespace kinegraph::inline trajectories_internal
