#pragma once

#include <optional>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// Corners of two bodies to start support searches from.
struct SupportCorners {
  std::uint32_t a = 0, b = 0;
};

/// The farthest point of a convex core along a direction, searched from `corner`, which is updated to the result. Local
/// coordinates.
Vector3d supportNear(const CollisionBody& body, const Vector3d& direction, std::uint32_t& corner);

/// Whether two convex bodies are apart, and a separating direction (unit, world, from b to a).
struct SeparatingDirection {
  bool apart;
  Vector3d normal;  ///< if apart
};

/// Checks whether two convex bodies are at least `margin` (m) apart. Faster than computing the distance, because it
/// stops at the first separating direction or the first closer pair of points. Returns nullopt if rounding hides the
/// answer, and for a negative sum of margin and radii (overlaps). `corners` only speed up the search; apart from
/// rounding, the answer does not depend on them. Source: van den Bergen, Collision Detection in Interactive 3D
/// Environments, 4.3.
std::optional<SeparatingDirection> separation(const CollisionBody& a, const RigidTransform& X_WA,
                                              const CollisionBody& b, const RigidTransform& X_WB, double margin,
                                              SupportCorners& corners);

}  // namespace kinegraph::inline geometry_internal
