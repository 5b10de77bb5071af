#include "kinegraph/tool_paths/tool_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/guessed_units.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

void requireFinite(const char* call, const ToolWaypoint& waypoint) {
  if (!waypoint.p.allFinite() || (waypoint.rotation && !waypoint.rotation->coeffs().allFinite()))
    throw ValueError(cat("ToolPath.", call, ": the pose has numbers that are not finite"));
}

/// The rotation with this z axis whose x axis is nearest to `x`.
Quaterniond rotationWithAxis(const Vector3d& z, const Vector3d& x) {
  Matrix3d R;
  R.col(2) = z;
  R.col(0) = (x - z.dot(x) * z).normalized();
  R.col(1) = z.cross(R.col(0));
  return Quaterniond(R);
}

constexpr double kLeastDegrees = 10.;  // angles from here on may be in degrees

/// How many waypoints an element has at least and at most.
std::pair<std::size_t, std::size_t> waypointCounts(ToolPathElement::Kind kind) {
  constexpr std::size_t kMany = std::numeric_limits<std::size_t>::max();
  static constexpr std::pair<std::size_t, std::size_t> counts[] = {{1, 1}, {2, 2}, {0, 0}, {1, kMany}, {2, kMany}};
  const int number = int(kind);
  if (number < 0 || number >= int(std::size(counts)))
    throw ValueError(cat("ToolPath: the state has an element of kind ", number, "; expected 0 to 4"));
  return counts[number];
}

}  // namespace

ToolPath::ToolPath(std::string frame, std::string relative_to) : parts_{std::move(frame), std::move(relative_to)} {}

ToolPath ToolPath::along(std::string frame, const MatrixXd& points, const MatrixXd& normals, std::string relative_to) {
  const bool poses = normals.size() == 0 && points.cols() == 7;
  const auto shape = [](const MatrixXd& m) { return cat("(", m.rows(), ", ", m.cols(), ")"); };
  if (points.rows() < 2 || (points.cols() != 3 && !poses))
    throw ValueError(cat("ToolPath.along: points have shape ", shape(points),
                         "; expected (K, 3) with normals (K, 3), or poses (K, 7), K >= 2"));
  if (normals.size() > 0 && (normals.rows() != points.rows() || normals.cols() != 3))
    throw ValueError(cat("ToolPath.along: normals have shape ", shape(normals), "; expected (", points.rows(), ", 3)"));
  if (!points.allFinite() || !normals.allFinite())
    throw ValueError("ToolPath.along: the rows have numbers that are not finite");
  ToolPath path(std::move(frame), std::move(relative_to));
  ToolPathElement rows{ToolPathElement::Kind::rows};
  Vector3d x(1., .3, .2);
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    if (poses) {
      rows.waypoints.push_back(Pose::fromNumbers(points.row(k).transpose()));
      continue;
    }
    rows.waypoints.push_back(Vector3d(points.row(k).transpose()));
    if (normals.size() == 0) continue;
    const double length = normals.row(k).norm();
    if (length < 1e-9) throw ValueError(cat("ToolPath.along: normal ", k, " has no direction"));
    const Vector3d z = normals.row(k).transpose() / length;
    if (z.cross(x).norm() < 1e-3 * x.norm()) x = Vector3d(x[1], x[2], x[0]);
    rows.waypoints.back().rotation = rotationWithAxis(z, x);
    x = *rows.waypoints.back().rotation * Vector3d::UnitX();
  }
  path.parts_.first = rows.waypoints.front();
  return path.append(std::move(rows));
}

ToolPath& ToolPath::append(ToolPathElement element) {
  element.speed = parts_.speed;
  parts_.elements.push_back(std::move(element));
  return *this;
}

ToolPath& ToolPath::start(const ToolWaypoint& pose) {
  requireFinite("start", pose);
  if (!parts_.elements.empty() && parts_.elements.front().kind == ToolPathElement::Kind::rows)
    throw ValueError("ToolPath.start: the path begins with rows, whose first one is its start");
  parts_.first = pose;
  return *this;
}

ToolPath& ToolPath::line(const ToolWaypoint& to, double blend) {
  requireFinite("line", to);
  if (!(blend >= 0.)) throw ValueError(cat("ToolPath.line: blend is ", blend, "; expected a radius >= 0 in m"));
  ToolPathElement element{ToolPathElement::Kind::line, {to}};
  element.blend = blend;
  return append(std::move(element));
}

ToolPath& ToolPath::arc(const Vector3d& via, const ToolWaypoint& to, double blend) {
  requireFinite("arc", via);
  requireFinite("arc", to);
  if (!(blend >= 0.)) throw ValueError(cat("ToolPath.arc: blend is ", blend, "; expected a radius >= 0 in m"));
  ToolPathElement element{ToolPathElement::Kind::arc, {via, to}};
  element.blend = blend;
  return append(std::move(element));
}

ToolPath& ToolPath::circle(const Vector3d& center, const Vector3d& axis, double angle, double blend, double advance) {
  if (!center.allFinite() || !axis.allFinite() || axis.norm() < 1e-9)
    throw ValueError("ToolPath.circle: expected a finite center and an axis with a direction");
  if (!std::isfinite(angle)) throw ValueError(cat("ToolPath.circle: angle is ", angle, "; expected a number in rad"));
  if (!std::isfinite(advance))
    throw ValueError(cat("ToolPath.circle: advance is ", advance, "; expected a number in m"));
  if (!(blend >= 0.)) throw ValueError(cat("ToolPath.circle: blend is ", blend, "; expected a radius >= 0 in m"));
  ToolPathElement element{ToolPathElement::Kind::circle};
  element.center = center, element.axis = axis.normalized(), element.angle = angle, element.blend = blend;
  element.advance = advance;
  if (mayBeDegrees(angle, kLeastDegrees))
    parts_.warnings.push_back(cat("circle: angle is ", angle, "; ", askForRadians(angle)));
  return append(std::move(element));
}

ToolPath& ToolPath::spline(std::vector<ToolWaypoint> waypoints) {
  if (waypoints.empty()) throw ValueError("ToolPath.spline: there are no waypoints; expected at least one");
  for (const ToolWaypoint& waypoint : waypoints) requireFinite("spline", waypoint);
  return append({ToolPathElement::Kind::spline, std::move(waypoints)});
}

ToolPath& ToolPath::speed(double speed) {
  if (!(speed >= 0.) || !std::isfinite(speed))
    throw ValueError(cat("ToolPath.speed: speed is ", speed, "; expected a number >= 0 in m/s"));
  parts_.speed = speed;
  return *this;
}

ToolPath& ToolPath::free(int about, std::optional<std::pair<double, double>> range, std::optional<double> prefer) {
  if (about < 0 || about > 2)
    throw ValueError(cat("ToolPath.free: about is ", about, "; expected 0 (x), 1 (y) or 2 (z)"));
  if (range && !(range->first < range->second && std::isfinite(range->second - range->first)))
    throw ValueError(cat("ToolPath.free: range is (", range->first, ", ", range->second,
                         "); expected two angles in rad, the smaller one first"));
  if (prefer && (!std::isfinite(*prefer) || (range && (*prefer < range->first || *prefer > range->second))))
    throw ValueError(cat("ToolPath.free: prefer is ", *prefer, "; expected an angle in rad",
                         range ? cat(" from ", range->first, " to ", range->second) : ""));
  const double end = range ? std::max(-range->first, range->second) : 0.;
  if (mayBeDegrees(end, kLeastDegrees))
    parts_.warnings.push_back(cat("free: the range from ", range->first, " to ", range->second,
                                  " is more than a turn; ", askForRadians(end)));
  parts_.free_axis = about;
  const bool is_turn = range && range->second - range->first >= 2. * std::numbers::pi - 1e-9;
  parts_.range = is_turn ? std::nullopt : range;
  parts_.prefer = prefer;
  return *this;
}

ToolPath& ToolPath::tilt(double angle) {
  if (!(angle >= 0.) || angle >= std::numbers::pi / 2.)
    throw ValueError(cat("ToolPath.tilt: angle is ", angle, "; expected 0 <= angle < pi / 2 rad"));
  if (parts_.free_axis < 0) parts_.free_axis = 2;
  parts_.cone = angle;
  return *this;
}

ToolPath& ToolPath::lean(double travel, double work) {
  for (const auto& [name, angle] : {std::pair("travel", travel), std::pair("work", work)})
    if (!(std::abs(angle) < std::numbers::pi / 2.))
      throw ValueError(
          cat("ToolPath.lean: ", name, " is ", angle, "; expected an angle between -pi / 2 and pi / 2 rad"));
  bool any = false;
  for (ToolPathElement& element : parts_.elements) {
    const std::vector<ToolWaypoint> rows = element.waypoints;
    if (element.kind != ToolPathElement::Kind::rows || !rows.front().rotation) continue;
    any = true;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Vector3d z = *rows[k].rotation * Vector3d::UnitZ();
      Vector3d along = rows[std::min(k + 1, rows.size() - 1)].p - rows[k == 0 ? 0 : k - 1].p;
      along -= z.dot(along) * z;
      if (along.norm() < 1e-9)
        throw ValueError(cat("ToolPath.lean: the path at row ", k, " is along the tool's z axis, or stands still"));
      along.normalize();
      const Eigen::AngleAxisd forward(travel, z.cross(along)), left(work, -along);
      element.waypoints[k].rotation = Quaterniond(forward * left) * *rows[k].rotation;
    }
    if (&element == &parts_.elements.front()) parts_.first = element.waypoints.front();
  }
  if (!any) throw ValueError("ToolPath.lean: the path has no rows with normals; call it behind ToolPath.along or read");
  return *this;
}

ToolPath ToolPath::fromParts(Parts parts) {
  for (const ToolPathElement& element : parts.elements) {
    const auto [least, most] = waypointCounts(element.kind);
    if (element.waypoints.size() < least || element.waypoints.size() > most)
      throw ValueError(cat("ToolPath: the state has an element of kind ", int(element.kind), " with ",
                           element.waypoints.size(), " waypoints; expected ", least, least < most ? " or more" : ""));
  }
  if (parts.free_axis < -1 || parts.free_axis > 2)
    throw ValueError(cat("ToolPath: the state has the free axis ", parts.free_axis, "; expected -1 to 2"));
  ToolPath path(parts.frame);
  path.parts_ = std::move(parts);
  return path;
}

std::string ToolPath::str() const {
  return cat(parts_.elements.size(), parts_.elements.size() == 1 ? " element of '" : " elements of '", parts_.frame,
             "'", parts_.relative_to.empty() ? "" : cat(" relative to '", parts_.relative_to, "'"),
             parts_.free_axis < 0 ? "" : cat(", free about ", "xyz"[parts_.free_axis]),
             parts_.range ? cat(" from ", parts_.range->first, " to ", parts_.range->second, " rad") : "",
             parts_.cone > 0. ? cat(", tilt ", parts_.cone, " rad") : "");
}

}  // namespace kinegraph
