#pragma once

#include <functional>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A curve q(s), 0 <= s <= length(), made of polynomials: where a motion goes, without saying when.
///
/// s is measured along the chords between the points that the curve was made of (Euclidean length in the units of q);
/// |dq/ds| is near 1. At the knots of a smooth curve dq/ds is continuous; where the direction jumps (`stopsAt`), only a
/// motion that stands still can stay on the curve.
class PathCurve {
 public:
  int dofs() const { return dofs_; }
  int pieces() const { return int(begin_.size()); }
  double length() const { return length_; }
  double begin(int piece) const { return begin_[piece]; }
  double end(int piece) const { return piece + 1 < pieces() ? begin_[piece + 1] : length_; }

  /// Degree of the highest polynomial: 1 for lines alone.
  int degree() const { return degree_; }

  bool isLine(int piece) const { return is_line_[piece]; }

  /// Whether the direction jumps where this piece begins.
  bool stopsAt(int piece) const { return stops_[piece]; }

  /// s of each point that the curve was made of: where it passes the point, or comes nearest to it in a blend.
  const std::vector<double>& marks() const { return marks_; }

  /// The piece that s is in; where two meet, the later one.
  int pieceAt(double s) const;

  /// Writes the derivative of this order (0: q) at s into `out`, (dofs,), by the polynomial of `piece`.
  void eval(int piece, double s, int order, double* out) const;
  VectorXd eval(double s, int order = 0) const;

  /// All that a curve is, to be stored.
  struct Parts {
    int dofs = 0, degree = 1;
    double length = 0.;
    std::vector<double> begin, marks, coefficients;
    std::vector<bool> is_line, stops;
  };
  Parts parts() const;
  static PathCurve fromParts(const Parts& parts);  ///< throws ValueError if they do not fit each other

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

/// Whether a motion may take the curve that goes along these points (M, dofs); between two of them it leaves the chord
/// by at most `deviation` in every dof.
using BlendCheck = std::function<bool(const MatrixXd& points, double deviation)>;

struct BlendOptions {
  double tolerance = .01;  ///< by which a blend may miss its corner, in every dof (rad or m)
  bool smooth = false;     ///< with a continuous second derivative, as limits of the jerk need it
  BlendCheck is_free;      ///< asked for each blend, and again for smaller ones; a corner without a free one stays
};

/// Lines from point to point, rows of `points` (K, n). The direction jumps at points that are corners. Points that equal
/// their predecessor are at the same s. Throws ValueError without points, or for numbers that are not finite.
PathCurve polyline(const MatrixXd& points);

/// Lines whose corners are rounded: parabolas, or quartics where `smooth`. No blend begins beyond the middle of a line. Where
/// `smooth`, corners that turn back to within .4 degrees stay.
PathCurve blendedPolyline(const MatrixXd& points, const BlendOptions& options = {});

/// The cubic spline through the points with continuous second derivatives; the first two pieces are one polynomial, as
/// are the last two ("not-a-knot"). Through three points a parabola, through two a line.
PathCurve cubicSpline(const MatrixXd& points);

}  // namespace kinegraph
