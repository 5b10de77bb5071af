#include "kinegraph/tool_paths/tool_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kHermiteError = 1e-7;  // m or rad, of a piece
constexpr double kSamePlace = 1e-7;     // m or rad, between two poses
constexpr double kCornerSlope = .01;    // largest jump of the direction that is no corner
constexpr double kCornerRotation = .5;  // rad/m, likewise of the rotation
constexpr double kCornerOfRows = .35;   // rad between rows
constexpr double kAlwaysCorner = 1.;    // rad between rows
constexpr double kSharper = 2.5;        // than at the rows before and after
constexpr int kFirstStride = 16;        // rows between the first knots
constexpr int kMaxFitRounds = 20;
constexpr double kLargestBlendShare = .49;  // of the shorter element

VectorXd columnsOf(const Pose& X) {
  const Matrix3d R = X.q.toRotationMatrix();
  VectorXd y(9);
  y << X.p, R.col(0), R.col(2);
  return y;
}

double angleBetween(const Quaterniond& a, const Quaterniond& b) { return a.angularDistance(b); }

/// A smooth part of a tool curve over a parameter t, in m or nearly so.
struct CurvePrimitive {
  double from = 0., to = 0.;
  std::function<VectorXd(double)> at;  ///< position, x axis, z axis; defined beyond both ends, too
  std::vector<double> knots;           ///< of t, ascending, from `from` to `to`
  double spacing = 0.;                 ///< between evenly spaced knots, if `knots` is empty
  bool may_blend = false;

  std::vector<double> allKnots() const {
    if (!knots.empty()) return knots;
    const int count = std::max(1, int(std::ceil((to - from) / spacing - 1e-9)));
    std::vector<double> all;
    for (int k = 0; k <= count; ++k) all.push_back(k == count ? to : from + (to - from) * k / count);
    return all;
  }
};

/// Spacing of Hermite knots (h^4 / 384 of the fourth derivative) for a curvature and a rotation rate, 1/m.
double hermiteSpacing(double curvature, double rotation_rate) {
  const double position = curvature > 0. ? std::pow(384. * kHermiteError / std::pow(curvature, 3.), .25) : 1e9;
  const double rotation = rotation_rate > 0. ? std::pow(384. * kHermiteError, .25) / rotation_rate : 1e9;
  return std::min(position, rotation);
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

/// Collects the primitives of a ToolPath.
class PrimitiveList {
 public:
  PrimitiveList(const Pose& start, double tolerance) : now_(start), tolerance_(tolerance) {}

  void add(const ToolPathElement& element, std::size_t number);
  void lineTo(const Pose& to, double blend = 0.);
  const Pose& now() const { return now_; }

  std::vector<CurvePrimitive> all;
  std::vector<std::string> warnings;
  double fit_error = kHermiteError;

 private:
  Pose resolved(const ToolWaypoint& waypoint) const { return {waypoint.p, waypoint.rotation.value_or(now_.q)}; }
  void append(CurvePrimitive primitive, double blend);
  void circular(const Vector3d& center, const Vector3d& axis, double angle, const Quaterniond& to, double blend);
  void arc(const ToolPathElement& element, std::size_t number);
  void spline(const ToolPathElement& element);
  void rows(const ToolPathElement& element);
  void fit(const std::vector<double>& t, const MatrixXd& y, double tolerance);

  Pose now_;
  double tolerance_;
};

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

void PrimitiveList::append(CurvePrimitive primitive, double blend) {
  if (blend > 0. && !all.empty() && all.back().may_blend && primitive.may_blend) {
    const double room = kLargestBlendShare * primitive.to;
    const double left = all.back().to - std::max(all.back().from, kLargestBlendShare * all.back().to);
    const double radius = std::min({blend, room, left});
    if (radius < blend)
      warnings.push_back(cat("the blend of ", blend, " m at element ", all.size(), " is reduced to ", radius,
                             " m, because its elements are short"));
    CurvePrimitive corner = blendOf(all.back(), primitive, radius);
    all.back().to -= radius;
    primitive.from = radius;
    all.push_back(std::move(corner));
  }
  all.push_back(std::move(primitive));
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

void PrimitiveList::circular(const Vector3d& center, const Vector3d& axis, double angle, const Quaterniond& to,
                             double blend) {
  const Vector3d height = axis.dot(now_.p - center) * axis, r = now_.p - center - height;
  const double radius = r.norm(), length = std::abs(angle) * radius;
  if (length > kSamePlace) {
    const double rate = angle / length;
    append(ofPositions(now_, to, length, 1. / radius,
                       [=](double t) { return Vector3d(center + height + Eigen::AngleAxisd(rate * t, axis) * r); }),
           blend);
  }
  now_ = {center + height + Eigen::AngleAxisd(angle, axis) * r, to};
}

void PrimitiveList::arc(const ToolPathElement& element, std::size_t number) {
  const Vector3d a = now_.p, b = element.waypoints[0].p, c = element.waypoints[1].p;
  const Vector3d u = b - a, v = c - a, n = u.cross(v);
  if (n.norm() < 1e-9 * std::max(u.norm() * v.norm(), 1e-12))
    throw ValueError(cat("ToolPath.arc: the three points of element ", number, " are on a line; expected a circle"));
  const Vector3d center = a + (v.squaredNorm() * n.cross(u) + u.squaredNorm() * v.cross(n)) / (2. * n.squaredNorm());
  const Vector3d axis = n.normalized(), r = a - center, end = c - center;
  double angle = std::atan2(axis.dot(r.cross(end)), r.dot(end));
  if (angle < 0.) angle += 2. * std::numbers::pi;
  circular(center, axis, angle, resolved(element.waypoints[1]).q, element.blend);
  now_.p = c;
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
  all.push_back(std::move(primitive));
}

/// Fits a spline through as few of the rows as keep the others within the tolerance.
void PrimitiveList::fit(const std::vector<double>& t, const MatrixXd& y, double tolerance) {
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
    double worst = 0.;
    for (std::size_t k = 0; k + 1 < chosen.size(); ++k) {
      double off = 0.;
      for (int row = chosen[k] + 1; row < chosen[k + 1]; ++row) {
        const double x = t[std::size_t(row)] - knots[k];
        const MatrixXd& c = pieces.coefficient[k];
        const Eigen::Matrix<double, 9, 1> miss = c.col(0) + x * (c.col(1) + x * (c.col(2) + x * c.col(3))) - y.col(row);
        off = std::max({off, miss.head<3>().norm(), ToolCurve::kOnTheSpot * miss.segment<3>(3).norm(),
                        ToolCurve::kOnTheSpot * miss.tail<3>().norm()});
      }
      if (off > tolerance) more.push_back((chosen[k] + chosen[k + 1]) / 2);
      worst = std::max(worst, off);
    }
    if (more.empty() || round == kMaxFitRounds) {
      fit_error = std::max(fit_error, worst);
      all.push_back(ofPieces(std::move(pieces), t.back(), std::move(knots)));
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
  std::vector<double> corner(std::size_t(count), 0.);
  for (int k = 1; k + 1 < count; ++k) {
    const std::size_t i = std::size_t(k);
    if (spot[i] || spot[i + 1]) {
      corner[i] = spot[i] != spot[i + 1] ? 10. : 0.;
      continue;
    }
    const Vector3d a = (kept[i] - kept[i - 1]).head<3>(), b = (kept[i + 1] - kept[i]).head<3>();
    corner[i] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  for (int first = 0, k = 1; k < count; ++k) {
    const std::size_t i = std::size_t(k);
    const double beside = k + 1 < count ? std::max(corner[i - 1], corner[i + 1]) : 0.;
    const bool ends =
        k + 1 == count || (corner[i] > kAlwaysCorner || (corner[i] > kCornerOfRows && corner[i] > kSharper * beside));
    if (!ends) continue;
    std::vector<double> t = {0.};
    MatrixXd y(9, k - first + 1);
    for (int j = first; j <= k; ++j) {
      if (j > first) t.push_back(t.back() + step[std::size_t(j)]);
      y.col(j - first) = kept[std::size_t(j)];
    }
    fit(t, y, tolerance_);
    first = k;
  }
}

void PrimitiveList::add(const ToolPathElement& element, std::size_t number) {
  switch (element.kind) {
    case ToolPathElement::Kind::line:
      return lineTo(resolved(element.waypoints[0]), element.blend);
    case ToolPathElement::Kind::arc:
      return arc(element, number);
    case ToolPathElement::Kind::circle:
      return circular(element.center, element.axis, element.angle, now_.q, element.blend);
    case ToolPathElement::Kind::spline:
      return spline(element);
    case ToolPathElement::Kind::rows:
      return rows(element);
  }
}

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

ToolCurve::ToolCurve(const ToolPath& path, const Pose& present, double tolerance, double approach, double retract) {
  Pose start = present;
  if (path.first()) start = {path.first()->p, path.first()->rotation.value_or(present.q)};
  const Vector3d axis = Vector3d::Unit(path.freeAxis() < 0 ? 2 : path.freeAxis());
  PrimitiveList list({start.p + approach * (start.q * axis), start.q}, tolerance);
  if (approach > 0.) list.lineTo(start);
  const std::size_t before = list.all.size();
  for (std::size_t k = 0; k < path.elements().size(); ++k) list.add(path.elements()[k], k);
  if (list.all.size() == before) throw ValueError(cat("ToolPath: the path of '", path.frame(), "' has no length"));
  const std::size_t after = list.all.size();
  if (retract > 0.) list.lineTo({list.now().p + retract * (list.now().q * axis), list.now().q});
  VectorXd slope;
  for (std::size_t k = 0; k < list.all.size(); ++k) {
    if (k == before) approach_end_ = pieces_.length;
    if (k == after) retract_start_ = pieces_.length;
    const HermiteSection section = sectionOf(list.all[k], pieces_.length);
    const bool corner = k > 0 && isCorner(slope, section.slope.col(0));
    pieces_.addHermite(section.s, section.y, section.slope, corner);
    slope = section.slope.rightCols(1);
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

ToolCurve ToolCurve::reversed() const {
  ToolCurve back;
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

}  // namespace kinegraph
