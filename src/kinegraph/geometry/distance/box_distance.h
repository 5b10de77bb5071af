#pragma once

#include "kinegraph/geometry/distance/nearest_points.h"

namespace kinegraph {

/// 1, also of 0, or -1.
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

/// Of a point a and a box b. Exact: the nearest point is the clamped one, or on the nearest face from inside.
NearestPoints pointToBox(const Vector3d& point, const BoxCore& box);

/// Of a segment a and a box b. Exact: the squared distance along the segment is convex and piecewise quadratic; where
/// the segment meets the box, the shortest push is along a face normal or across an edge and the segment.
NearestPoints segmentToBox(const SegmentCore& segment, const BoxCore& box);

}  // namespace kinegraph
