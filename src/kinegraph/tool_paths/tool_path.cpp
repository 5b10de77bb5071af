#include "kinegraph/tool_paths/tool_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
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

}  // namespace

ToolPath::ToolPath(std::string frame, std::string relative_to)
    : frame_(std::move(frame)), relative_to_(std::move(relative_to)) {}

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
  path.first_ = rows.waypoints.front();
  return path.append(std::move(rows));
}

ToolPath& ToolPath::append(ToolPathElement element) {
  element.speed = speed_;
  elements_.push_back(std::move(element));
  return *this;
}

ToolPath& ToolPath::start(const ToolWaypoint& pose) {
  requireFinite("start", pose);
  if (!elements_.empty() && elements_.front().kind == ToolPathElement::Kind::rows)
    throw ValueError("ToolPath.start: the path begins with rows, whose first one is its start");
  first_ = pose;
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
  speed_ = speed;
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
  free_axis_ = about;
  const bool is_turn = range && range->second - range->first >= 2. * std::numbers::pi - 1e-9;
  range_ = is_turn ? std::nullopt : range;
  prefer_ = prefer;
  return *this;
}

ToolPath& ToolPath::tilt(double angle) {
  if (!(angle >= 0.) || angle >= std::numbers::pi / 2.)
    throw ValueError(cat("ToolPath.tilt: angle is ", angle, "; expected 0 <= angle < pi / 2 rad"));
  if (free_axis_ < 0) free_axis_ = 2;
  cone_ = angle;
  return *this;
}

ToolPath& ToolPath::lean(double travel, double work) {
  for (const auto& [name, angle] : {std::pair("travel", travel), std::pair("work", work)})
    if (!(std::abs(angle) < std::numbers::pi / 2.))
      throw ValueError(
          cat("ToolPath.lean: ", name, " is ", angle, "; expected an angle between -pi / 2 and pi / 2 rad"));
  bool any = false;
  for (ToolPathElement& element : elements_) {
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
    if (&element == &elements_.front()) first_ = element.waypoints.front();
  }
  if (!any) throw ValueError("ToolPath.lean: the path has no rows with normals; call it behind ToolPath.along or read");
  return *this;
}

std::string ToolPath::str() const {
  return cat(elements_.size(), elements_.size() == 1 ? " element of '" : " elements of '", frame_, "'",
             relative_to_.empty() ? "" : cat(" relative to '", relative_to_, "'"),
             free_axis_ < 0 ? "" : cat(", free about ", "xyz"[free_axis_]),
             range_ ? cat(" from ", range_->first, " to ", range_->second, " rad") : "",
             cone_ > 0. ? cat(", tilt ", cone_, " rad") : "");
}

}  // namespace kinegraph
