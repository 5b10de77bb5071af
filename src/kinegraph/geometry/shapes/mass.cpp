#include "kinegraph/geometry/shapes/mass.h"

#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/tessellation.h"

namespace kinegraph::inline geometry_internal {

namespace {

ShellMass meshShell(const Mesh& mesh) {
  ShellMass shell;
  Matrix3d second = Matrix3d::Zero();  // integral of p p^T
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k], sum = a + b + c;
    const double area = .5 * (b - a).cross(c - a).norm();
    shell.area += area;
    shell.com += area / 3. * sum;
    second += area / 12. * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (shell.area <= 0.) throw ValueError("a mesh without area has no inertia");
  shell.com /= shell.area;
  second = second / shell.area - shell.com * shell.com.transpose();
  shell.inertia_per_mass = second.trace() * Matrix3d::Identity() - second;
  return shell;
}

}  // namespace

ShellMass boxShell(double a, double b, double c) {
  const double x = b * c, y = a * c, z = a * b, sum = x + y + z;  // half the areas of the faces across each axis
  if (sum <= 0.) throw ValueError(cat("a box of ", a, " x ", b, " x ", c, " has no surface to carry a mass"));
  const auto about = [&](double own, double p, double q, double across_p, double across_q) {
    return (own * (p * p + q * q) / 12. + across_p * (p * p / 4. + q * q / 12.) +
            across_q * (p * p / 12. + q * q / 4.)) /
           sum;
  };
  ShellMass shell;
  shell.area = 2. * sum;
  shell.inertia_per_mass = Vector3d(about(x, b, c, y, z), about(y, c, a, z, x), about(z, a, b, x, y)).asDiagonal();
  return shell;
}

ShellMass sphereShell(double radius) {
  return {4. * std::numbers::pi * radius * radius, Vector3d::Zero(), 2. / 3. * radius * radius * Matrix3d::Identity()};
}

ShellMass shellMass(const Geometry& geometry) {
  const ShapeKind& kind = shapeKind(geometry.type);
  if (kind.shell) return kind.shell(geometry.size);
  const Mesh mesh = tessellate(geometry);
  if (mesh.triangles.empty()) throw ValueError(cat("a ", kind.name, " has no surface to carry a mass"));
  return meshShell(mesh);
}

}  // namespace kinegraph::inline geometry_internal
