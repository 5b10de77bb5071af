#include "kinegraph/trajectories/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr int kLargestDegree = 9;

/// The nonzero basis functions at one time: `values[0 .. degree]` belong to the control points from `first` on.
struct Basis {
  std::array<double, kLargestDegree + 1> values{};
  int first = 0;
};

/// Returns part / whole, or 0 for knots that coincide: their basis function is zero everywhere.
double ratio(double part, double whole) { return whole > 0. ? part / whole : 0.; }

/// Evaluates the basis functions of a degree, or a derivative, at `t` within the knots, by the recursion over degrees;
/// its last steps are those of the derivatives.
Basis basisAt(const VectorXd& knots, int degree, double t, int derivative) {
  const auto after = std::upper_bound(knots.begin() + degree, knots.end() - degree - 1, t);
  const int span = int(after - knots.begin()) - 1;
  Basis basis{{}, span - degree};
  basis.values[0] = 1.;
  for (int r = 0; r < degree; ++r) {  // from degree r to r + 1
    const bool derive = r >= degree - derivative;
    std::array<double, kLargestDegree + 1> raised{};
    for (int j = 0; j <= r; ++j) {
      const double from = knots[span - r + j], to = knots[span + 1 + j], value = basis.values[std::size_t(j)];
      const double rising = derive ? ratio(r + 1, to - from) : ratio(t - from, to - from);
      const double falling = derive ? -rising : ratio(to - t, to - from);
      raised[std::size_t(j)] += falling * value;
      raised[std::size_t(j) + 1] += rising * value;
    }
    basis.values = raised;
  }
  if (derivative > degree) basis.values = {};
  return basis;
}

void requireTimes(const VectorXd& times, const char* call, double after) {
  double last = after;
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]))
      throw ValueError(cat(call, ": times[", i, "] is ", times[i], "; expected a finite time"));
    if (times[i] < last)
      throw ValueError(
          cat(call, ": times[", i, "] = ", times[i], " is before ", last, "; expected times that do not decrease"));
    last = times[i];
  }
}

void requireFinite(const MatrixXd& numbers, const char* call, const char* what) {
  if (!numbers.allFinite()) throw ValueError(cat(call, ": ", what, " has numbers that are not finite"));
}

MatrixXd stacked(std::initializer_list<MatrixXd> parts) {
  Eigen::Index rows = 0;
  for (const MatrixXd& part : parts) rows += part.rows();
  MatrixXd all(rows, parts.begin()->cols());
  rows = 0;
  for (const MatrixXd& part : parts) {
    all.middleRows(rows, part.rows()) = part;
    rows += part.rows();
  }
  return all;
}

/// Returns the knots strictly between the first and the last time.
VectorXd innerKnots(int degree, const VectorXd& times) {
  const Eigen::Index n = times.size();
  if (degree % 2) return times.segment(1, n - 2);
  return .5 * (times.head(n - 1) + times.tail(n - 1));
}

VectorXd repeated(double time, int count) { return VectorXd::Constant(count, time); }

}  // namespace

BSpline::BSpline(int degree, const MatrixXd& points, const VectorXd& times, const VectorXd& start_velocity,
                 const VectorXd& end_velocity) {
  set(degree, points, times, start_velocity, end_velocity);
}

BSpline& BSpline::setKnots(int degree, const VectorXd& times) {
  constexpr const char* call = "BSpline::setKnots";
  if (degree < 0 || degree > kLargestDegree)
    throw ValueError(cat(call, ": degree is ", degree, "; expected 0 to ", kLargestDegree));
  if (times.size() < 2) throw ValueError(cat(call, ": there are ", times.size(), " times; expected two or more"));
  requireTimes(times, call, -INFINITY);
  const double first = times[0], last = times[times.size() - 1];
  if (!(last > first))
    throw ValueError(cat(call, ": all times are ", first, "; expected the last one after the first"));
  degree_ = degree;
  knots_ = stacked({repeated(first, degree + 1), innerKnots(degree, times), repeated(last, degree + 1)});
  ctrl_points_.resize(0, 0);
  return *this;
}

BSpline& BSpline::setCtrlPoints(const MatrixXd& points, bool add_start_duplicates, bool add_end_duplicates,
                                const VectorXd& start_velocity, const VectorXd& end_velocity) {
  constexpr const char* call = "BSpline::setCtrlPoints";
  if (knots_.size() == 0) throw ValueError(cat(call, ": there are no knots yet; call setKnots or set first"));
  const int before = add_start_duplicates ? duplicates() : 0, behind = add_end_duplicates ? duplicates() : 0;
  const int expected = ctrlCount() - before - behind;
  if (points.rows() != expected)
    throw ValueError(cat(call, ": there are ", points.rows(), " points; expected ", expected, " for ", knots_.size(),
                         " knots of degree ", degree_, before + behind ? "" : ", duplicates included"));
  if (points.cols() == 0) throw ValueError(cat(call, ": the points have no columns; expected one per dof"));
  requireFinite(points, call, "points");
  for (const VectorXd* velocity : {&start_velocity, &end_velocity}) {
    if (velocity->size() == 0) continue;
    const char* name = velocity == &start_velocity ? "start velocity" : "end velocity";
    if (velocity->size() != points.cols())
      throw ValueError(cat(call, ": ", name, " has ", velocity->size(), " numbers; expected ", points.cols()));
    if (duplicates() == 0) throw ValueError(cat(call, ": a spline of degree ", degree_, " has no ", name, " to set"));
    requireFinite(*velocity, call, name);
  }
  ctrl_points_ =
      stacked({points.row(0).replicate(before, 1), points, points.row(points.rows() - 1).replicate(behind, 1)});
  if (start_velocity.size()) moveDuplicates(false, start_velocity);
  if (end_velocity.size()) moveDuplicates(true, end_velocity);
  return *this;
}

/// Places the duplicates of an end on the line through it with this velocity. The time of a control point is the mean
/// of its inner knots (Greville abscissa).
void BSpline::moveDuplicates(bool at_end, const VectorXd& velocity) {
  const Eigen::Index last = ctrl_points_.rows() - 1, end = at_end ? last : 0;
  for (int j = 1; j <= duplicates(); ++j) {
    const Eigen::Index i = at_end ? last - j : j;
    const double time = knots_.segment(i + 1, degree_).mean();
    ctrl_points_.row(i) = ctrl_points_.row(end) + (time - (at_end ? this->end() : start())) * velocity.transpose();
  }
}

BSpline& BSpline::set(int degree, const MatrixXd& points, const VectorXd& times, const VectorXd& start_velocity,
                      const VectorXd& end_velocity) {
  if (points.rows() != times.size())
    throw ValueError(cat("BSpline::set: there are ", points.rows(), " points and ", times.size(),
                         " times; expected one time per point"));
  BSpline made;
  made.setKnots(degree, times).setCtrlPoints(points, true, true, start_velocity, end_velocity);
  *this = std::move(made);
  return *this;
}

BSpline& BSpline::append(const MatrixXd& points, const VectorXd& times, bool inside) {
  constexpr const char* call = "BSpline::append";
  requirePoints(call);
  if (points.rows() != times.size() || points.rows() == 0)
    throw ValueError(
        cat(call, ": there are ", points.rows(), " points and ", times.size(), " times; expected one time per point"));
  if (points.cols() != dimension())
    throw ValueError(cat(call, ": the points have ", points.cols(), " numbers; expected ", dimension()));
  requireFinite(points, call, "points");
  requireTimes(times, call, 0.);
  const VectorXd absolute = stacked({repeated(end(), 1), VectorXd(times.array() + end())});
  if (!(absolute[absolute.size() - 1] > end()))
    throw ValueError(cat(call, ": the last time is 0; expected a later one"));
  if (inside) {
    appendInside(points, absolute);
    return *this;
  }
  const Eigen::Index last = ctrl_points_.rows() - 1;
  const MatrixXd ends = ctrl_points_.middleRows(last - duplicates(), duplicates() + 1);
  if ((ends.rowwise() - ctrl_points_.row(last)).isZero(0.)) {
    appendAtRest(points, absolute);
  } else {
    const double gap = (knots_[last + degree_] - knots_[last]) / degree_;
    appendInMotion(points, absolute, (ctrl_points_.row(last) - ctrl_points_.row(last - 1)) / gap);
  }
  return *this;
}

/// Replaces the duplicates of the previous end by those of the new one.
void BSpline::appendInside(const MatrixXd& points, const VectorXd& times) {
  const int m = duplicates(), count = ctrlCount(), kept = count - 1 - m;
  VectorXd around = times;
  if (degree_ % 2 == 0) around[0] = knots_[count - 1];  // the last inner knot
  const VectorXd inner = degree_ % 2 ? VectorXd(times.head(times.size() - 1)) : innerKnots(degree_, around);
  knots_ = stacked({knots_.head(count), inner, repeated(times[times.size() - 1], degree_ + 1)});
  ctrl_points_ =
      stacked({ctrl_points_.topRows(kept), ctrl_points_.bottomRows(1), points, points.bottomRows(1).replicate(m, 1)});
}

/// Keeps the previous end with its duplicates, and adds enough knots there for the spline to pass through it.
void BSpline::appendAtRest(const MatrixXd& points, const VectorXd& times) {
  const Eigen::Index kept = ctrlCount() + (degree_ + 1) / 2;
  knots_ = stacked({knots_.head(kept), innerKnots(degree_, times), repeated(times[times.size() - 1], degree_ + 1)});
  ctrl_points_ = stacked({ctrl_points_, points, points.bottomRows(1).replicate(duplicates(), 1)});
}

/// Keeps the previous spline unchanged, and joins a new one that starts at its end.
void BSpline::appendInMotion(const MatrixXd& points, const VectorXd& times, const VectorXd& velocity) {
  const BSpline next(degree_, stacked({ctrl_points_.bottomRows(1), points}), times, velocity);
  knots_ = stacked({knots_.head(knots_.size() - 1), next.knots_.tail(next.ctrlCount())});
  ctrl_points_ = stacked({ctrl_points_, next.ctrl_points_.bottomRows(next.ctrlCount() - 1)});
}

BSpline& BSpline::overwriteSmooth(const MatrixXd& points, const VectorXd& times, double time_cut) {
  constexpr const char* call = "BSpline::overwriteSmooth";
  requirePoints(call);
  if (points.cols() != dimension())
    throw ValueError(cat(call, ": the points have ", points.cols(), " numbers; expected ", dimension()));
  const VectorXd position = eval(time_cut), velocity = eval(time_cut, 1);
  return set(degree_, stacked({position.transpose(), points}),
             stacked({repeated(time_cut, 1), VectorXd(times.array() + time_cut)}),
             duplicates() ? velocity : VectorXd());
}

void BSpline::requirePoints(const char* call) const {
  if (isEmpty()) throw ValueError(cat(call, ": the spline has no control points yet; call set or setCtrlPoints first"));
}

MatrixXd BSpline::eval(const VectorXd& times, int derivative) const {
  requirePoints("BSpline::eval");
  MatrixXd values(times.size(), dimension());
  for (Eigen::Index i = 0; i < times.size(); ++i) values.row(i) = eval(times[i], derivative).transpose();
  return values;
}

VectorXd BSpline::eval(double time, int derivative) const {
  constexpr const char* call = "BSpline::eval";
  requirePoints(call);
  if (derivative < 0) throw ValueError(cat(call, ": derivative is ", derivative, "; expected 0 or more"));
  if (std::isnan(time)) throw ValueError(cat(call, ": a time is NaN"));
  if (time < start() || time >= end()) {
    if (derivative > 0) return VectorXd::Zero(dimension());
    return ctrl_points_.row(time < start() ? 0 : ctrl_points_.rows() - 1).transpose();
  }
  const Basis basis = basisAt(knots_, degree_, time, derivative);
  return ctrl_points_.middleRows(basis.first, degree_ + 1).transpose() *
         Eigen::Map<const VectorXd>(basis.values.data(), degree_ + 1);
}

MatrixXd BSpline::eval3(double time) const {
  requirePoints("BSpline::eval3");
  MatrixXd values(3, dimension());
  for (int k = 0; k < 3; ++k) values.row(k) = eval(time, k).transpose();
  return values;
}

MatrixXd BSpline::getBmatrix(const VectorXd& times, bool start_duplicates, bool end_duplicates, int derivative) const {
  constexpr const char* call = "BSpline::getBmatrix";
  if (knots_.size() == 0) throw ValueError(cat(call, ": there are no knots yet; call setKnots or set first"));
  if (derivative < 0) throw ValueError(cat(call, ": derivative is ", derivative, "; expected 0 or more"));
  MatrixXd B = MatrixXd::Zero(times.size(), ctrlCount());
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    if (std::isnan(times[i])) throw ValueError(cat(call, ": times[", i, "] is NaN"));
    if (times[i] < start() || times[i] >= end()) {
      if (derivative == 0) B(i, times[i] < start() ? 0 : B.cols() - 1) = 1.;
      continue;
    }
    const Basis basis = basisAt(knots_, degree_, times[i], derivative);
    B.row(i).segment(basis.first, degree_ + 1) = Eigen::Map<const VectorXd>(basis.values.data(), degree_ + 1);
  }
  const int m = duplicates(), before = start_duplicates ? m : 0, behind = end_duplicates ? m : 0;
  MatrixXd folded = B.middleCols(before, B.cols() - before - behind);
  if (before) folded.col(0) += B.leftCols(before).rowwise().sum();
  if (behind) folded.col(folded.cols() - 1) += B.rightCols(behind).rowwise().sum();
  return folded;
}

double BSpline::start() const {
  if (knots_.size() == 0) throw ValueError("BSpline: there are no knots yet; call setKnots or set first");
  return knots_[0];
}

double BSpline::end() const {
  if (knots_.size() == 0) throw ValueError("BSpline: there are no knots yet; call setKnots or set first");
  return knots_[knots_.size() - 1];
}

BSpline BSpline::fromParts(int degree, const VectorXd& knots, const MatrixXd& ctrl_points) {
  constexpr const char* call = "BSpline";
  if (degree < 0 || degree > kLargestDegree)
    throw ValueError(cat(call, ": degree is ", degree, "; expected 0 to ", kLargestDegree));
  if (knots.size() > 0) requireTimes(knots, call, -INFINITY);
  const Eigen::Index count = knots.size() - degree - 1;
  if (knots.size() > 0 && count < degree + 1)
    throw ValueError(cat(call, ": there are ", knots.size(), " knots; expected at least ", 2 * degree + 2));
  if (ctrl_points.rows() > 0 && ctrl_points.rows() != count)
    throw ValueError(
        cat(call, ": there are ", ctrl_points.rows(), " control points; expected ", std::max<Eigen::Index>(count, 0)));
  requireFinite(ctrl_points, call, "ctrl_points");
  BSpline spline;
  spline.degree_ = degree;
  spline.knots_ = knots;
  spline.ctrl_points_ = ctrl_points;
  return spline;
}

}  // namespace kinegraph
