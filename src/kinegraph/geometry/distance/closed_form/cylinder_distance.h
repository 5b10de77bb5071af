#pragma once

#include "kinegraph/geometry/distance/closed_form/nearest_points.h"

namespace kinegraph::inline geometry_internal {

/// A cylinder about the origin of the frame X_WB, along its z axis.
struct CylinderCore {
  RigidTransform X_WB;
  double radius = 0., half_length = 0.;
};

/// Nearest points of a point a and a cylinder b, exact: the point is beyond the side, a cap, or the rim; or inside,
/// nearest to side or cap.
NearestPoints pointToCylinder(const Vector3d& point, const CylinderCore& cylinder);

}  // namespace kinegraph::inline geometry_internal
