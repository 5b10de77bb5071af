#pragma once

#include <optional>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

/// Triangles of one color, or with one picture, with normals for shading, as a graphics library takes them.
struct RenderMesh {
  std::vector<float> vertices;              ///< 3 per vertex, m
  std::vector<float> normals;               ///< 3 per normal, unit
  std::vector<int> faces;                   ///< 3 vertices per triangle
  std::vector<int> face_normals;            ///< 3 normals per triangle
  std::optional<Vector4d> color;            ///< rgba in 0..1, if the mesh itself says
  std::vector<float> texcoords = {};        ///< 2 per normal, to the right and down; none without an image
  std::shared_ptr<const Image> image = {};  ///< that is shown instead of a color, or null
};

/// The surface of a shape, cut by picture and color (at most about 64 of them; nearly equal ones are merged beyond
/// that). Edges sharper than 40 degrees are shaded sharp. Surfaces that are open are seen from both sides. Points
/// become octahedra and lines (pairs of points) prisms, 2 mm in radius. Empty where there is nothing to see.
std::vector<RenderMesh> renderMeshes(const Geometry& geometry);

}  // namespace kinegraph
