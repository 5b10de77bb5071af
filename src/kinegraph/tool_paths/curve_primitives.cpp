#include "kinegraph/tool_paths/curve_primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/tool_paths/tool_curve.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr double kSamePlace = 1e-7;    // m or rad, between two poses
constexpr double kCornerOfRows = .35;  // rad between rows
constexpr double kAlwaysCorner = 1.;   // rad between rows
constexpr double kSharper = 2.5;       // than at the rows before and after
constexpr double kCornerReach = 8.;    // of the tolerance: nearer rows, which noise may displace, show no corner
constexpr int kFirstStride = 16;       // rows between the first knots
constexpr int kMaxFitRounds = 20;
constexpr double kLargestBlendShare = .49;  // of the shorter element
constexpr double kMostKnots = 3e5;          // of an element

VectorXd columnsOf(const Pose& X) {
  const Matrix3d R = X.q.toRotationMatrix();
  VectorXd y(9);
  y << X.p, R.col(0), R.col(2);
  return y;
}

double angleBetween(const Quaterniond& a, const Quaterniond& b) { return a.angularDistance(b); }

/// Spacing of Hermite knots (h^4 / 384 of the fourth derivative) for a curvature and a rotation rate, 1/m.

double hermiteSpacing(double curvature, double rotation_rate) {
  const double position =
      curvature > 0. ? std::pow(384. * PrimitiveList::kHermiteError / std::pow(curvature, 3.), .25) : 1e9;
  const double rotation = rotation_rate > 0. ? std::pow(384. * PrimitiveList::kHermiteError, .25) / rotation_rate : 1e9;
  return std::min(position, rotation);
}

/// Which rows are corners of a polyline. `step` is the way to the row before, and `spot` tells whether the tool only
/// rotates there. Angles are those between the rows at a distance of at least `reach` on both sides, and the sharpest
/// row within `reach` is the corner.
std::vector<char> cornersOfRows(const std::vector<VectorXd>& rows, const std::vector<double>& step,
                                const std::vector<char>& spot, double reach) {
  constexpr double kSpotCorner = 10.;  // sharper than any angle
  const std::size_t count = rows.size();
  std::vector<double> angle(count, 0.);
  std::vector<std::size_t> before(count, 0), behind(count, count - 1);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    double back = step[i], on = step[i + 1];
    for (before[i] = i - 1; before[i] > 0 && back < reach; --before[i]) back += step[before[i]];
    for (behind[i] = i + 1; behind[i] + 1 < count && on < reach; ++behind[i]) on += step[behind[i] + 1];
    if (spot[i] || spot[i + 1]) {
      angle[i] = spot[i] != spot[i + 1] ? kSpotCorner : 0.;
      continue;
    }
    if (std::min(back, on) < reach) continue;  // next to an end
    const Vector3d a = (rows[i] - rows[before[i]]).head<3>(), b = (rows[behind[i]] - rows[i]).head<3>();
    angle[i] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  std::vector<char> is_corner(count, false);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const auto from = angle.begin() + std::ptrdiff_t(before[i]) + 1, to = angle.begin() + std::ptrdiff_t(behind[i]);
    const bool is_sharpest = angle[i] == kSpotCorner || std::max_element(from, to) - angle.begin() == std::ptrdiff_t(i);
    const double beside = std::max(angle[before[i]], angle[behind[i]]);
    is_corner[i] =
        is_sharpest && (angle[i] > kAlwaysCorner || (angle[i] > kCornerOfRows && angle[i] > kSharper * beside));
  }
  return is_corner;
}

/// Positions by length with a rotation at a constant rate.

CurvePrimitive ofPositions(const Pose& from, const Quaterniond& to, double length, double curvature,
                           std::function<Vector3d(double)> position) {
  Eigen::AngleAxisd turn(from.q.conjugate() * to);
  if (turn.angle() > std::numbers::pi) turn.angle() -= 2. * std::numbers::pi;
  CurvePrimitive primitive;
  primitive.to = length;
  primitive.spacing = std::min(length, hermiteSpacing(curvature, std::abs(turn.angle()) / length));
  primitive.may_blend = true;
  primitive.at = [from, turn, length, position = std::move(position)](double t) {
    const Eigen::AngleAxisd part(turn.angle() * t / length, turn.axis());
    return columnsOf({position(t), from.q * Quaterniond(part)});
  };
  return primitive;
}

/// A quintic with the position and two derivatives of both primitives at its ends; the rotation changes smoothly.

CurvePrimitive blendOf(const CurvePrimitive& a, const CurvePrimitive& b, double radius) {
  const double e = 1e-4 * radius, T = 2. * radius;
  const auto derivatives = [e](const CurvePrimitive& of, double t) {
    const VectorXd before = of.at(t - e), at = of.at(t), after = of.at(t + e);
    return std::array<Vector3d, 3>{at.head<3>(), (after - before).head<3>() / (2. * e),
                                   (after - 2. * at + before).head<3>() / (e * e)};
  };
  const double start = a.to - radius, end = b.from + radius;
  const auto [p0, v0, a0] = derivatives(a, start);
  const auto [p1, v1, a1] = derivatives(b, end);
  CurvePrimitive blend;
  blend.to = T;
  blend.spacing = T / 24.;
  std::array<Vector3d, 6> bezier;
  bezier[0] = p0, bezier[1] = p0 + T / 5. * v0, bezier[2] = 2. * bezier[1] - p0 + T * T / 20. * a0;
  bezier[5] = p1, bezier[4] = p1 - T / 5. * v1, bezier[3] = 2. * bezier[4] - p1 + T * T / 20. * a1;
  blend.at = [bezier, T, radius, start, at_a = a.at, at_b = b.at, begin = b.from](double t) {
    const double u = t / T, h = u * u * u * (10. + u * (6. * u - 15.));
    std::array<Vector3d, 6> points = bezier;
    for (int level = 5; level > 0; --level)
      for (int k = 0; k < level; ++k)
        points[std::size_t(k)] += u * (points[std::size_t(k) + 1] - points[std::size_t(k)]);
    // Both rotations go on beyond their ends; their axes are mixed.
    VectorXd y = (1. - h) * at_a(start + t) + h * at_b(begin - radius + t);
    y.head<3>() = points[0];
    y.tail<3>().normalize();
    Vector3d x = y.segment<3>(3) - y.segment<3>(3).dot(y.tail<3>()) * y.tail<3>();
    y.segment<3>(3) = x.normalized();
    return y;
  };
  return blend;
}

/// Position and axes of a spline through columns, with unit axes at right angles.

VectorXd orthonormal(VectorXd y) {
  y.tail<3>().normalize();
  const Vector3d x = y.segment<3>(3) - y.segment<3>(3).dot(y.tail<3>()) * y.tail<3>();
  y.segment<3>(3) = x.normalized();
  return y;
}

CurvePrimitive ofPieces(CubicPieces pieces, double to, std::vector<double> knots) {
  CurvePrimitive primitive;
  primitive.to = to;
  primitive.knots = std::move(knots);
  primitive.at = [pieces = std::move(pieces)](double t) { return orthonormal(pieces.eval(t)); };
  return primitive;
}

/// Fits a spline through as few of the rows as keep the others within the tolerance.

/// The smaller of two speeds, 0 being that of the call, which may be larger or smaller.
double slower(double a, double b) { return a > 0. && b > 0. ? std::min(a, b) : std::max(a, b); }

/// Refuses an element that would need more memory than there is, such as one in another unit of length.
void requireSize(const CurvePrimitive& primitive, std::size_t number) {
  const double length = primitive.to - primitive.from;
  if (!(length <= ToolCurve::kLongest))
    throw ValueError(cat("ToolPath: element ", number, " is ", length, " m long; expected at most ",
                         ToolCurve::kLongest, " m; lengths are in meters"));
  if (primitive.knots.empty() && !(length <= kMostKnots * primitive.spacing))
    throw ValueError(cat("ToolPath: element ", number, " needs more than ", kMostKnots, " points on its ", length,
                         " m; expected fewer turns, and waypoints that are farther apart"));
}

}  // namespace

std::vector<double> CurvePrimitive::allKnots() const {
  if (!knots.empty()) return knots;
  const int count = std::max(1, int(std::ceil((to - from) / spacing - 1e-9)));
  std::vector<double> all;
  for (int k = 0; k <= count; ++k) all.push_back(k == count ? to : from + (to - from) * k / count);
  return all;
}

void PrimitiveList::append(CurvePrimitive primitive, double blend) {
  requireSize(primitive, number_);
  primitive.speed = speed_;
  const auto warn = [&](const std::string& what) {
    warnings.push_back(cat("the blend of ", blend, " m at element ", number_, " ", what));
  };
  if (blend > 0. && is_first_) {
    warn("has no effect: the path starts there; the radius is that of the corner at the start of an element");
  } else if (blend > 0. && !all.back().may_blend) {
    warn("has no effect: splines and rows are not blended");
  } else if (blend > 0.) {
    // Each end of an element may have a blend.
    const double radius = std::min({blend, kLargestBlendShare * primitive.to, kLargestBlendShare * all.back().to});
    if (radius < blend) warn(cat("is reduced to ", radius, " m, because its elements are short"));
    CurvePrimitive corner = blendOf(all.back(), primitive, radius);
    corner.speed = slower(all.back().speed, speed_);
    all.back().to -= radius;
    primitive.from = radius;
    all.push_back(std::move(corner));
  }
  all.push_back(std::move(primitive));
  is_first_ = false;
}

void PrimitiveList::lineTo(const Pose& to, double blend) {
  const Vector3d step = to.p - now_.p;
  const double way = step.norm(), angle = angleBetween(now_.q, to.q);
  const double length = way > kSamePlace ? way : ToolCurve::kOnTheSpot * angle;
  if (length > kSamePlace) {
    const Vector3d from = now_.p, velocity = step / length;
    append(ofPositions(now_, to.q, length, 0., [from, velocity](double t) { return Vector3d(from + t * velocity); }),
           blend);
  }
  now_ = to;
}

void PrimitiveList::circular(const ToolPathElement& element, const Vector3d& axis, double angle,
                             const Quaterniond& to) {
  const Vector3d height = axis.dot(now_.p - element.center) * axis, r = now_.p - element.center - height;
  const Vector3d foot = element.center + height;
  const double round = std::abs(angle) * r.norm(), length = std::hypot(round, element.advance);
  if (length > kSamePlace) {
    const double rate = angle / length, curvature = r.norm() * rate * rate;
    const Vector3d climb = element.advance / length * axis;
    append(ofPositions(now_, to, length, curvature,
                       [=](double t) { return Vector3d(foot + t * climb + Eigen::AngleAxisd(rate * t, axis) * r); }),
           element.blend);
  }
  now_ = {foot + element.advance * axis + Eigen::AngleAxisd(angle, axis) * r, to};
}

void PrimitiveList::arc(const ToolPathElement& element) {
  const Vector3d a = now_.p, b = element.waypoints[0].p, c = element.waypoints[1].p;
  const Vector3d u = b - a, v = c - a, n = u.cross(v);
  if (v.norm() < kSamePlace)
    throw ValueError(cat("ToolPath.arc: element ", number_, " ends at its start; expected another end, or a circle"));
  if (n.norm() < 1e-9 * std::max(u.norm() * v.norm(), 1e-12))
    throw ValueError(cat("ToolPath.arc: the three points of element ", number_, " are on a line; expected a circle"));
  const Vector3d center = a + (v.squaredNorm() * n.cross(u) + u.squaredNorm() * v.cross(n)) / (2. * n.squaredNorm());
  const Vector3d axis = n.normalized(), r = a - center, end = c - center;
  double angle = std::atan2(axis.dot(r.cross(end)), r.dot(end));
  if (angle < 0.) angle += 2. * std::numbers::pi;
  ToolPathElement circle = element;
  circle.center = center;
  circular(circle, axis, angle, resolved(element.waypoints[1]).q);
  now_.p = c;
}

void PrimitiveList::spline(const ToolPathElement& element) {
  std::vector<double> t = {0.};
  std::vector<VectorXd> rows = {columnsOf(now_)};
  for (const ToolWaypoint& waypoint : element.waypoints) {
    const Pose next = resolved(waypoint);
    const double way = (next.p - now_.p).norm();
    if (way > kSamePlace) t.push_back(t.back() + way), rows.push_back(columnsOf(next));
    now_ = next;
  }
  if (t.size() < 2) return;
  MatrixXd y(9, Eigen::Index(t.size()));
  for (std::size_t k = 0; k < t.size(); ++k) y.col(Eigen::Index(k)) = rows[k];
  CubicPieces pieces;
  pieces.addSpline(t, y, false);
  CurvePrimitive primitive = ofPieces(std::move(pieces), t.back(), {});
  double least = t.back();
  for (std::size_t k = 1; k < t.size(); ++k) least = std::min(least, t[k] - t[k - 1]);
  primitive.spacing = std::min(.005, least / 8.);
  requireSize(primitive, number_);
  all.push_back(std::move(primitive));
  is_first_ = false;
}

void PrimitiveList::fit(const std::vector<double>& t, const MatrixXd& y) {
  const int count = int(t.size());
  std::vector<int> chosen;
  const int stride = std::clamp((count - 1) / 4, 1, kFirstStride);
  for (int k = 0; k + stride / 2 < count - 1; k += stride) chosen.push_back(k);
  chosen.push_back(count - 1);
  for (int round = 0;; ++round) {
    std::vector<double> knots;
    MatrixXd at(9, Eigen::Index(chosen.size()));
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      knots.push_back(t[std::size_t(chosen[k])]);
      at.col(Eigen::Index(k)) = y.col(chosen[k]);
    }
    CubicPieces pieces;
    pieces.addSpline(knots, at, false);
    std::vector<int> more;
    ToolTolerance worst{0., 0.};
    for (std::size_t k = 0; k + 1 < chosen.size(); ++k) {
      ToolTolerance off{0., 0.};
      for (int row = chosen[k] + 1; row < chosen[k + 1]; ++row) {
        const double x = t[std::size_t(row)] - knots[k];
        const MatrixXd& c = pieces.coefficient[k];
        const Eigen::Matrix<double, 9, 1> miss = c.col(0) + x * (c.col(1) + x * (c.col(2) + x * c.col(3))) - y.col(row);
        off.position = std::max(off.position, miss.head<3>().norm());
        off.rotation = std::max({off.rotation, miss.segment<3>(3).norm(), miss.tail<3>().norm()});
      }
      if (off.position > tolerance_.position || off.rotation > tolerance_.rotation)
        more.push_back((chosen[k] + chosen[k + 1]) / 2);
      worst = {std::max(worst.position, off.position), std::max(worst.rotation, off.rotation)};
    }
    if (more.empty() || round == kMaxFitRounds) {
      fit_error = {std::max(fit_error.position, worst.position), std::max(fit_error.rotation, worst.rotation)};
      append(ofPieces(std::move(pieces), t.back(), std::move(knots)), 0.);
      return;
    }
    chosen.insert(chosen.end(), more.begin(), more.end());
    std::sort(chosen.begin(), chosen.end());
  }
}

void PrimitiveList::rows(const ToolPathElement& element) {
  if (!all.empty()) lineTo(resolved(element.waypoints[0]));
  now_ = resolved(element.waypoints[0]);
  std::vector<VectorXd> kept = {columnsOf(now_)};
  std::vector<double> step = {0.};  // to the row before
  std::vector<char> spot = {0};
  for (std::size_t k = 1; k < element.waypoints.size(); ++k) {
    const Pose next = resolved(element.waypoints[k]);
    const double way = (next.p - now_.p).norm(), angle = angleBetween(now_.q, next.q);
    if (way < kSamePlace && angle < kSamePlace) continue;
    kept.push_back(columnsOf(next));
    spot.push_back(way < kSamePlace);
    step.push_back(spot.back() ? ToolCurve::kOnTheSpot * angle : way);
    now_ = next;
  }
  const int count = int(kept.size());
  if (count < 2) return;
  const std::vector<char> is_corner = cornersOfRows(kept, step, spot, kCornerReach * tolerance_.position);
  for (int first = 0, k = 1; k < count; ++k) {
    if (k + 1 < count && !is_corner[std::size_t(k)]) continue;
    std::vector<double> t = {0.};
    MatrixXd y(9, k - first + 1);
    for (int j = first; j <= k; ++j) {
      if (j > first) t.push_back(t.back() + step[std::size_t(j)]);
      y.col(j - first) = kept[std::size_t(j)];
    }
    fit(t, y);
    first = k;
  }
}

void PrimitiveList::add(const ToolPathElement& element, std::size_t number) {
  speed_ = element.speed;
  number_ = number;
  switch (element.kind) {
    case ToolPathElement::Kind::line:
      return lineTo(resolved(element.waypoints[0]), element.blend);
    case ToolPathElement::Kind::arc:
      return arc(element);
    case ToolPathElement::Kind::circle:
      return circular(element, element.axis, element.angle, now_.q);
    case ToolPathElement::Kind::spline:
      return spline(element);
    case ToolPathElement::Kind::rows:
      return rows(element);
  }
}

}  // namespace kinegraph::inline tool_paths_internal
