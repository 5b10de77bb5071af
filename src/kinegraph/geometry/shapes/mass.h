#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Mass properties of a surface of uniform thickness.
struct ShellMass {
  double area = 0.;                              ///< m^2
  Vector3d com = Vector3d::Zero();               ///< m
  Matrix3d inertia_per_mass = Matrix3d::Zero();  ///< about the center of mass, m^2
};

/// The six faces of a box with sides a, b, c. Throws ValueError if they have no area.
ShellMass boxShell(double a, double b, double c);
ShellMass sphereShell(double radius);

/// Mass properties of a shape's surface: exact for box and sphere, else of its triangles. Throws ValueError for shapes
/// without a surface.
ShellMass shellMass(const Geometry& geometry);

}  // namespace kinegraph::inline geometry_internal
