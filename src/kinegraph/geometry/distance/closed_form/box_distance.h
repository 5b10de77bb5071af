#pragma once

#include "kinegraph/geometry/distance/closed_form/nearest_points.h"

namespace kinegraph::inline geometry_internal {

/// -1 for negative x, else 1.
inline double signOf(double x) { return x < 0. ? -1. : 1.; }

/// The points center + s * axis with |s| <= half; `axis` is a unit vector.
struct SegmentCore {
  Vector3d center, axis;
  double half = 0.;
  Vector3d at(double s) const { return center + s * axis; }
};

/// A box about the origin of the frame X_WB, along its axes.
struct BoxCore {
  RigidTransform X_WB;
  Vector3d half;
};

/// Nearest points of a point a and a box b, exact: the clamped point, or from inside a point of the nearest face.
NearestPoints pointToBox(const Vector3d& point, const BoxCore& box);

/// Nearest points of a segment a and a box b, exact: the squared distance along the segment is convex and piecewise
/// quadratic. If the segment intersects the box, the shortest push is along a face normal or across an edge and the
/// segment.
NearestPoints segmentToBox(const SegmentCore& segment, const BoxCore& box);

}  // namespace kinegraph::inline geometry_internal
