#pragma once

#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>

#include <algorithm>
#include <memory>

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// Points, segments and boxes, without their radius.
inline std::unique_ptr<coal::ShapeBase> coalShape(const CollisionBody& body) {
  switch (body.core()) {
    case CollisionBody::Core::point:
      return std::make_unique<coal::Sphere>(0.);
    case CollisionBody::Core::segment:
      return std::make_unique<coal::Capsule>(0., 2. * body.halfLength());
    default:
      return std::make_unique<coal::Box>(2. * body.halfSides());
  }
}

/// The least distance of all pairs that joints move apart, by coal, at most 1 m; of scenes of spheres, capsules and
/// boxes.
inline double coalDistance(const State& state) {
  double least = 1.;
  for (const auto& [a, b] : state.model().movingPairs()) {
    const CollisionBody &body_a = *state.model().body[std::size_t(a)], &body_b = *state.model().body[std::size_t(b)];
    const RigidTransform X_a = state.pose(a), X_b = state.pose(b);
    const auto shape_a = coalShape(body_a), shape_b = coalShape(body_b);
    coal::DistanceRequest request;
    coal::DistanceResult result;
    const double cores = coal::distance(shape_a.get(), coal::Transform3s(X_a.R, X_a.p), shape_b.get(),
                                        coal::Transform3s(X_b.R, X_b.p), request, result);
    least = std::min(least, cores - body_a.radius() - body_b.radius());
  }
  return least;
}

}  // namespace kinegraph
