#include "kinegraph/trajectories/path_curve.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline trajectories_internal {

int PathCurve::pieceAt(double s) const {
  const auto after = std::upper_bound(begin_.begin(), begin_.end(), s);
  return std::max(0, int(after - begin_.begin()) - 1);
}

void PathCurve::eval(int piece, double s, int order, double* out) const {
  if (piece < 0 || piece >= pieces())
    throw ValueError(cat("PathCurve: there is no piece ", piece, "; the curve has ", pieces(), " pieces"));
  const double x = s - begin_[piece];
  std::fill_n(out, dofs_, 0.);
  for (int power = is_line_[piece] ? 1 : degree_; power >= order; --power) {
    double factor = 1.;
    for (int k = 0; k < order; ++k) factor *= power - k;
    const double* c = coefficient(piece, power);
    for (int j = 0; j < dofs_; ++j) out[j] = out[j] * x + factor * c[j];
  }
}

VectorXd PathCurve::eval(double s, int order) const {
  VectorXd out(dofs_);
  eval(pieceAt(s), s, order, out.data());
  return out;
}

PathCurve::Parts PathCurve::parts() const {
  return {dofs_,
          degree_,
          length_,
          begin_,
          marks_,
          coefficients_,
          {is_line_.begin(), is_line_.end()},
          {stops_.begin(), stops_.end()}};
}

PathCurve PathCurve::fromParts(const Parts& parts) {
  const std::size_t pieces = parts.begin.size();
  if (parts.dofs < 0 || parts.degree < 1 || parts.is_line.size() != pieces || parts.stops.size() != pieces ||
      parts.coefficients.size() != pieces * std::size_t(parts.dofs) * std::size_t(parts.degree + 1))
    throw ValueError("PathCurve: the sizes of the parts do not match");
  PathCurve curve;
  curve.dofs_ = parts.dofs, curve.degree_ = parts.degree, curve.length_ = parts.length;
  curve.begin_ = parts.begin, curve.marks_ = parts.marks, curve.coefficients_ = parts.coefficients;
  curve.is_line_.assign(parts.is_line.begin(), parts.is_line.end());
  curve.stops_.assign(parts.stops.begin(), parts.stops.end());
  return curve;
}

/// Appends pieces to a curve.
class PathCurveBuilder {
 public:
  PathCurveBuilder(int dofs, int degree) {
    curve_.dofs_ = dofs;
    curve_.degree_ = degree;
  }

  double length() const { return curve_.length_; }

  /// Appends a polynomial of x, 0 <= x <= `length`; the columns of `coefficients` (n, up to degree + 1) belong to 1, x,
  /// x^2, ...
  void add(const MatrixXd& coefficients, double length, bool is_line, bool stops = false) {
    curve_.begin_.push_back(curve_.length_);
    curve_.length_ += length;
    curve_.is_line_.push_back(is_line);
    curve_.stops_.push_back(stops);
    curve_.coefficients_.resize(curve_.coefficients_.size() + std::size_t(curve_.degree_ + 1) * curve_.dofs_);
    std::copy_n(coefficients.data(), coefficients.size(), &curve_.coefficients_[curve_.at(curve_.pieces() - 1, 0)]);
  }

  void addLine(const VectorXd& from, const VectorXd& direction, double length, bool stops) {
    MatrixXd coefficients(from.size(), 2);
    coefficients << from, direction;
    add(coefficients, length, true, stops);
  }

  void mark(double s) { curve_.marks_.push_back(s); }

  PathCurve take() { return std::move(curve_); }

 private:
  PathCurve curve_;
};

namespace {

constexpr double kSamePoint = 1e-9;       // relative to the largest number in the path
constexpr double kSameDirection = 1e-10;  // largest difference of unit vectors without a corner
constexpr double kLongEnd = 3.;           // largest ratio of the first line to the second with a not-a-knot end

/// The points of a path, without those that equal their predecessor.
struct DistinctPoints {
  MatrixXd points;         ///< (n, K): one per column
  std::vector<int> place;  ///< column of each point of the path
  VectorXd chord;          ///< lengths, (K - 1,)

  DistinctPoints() = default;
  explicit DistinctPoints(const MatrixXd& path);
  int count() const { return int(points.cols()); }

  /// Returns the ends and corners only.
  DistinctPoints corners() const;

  VectorXd direction(int line) const { return (points.col(line + 1) - points.col(line)) / chord[line]; }
  void checkFinite(const MatrixXd& path) const;
};

void DistinctPoints::checkFinite(const MatrixXd& path) const {
  if (path.rows() == 0 || path.cols() == 0)
    throw ValueError(cat("retime: the path has shape (", path.rows(), ", ", path.cols(),
                         "); expected (K, n) with K >= 1 points of n >= 1 dofs"));
  for (int i = 0; i < path.rows(); ++i)
    for (int j = 0; j < path.cols(); ++j)
      if (!std::isfinite(path(i, j)))
        throw ValueError(cat("retime: path[", i, ", ", j, "] is ", path(i, j), "; expected a finite number"));
}

DistinctPoints::DistinctPoints(const MatrixXd& path) {
  checkFinite(path);
  const double same = kSamePoint * std::max(1., path.cwiseAbs().maxCoeff());
  points.resize(path.cols(), path.rows());
  chord.resize(std::max<Eigen::Index>(0, path.rows() - 1));
  int count = 0;
  for (int i = 0; i < path.rows(); ++i) {
    const double length = count ? (path.row(i).transpose() - points.col(count - 1)).norm() : 0.;
    if (count == 0 || length > same) {
      if (count) chord[count - 1] = length;
      points.col(count++) = path.row(i).transpose();
    }
    place.push_back(count - 1);
  }
  points.conservativeResize(Eigen::NoChange, count);
  chord.conservativeResize(count - 1);
}

DistinctPoints DistinctPoints::corners() const {
  DistinctPoints selected;
  selected.points.resize(points.rows(), count());
  selected.chord.resize(chord.size());
  int corners = 0;
  for (int i = 0; i < count(); ++i) {
    const bool is_end = i == 0 || i == count() - 1;
    const bool is_corner = is_end || (direction(i) - direction(i - 1)).cwiseAbs().maxCoeff() > kSameDirection;
    if (is_corner) {
      if (corners) selected.chord[corners - 1] = (points.col(i) - selected.points.col(corners - 1)).norm();
      selected.points.col(corners++) = points.col(i);
    }
    selected.place.push_back(is_corner ? corners - 1 : -corners);  // on the line from corner |place| - 1
  }
  selected.points.conservativeResize(Eigen::NoChange, corners);
  selected.chord.conservativeResize(corners - 1);
  return selected;
}

/// Returns the curve of one point.
PathCurve restingCurve(const DistinctPoints& distinct) {
  PathCurveBuilder curve(int(distinct.points.rows()), 1);
  curve.addLine(distinct.points.col(0), VectorXd::Zero(distinct.points.rows()), 0., false);
  for (std::size_t i = 0; i < distinct.place.size(); ++i) curve.mark(0.);
  return curve.take();
}

void markAll(PathCurveBuilder& curve, const DistinctPoints& distinct, const std::vector<double>& at) {
  for (const int place : distinct.place) curve.mark(at[std::size_t(place)]);
}

/// A blend of the corner P between unit directions u and v, from P - half u to P + half v. Its direction is
/// u + (v - u) w(x) with w(x) = x or, if smooth, 3 x^2 - 2 x^3, for x in [0, 1], s = 2 half x.
struct Blend {
  VectorXd corner, in, out;
  double half = 0.;
  bool smooth = false;

  VectorXd change() const { return out - in; }
  VectorXd begin() const { return corner - half * in; }

  /// Distance of the middle from the corner, relative to half |v - u|.
  static double cornerDistance(bool smooth) { return smooth ? 3. / 16. : 1. / 4.; }

  MatrixXd coefficients() const {
    const double length = 2. * half;
    MatrixXd c = MatrixXd::Zero(corner.size(), smooth ? 5 : 3);
    c.col(0) = begin();
    c.col(1) = in;
    if (smooth) {  // the integral of w is x^3 - x^4 / 2
      c.col(3) = change() / (length * length);
      c.col(4) = -change() / (2. * length * length * length);
    } else {
      c.col(2) = change() / (2. * length);
    }
    return c;
  }

  /// Returns points along the blend, with both ends.
  MatrixXd samples(int count) const {
    MatrixXd points(count, corner.size());
    for (int i = 0; i < count; ++i) {
      const double x = double(i) / (count - 1);
      const double integral = smooth ? x * x * x - x * x * x * x / 2. : x * x / 2.;
      points.row(i) = (begin() + 2. * half * (x * in + integral * change())).transpose();
    }
    return points;
  }

  /// Bounds the deviation from the chords of so many samples: |q''| h^2 / 8 with |q''| <= (1.5 or 1) |v - u| / length.
  double deviation(int count) const {
    const double step = 2. * half / (count - 1);
    return (smooth ? 1.5 : 1.) * change().cwiseAbs().maxCoeff() / (2. * half) * step * step / 8.;
  }
};

constexpr int kBlendSamples = 9;
constexpr int kSmallerBlends = 6;  // halvings before a corner stays

/// Least norm of the mean of both directions. Below it a corner nearly reverses the direction, and a motion would
/// almost stop in a smooth blend.
constexpr double kReversal = .0035;

/// Returns the largest collision-free blend within the tolerance; `half` is 0 if there is none.
Blend findBlend(const DistinctPoints& distinct, int corner, const BlendOptions& options) {
  Blend blend{distinct.points.col(corner), distinct.direction(corner - 1), distinct.direction(corner), 0.,
              options.smooth};
  const double mean = .5 * (distinct.direction(corner - 1) + distinct.direction(corner)).norm();
  if (options.smooth && mean < kReversal) return blend;
  const double change = blend.change().cwiseAbs().maxCoeff();
  const double room = std::min(distinct.chord[corner - 1], distinct.chord[corner]) / 2.;
  blend.half = std::min(room, options.tolerance / (Blend::cornerDistance(options.smooth) * change));
  if (!options.is_free || blend.half <= 0.) return blend;
  for (int i = 0; i <= kSmallerBlends; ++i, blend.half /= 2.)
    if (options.is_free(blend.samples(kBlendSamples), blend.deviation(kBlendSamples))) return blend;
  blend.half = 0.;
  return blend;
}

}  // namespace

PathCurve polyline(const MatrixXd& points) { return blendedPolyline(points, {0., false, {}}); }

std::vector<double> blendHalves(const MatrixXd& points, const BlendOptions& options) {
  if (!(options.tolerance >= 0.))
    throw ValueError(cat("retime: tolerance is ", options.tolerance, "; expected a number >= 0 (rad or m)"));
  const DistinctPoints distinct = DistinctPoints(points).corners();
  std::vector<double> halves;
  for (int corner = 1; corner + 1 < distinct.count(); ++corner)
    halves.push_back(findBlend(distinct, corner, options).half);
  return halves;
}

PathCurve blendedPolyline(const MatrixXd& points, const BlendOptions& options) {
  return blendedPolyline(points, blendHalves(points, options), options.smooth);
}

PathCurve blendedPolyline(const MatrixXd& points, const std::vector<double>& halves, bool smooth) {
  const DistinctPoints all(points);
  if (all.count() == 1) return restingCurve(all);
  const DistinctPoints distinct = all.corners();
  const int last = distinct.count() - 1;
  if (int(halves.size()) != last - 1)
    throw ValueError(cat("retime: got the lengths of ", halves.size(), " blends; the path has ", last - 1, " corners"));
  const bool is_blended = std::ranges::any_of(halves, [](double half) { return half > 0.; });
  PathCurveBuilder curve(int(points.cols()), !is_blended ? 1 : smooth ? 4 : 2);
  std::vector<double> corner_at{0.};
  double begun = 0.;  // length that the previous blend takes from the present line
  bool stops = false;
  for (int line = 0; line < last; ++line) {
    const VectorXd direction = distinct.direction(line);
    const bool is_corner = line + 1 < last;
    const double half = is_corner ? halves[std::size_t(line)] : 0.;
    const double rest = distinct.chord[line] - begun - half;
    if (rest > kSamePoint * distinct.chord[line]) {
      curve.addLine(distinct.points.col(line) + begun * direction, direction, rest, stops);
      stops = false;
    }
    corner_at.push_back(curve.length() + half);
    if (half > 0.) {
      const Blend blend{distinct.points.col(line + 1), direction, distinct.direction(line + 1), half, smooth};
      curve.add(blend.coefficients(), 2. * half, false, stops);
    }
    stops = is_corner && half == 0.;
    begun = half;
  }
  std::vector<double> marks;
  for (int i = 0; i < all.count(); ++i) {
    const int place = distinct.place[std::size_t(i)];
    const std::size_t corner = std::size_t(place < 0 ? -place - 1 : place);
    marks.push_back(corner_at[corner] +
                    (place < 0 ? (all.points.col(i) - distinct.points.col(Eigen::Index(corner))).norm() : 0.));
  }
  markAll(curve, all, marks);
  return curve.take();
}

namespace {

/// Returns the slopes of the spline at its points, (n, K), K >= 3; for K = 3 those of the parabola.
MatrixXd splineSlopes(const DistinctPoints& distinct) {
  const int last = distinct.count() - 1;
  const VectorXd& h = distinct.chord;
  MatrixXd secant(distinct.points.rows(), last), right(distinct.points.rows(), last + 1);
  for (int i = 0; i < last; ++i) secant.col(i) = distinct.direction(i);
  VectorXd below = VectorXd::Zero(last + 1), diagonal(last + 1), above = VectorXd::Zero(last + 1);
  for (int i = 1; i < last; ++i) {
    below[i] = h[i], diagonal[i] = 2. * (h[i - 1] + h[i]), above[i] = h[i - 1];
    right.col(i) = 3. * (h[i] * secant.col(i - 1) + h[i - 1] * secant.col(i));
  }
  const auto endRow = [&](int end, int line, int next) {
    if (h[line] > kLongEnd * h[next]) {  // the second derivative is zero at the end
      diagonal[end] = 2., (end == 0 ? above : below)[end] = 1.;
      right.col(end) = 3. * secant.col(line);
      return;
    }
    // The third derivative is continuous at the second point.
    const double width = h[line] + h[next];
    diagonal[end] = h[next];
    (end == 0 ? above : below)[end] = width;
    right.col(end) =
        ((h[line] + 2. * width) * h[next] * secant.col(line) + h[line] * h[line] * secant.col(next)) / width;
  };
  if (last == 2) {  // both rows would coincide: a parabola has the mean slope in between
    diagonal[0] = diagonal[2] = 1., above[0] = below[2] = 1.;
    right.col(0) = 2. * secant.col(0), right.col(2) = 2. * secant.col(1);
  } else {
    endRow(0, 0, 1);
    endRow(last, last - 1, last - 2);
  }
  for (int i = 1; i <= last; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right.col(i) -= factor * right.col(i - 1);
  }
  right.col(last) /= diagonal[last];
  for (int i = last - 1; i >= 0; --i) right.col(i) = (right.col(i) - above[i] * right.col(i + 1)) / diagonal[i];
  return right;
}

}  // namespace

PathCurve cubicSpline(const MatrixXd& points) {
  const DistinctPoints distinct(points);
  const int last = distinct.count() - 1;
  if (last == 0) return restingCurve(distinct);
  if (last == 1) return blendedPolyline(points, {0., false, {}});
  const MatrixXd slope = splineSlopes(distinct);
  PathCurveBuilder curve(int(points.cols()), 3);
  std::vector<double> marks{0.};
  MatrixXd c(points.cols(), 4);
  for (int i = 0; i < last; ++i) {
    const double h = distinct.chord[i];
    const VectorXd secant = distinct.direction(i);
    c.col(0) = distinct.points.col(i);
    c.col(1) = slope.col(i);
    c.col(2) = (3. * secant - 2. * slope.col(i) - slope.col(i + 1)) / h;
    c.col(3) = (slope.col(i) + slope.col(i + 1) - 2. * secant) / (h * h);
    curve.add(c, h, false);
    marks.push_back(curve.length());
  }
  markAll(curve, distinct, marks);
  return curve.take();
}

}  // namespace kinegraph::inline trajectories_internal
