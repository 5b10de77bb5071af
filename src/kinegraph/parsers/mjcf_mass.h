#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A solid of uniform density.
struct SolidMass {
  double volume = 0.;                            ///< m^3
  Vector3d inertia_per_mass = Vector3d::Zero();  ///< about its center, which is the origin; diagonal, m^2
};

/// Of a shape of a scene (box, sphere, capsule, cylinder, or ssBoxElip that is an ellipsoid) with these sizes; nothing
/// for others.
std::optional<SolidMass> solidMass(const std::string& shape, const std::vector<double>& size);

}  // namespace kinegraph
