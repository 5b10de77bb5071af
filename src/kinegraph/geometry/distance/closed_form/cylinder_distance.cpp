#include "kinegraph/geometry/distance/closed_form/cylinder_distance.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline geometry_internal {

NearestPoints pointToCylinder(const Vector3d& point, const CylinderCore& cylinder) {
  const Vector3d p = cylinder.X_WB.R.transpose() * (point - cylinder.X_WB.p);
  const double from_axis = std::hypot(p.x(), p.y());
  const Vector3d up(0., 0., p.z() < 0. ? -1. : 1.);
  const Vector3d out = from_axis > 0. ? Vector3d(p.x() / from_axis, p.y() / from_axis, 0.) : Vector3d::UnitX();
  const double beyond_side = from_axis - cylinder.radius, beyond_cap = std::abs(p.z()) - cylinder.half_length;
  NearestPoints near;
  if (beyond_side > 0. && beyond_cap > 0.) {
    near.distance = std::hypot(beyond_side, beyond_cap);
    near.normal = (beyond_side * out + beyond_cap * up) / near.distance;
  } else {
    near.distance = std::max(beyond_side, beyond_cap);
    near.normal = beyond_side > beyond_cap ? out : up;
  }
  near.normal = cylinder.X_WB.R * near.normal;
  near.point_a = point;
  near.point_b = point - near.distance * near.normal;
  return near;
}

}  // namespace kinegraph::inline geometry_internal
