#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline parsers_internal {

/// A body of uniform density: a solid, or a thin shell.
struct UniformMass {
  double measure = 0.;                           ///< volume, m^3, or area of a shell, m^2
  Vector3d com = Vector3d::Zero();               ///< m
  Matrix3d inertia_per_mass = Matrix3d::Zero();  ///< about the center of mass, m^2
};

/// A scene shape (box, sphere, capsule, cylinder, or an ellipsoid written as ssBoxElip) with these sizes; nullopt for
/// other shapes.
std::optional<UniformMass> uniformMass(const std::string& shape, const std::vector<double>& size, bool is_shell);

/// MuJoCo's modes for the mass of a mesh: `legacy` adds the absolute volumes of the pyramids from a center to the
/// triangles, `exact` their signed volumes, `convex` fills the hull, `shell` weighs the surface.
enum class MeshMassMode { legacy, exact, convex, shell };

/// Nullopt for a mesh without volume.
std::optional<UniformMass> uniformMass(const Mesh& mesh, MeshMassMode mode);

/// A box about a mesh: MuJoCo fits primitive geoms to it.
struct FittedBox {
  Pose pose;
  Vector3d half_sides;  ///< the axes by ascending side of the box of equal inertia
};

/// Returns the box with the inertia of a mesh, or with `to_bounds` the bounding box along the same axes.
FittedBox fitBox(const Mesh& mesh, const UniformMass& solid, bool to_bounds);

/// Mass and inertia of a part, in the axes of its frame.
struct PartMass {
  double mass = 0.;                    ///< kg
  Vector3d com = Vector3d::Zero();     ///< m
  Matrix3d matrix = Matrix3d::Zero();  ///< about the center of mass, kg m^2

  /// Adds a rigidly attached part; `X` is its pose in this frame.
  void add(const PartMass& part, const Pose& X);
};

}  // namespace kinegraph::inline parsers_internal
