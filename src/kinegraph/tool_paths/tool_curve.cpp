#include "kinegraph/tool_paths/tool_curve.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/curve_primitives.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr double kCornerSlope = .01;    // largest jump of the direction that is no corner
constexpr double kCornerRotation = .5;  // rad/m, likewise of the rotation

/// Knots by the length of the curve, with values and derivatives.
struct HermiteSection {
  std::vector<double> s;
  MatrixXd y, slope;
};

HermiteSection sectionOf(const CurvePrimitive& primitive, double start) {
  const std::vector<double> t = primitive.allKnots();
  const double range = primitive.to - primitive.from, e = 1e-5 * range;
  const auto slope = [&](double at) -> VectorXd {
    VectorXd d = (primitive.at(at + e) - primitive.at(at - e)) / (2. * e);
    const double speed = d.head<3>().norm();
    if (speed > .5) d /= speed;
    return d;
  };
  const auto speed = [&](double at) {
    const double v = (primitive.at(at + e) - primitive.at(at - e)).head<3>().norm() / (2. * e);
    return v > .5 ? v : 1.;
  };
  HermiteSection section;
  section.y.resize(9, Eigen::Index(t.size()));
  section.slope.resize(9, Eigen::Index(t.size()));
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (k == 0) {
      section.s.push_back(start);
    } else {  // Gauss, three points
      const double middle = .5 * (t[k] + t[k - 1]), half = .5 * (t[k] - t[k - 1]), u = std::sqrt(.6) * half;
      const double way = (5. * speed(middle - u) + 8. * speed(middle) + 5. * speed(middle + u)) / 9.;
      section.s.push_back(section.s.back() + half * way);
    }
    section.y.col(Eigen::Index(k)) = primitive.at(t[k]);
    section.slope.col(Eigen::Index(k)) = slope(t[k]);
  }
  return section;
}

bool isCorner(const VectorXd& before, const VectorXd& after) {
  const VectorXd jump = after - before;
  return jump.head<3>().norm() > kCornerSlope || jump.segment<3>(3).norm() > kCornerRotation ||
         jump.tail<3>().norm() > kCornerRotation;
}

}  // namespace

Pose ToolTarget::pose() const {
  Matrix3d R;
  R << x, z.cross(x), z;
  return {p, Quaterniond(R)};
}

ToolCurve::ToolCurve(const ToolPath& path, const Pose& present, const ToolTolerance& tolerance, double approach,
                     double retract) {
  Pose start = present;
  if (path.first()) start = {path.first()->p, path.first()->rotation.value_or(present.q)};
  const Vector3d axis = Vector3d::Unit(path.freeAxis() < 0 ? 2 : path.freeAxis());
  PrimitiveList list({start.p + approach * (start.q * axis), start.q}, tolerance);
  if (approach != 0.) list.lineTo(start);
  list.startPath();
  const std::size_t before = list.all.size();
  for (std::size_t k = 0; k < path.elements().size(); ++k) list.add(path.elements()[k], k);
  if (list.all.size() == before) throw ValueError(cat("ToolPath: the path of '", path.frame(), "' has no length"));
  const std::size_t after = list.all.size();
  if (retract != 0.) {
    const Pose end{list.now().p + retract * (list.now().q * axis), list.now().q};
    list.add({ToolPathElement::Kind::line, {end}}, after);
  }
  VectorXd slope;
  for (std::size_t k = 0; k < list.all.size(); ++k) {
    if (k == before) approach_end_ = pieces_.length;
    if (k == after) retract_start_ = pieces_.length;
    const HermiteSection section = sectionOf(list.all[k], pieces_.length);
    if (speeds_.empty() || speeds_.back().speed != list.all[k].speed)
      speeds_.push_back({pieces_.length, list.all[k].speed});
    const bool corner = k > 0 && isCorner(slope, section.slope.col(0));
    pieces_.addHermite(section.s, section.y, section.slope, corner);
    slope = section.slope.rightCols(1);
    if (!(pieces_.length <= kLongest))
      throw ValueError(
          cat("ToolPath: the path of '", path.frame(), "' is longer than ", kLongest, " m; lengths are in meters"));
  }
  if (after == list.all.size()) retract_start_ = pieces_.length;
  fit_error_ = list.fit_error;
  warnings_ = std::move(list.warnings);
}

std::vector<double> ToolCurve::corners() const {
  std::vector<double> corners;
  for (int piece = 1; piece < pieces_.pieces(); ++piece)
    if (pieces_.is_corner[std::size_t(piece)]) corners.push_back(pieces_.begin[std::size_t(piece)]);
  return corners;
}

double ToolCurve::speedAt(double s) const {
  const auto after = std::upper_bound(speeds_.begin(), speeds_.end(), s,
                                      [](double place, const SpeedSection& section) { return place < section.begin; });
  return after == speeds_.begin() ? 0. : (after - 1)->speed;
}

std::vector<double> ToolCurve::speedChanges() const {
  std::vector<double> places;
  for (std::size_t k = 1; k < speeds_.size(); ++k) places.push_back(speeds_[k].begin);
  return places;
}

double ToolCurve::largestSpeed(double otherwise) const {
  double largest = 0.;
  for (const SpeedSection& section : speeds_)
    largest = std::max(largest, section.speed > 0. ? section.speed : otherwise);
  return largest;
}

ToolCurve ToolCurve::reversed() const {
  ToolCurve back;
  for (std::size_t k = speeds_.size(); k-- > 0;)
    back.speeds_.push_back({length() - (k + 1 < speeds_.size() ? speeds_[k + 1].begin : length()), speeds_[k].speed});
  back.fit_error_ = fit_error_;
  back.approach_end_ = length() - retract_start_, back.retract_start_ = length() - approach_end_;
  MatrixXd y(9, 2), slope(9, 2);
  bool corner = false;
  for (int piece = pieces_.pieces() - 1; piece >= 0; --piece) {
    const double begin = pieces_.begin[std::size_t(piece)], end = pieces_.end(piece);
    y << pieces_.eval(piece, end), pieces_.eval(piece, begin);
    slope << -pieces_.eval(piece, end, 1), -pieces_.eval(piece, begin, 1);
    back.pieces_.addHermite({length() - end, length() - begin}, y, slope, corner);
    corner = pieces_.is_corner[std::size_t(piece)];
  }
  return back;
}

}  // namespace kinegraph::inline tool_paths_internal
