#pragma once

#include <utility>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Turns the triangles of a mesh from the given one on, so that their other side is outside.
inline void turnTriangles(Mesh& mesh, std::size_t first = 0) {
  for (std::size_t i = first; i < mesh.triangles.size(); ++i) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
}

/// Scales a mesh along its axes. A mirrored mesh (an odd number of negative factors) stays outside out.
inline void scaleMesh(Mesh& mesh, const Vector3d& factors) {
  for (Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(factors);
  if (factors.prod() < 0.) turnTriangles(mesh);
}

}  // namespace kinegraph::inline geometry_internal
