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

/// Volume and inertia of a scene shape (box, sphere, capsule, cylinder, or an ellipsoid written as ssBoxElip) with
/// these sizes; nullopt for other shapes.
std::optional<SolidMass> solidMass(const std::string& shape, const std::vector<double>& size);

}  // namespace kinegraph
