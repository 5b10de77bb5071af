#pragma once

#include <optional>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

/// Corners of two bodies from which the farthest ones along a direction are looked for.
struct SupportCorners {
  std::uint32_t a = 0, b = 0;
};

/// The point of a convex core that is farthest along a direction, looked for from a corner that may be near it and
/// becomes the one that was found. Local coordinates.
Vector3d supportNear(const CollisionBody& body, const Vector3d& direction, std::uint32_t& corner);

/// Two convex bodies that are apart: a direction (unit, world, from b to a) along which they are that far.
struct SeparatingDirection {
  bool apart;
  Vector3d normal;  ///< if they are
};

/// Are two convex bodies at least `margin` (m) apart? Takes less than their distance, since it ends with the first
/// direction that shows it, or the first points that are nearer. Nothing where rounding hides the answer, or for
/// overlaps (margin and radii together negative), of which this says nothing. The answer does not depend on where
/// `corners` are but for what rounding hides. Source: van den Bergen, Collision Detection in Interactive 3D
/// Environments, 4.3.
std::optional<SeparatingDirection> separation(const CollisionBody& a, const RigidTransform& X_WA,
                                              const CollisionBody& b, const RigidTransform& X_WB, double margin,
                                              SupportCorners& corners);

}  // namespace kinegraph
