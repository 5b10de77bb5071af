#pragma once

#include <optional>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline rendering_internal {

/// Triangles with one color or one image and with normals for shading, in the layout of graphics libraries.
struct RenderMesh {
  std::vector<float> vertices;              ///< 3 per vertex, m
  std::vector<float> normals;               ///< 3 per normal, unit
  std::vector<int> faces;                   ///< 3 vertices per triangle
  std::vector<int> face_normals;            ///< 3 normals per triangle
  std::optional<Vector4d> color;            ///< rgba in 0..1, if the mesh has its own
  std::vector<float> texcoords = {};        ///< 2 per normal, to the right and down; none without an image
  std::shared_ptr<const Image> image = {};  ///< shown instead of a color; may be null
};

/// Converts a shape's surface to meshes, one per image and color (at most about 64; beyond that, similar colors are
/// merged). Edges sharper than 40 degrees have separate normals. Open surfaces are visible from both sides. Points
/// become octahedra and lines (pairs of points) prisms, 2 mm in radius. Returns nothing for an empty shape.
std::vector<RenderMesh> renderMeshes(const Geometry& geometry);

}  // namespace kinegraph::inline rendering_internal
