#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline rendering_internal {

/// A shape in the layout of pictures: triangles with normals, or lines or points without shading.
struct PictureMesh {
  enum class Kind { surface, lines, points };

  /// Triangles of one color or image; without both, the shape's color is shown. Lines and points have their own colors.
  struct Part {
    int first, count;  ///< vertices
    std::optional<Vector4d> color = {};
    std::shared_ptr<const Image> image = {};
    std::shared_ptr<const Pixels> pixels = {};  ///< a decoded image, which belongs to this shape
  };

  Kind kind = Kind::surface;
  bool is_file = false;     ///< a mesh, whose triangles may be seen from both sides; else a closed primitive
  bool has_colors = false;  ///< of its own: one for each vertex, or for all lines or points
  /// Per vertex, of surfaces: position, normal, place in the image. Of lines, six vertices each: both ends, the end and
  /// the side of this vertex, color. Of points: position, color.
  std::vector<float> vertices;
  std::vector<Part> parts;
  Vector3d lower = Vector3d::Zero(), upper = Vector3d::Zero();  ///< corners of a box around it, m

  /// Numbers per vertex.
  int stride() const { return kind == Kind::surface ? 8 : kind == Kind::lines ? 11 : 6; }
};

/// Returns a shape for pictures; without vertices if it has no extent.
PictureMesh pictureMesh(const Geometry& geometry);

/// Returns the axes of a marker: arrows along x (red), y (green) and z (blue).
PictureMesh markerMesh(double length);

/// Returns an arrow from `at` along `vector`; `thickness` is the diameter of its shaft. All in m. An arrow without a
/// length has no vertices.
PictureMesh arrowMesh(const Vector3d& at, const Vector3d& vector, double thickness);

/// Converts a color (rgb in 0..1) from sRGB to a linear scale.
Vector3d linearColor(const Vector3d& rgb);

/// Converts a color from a linear scale to sRGB.
Vector3d encodedColor(const Vector3d& linear);

}  // namespace kinegraph::inline rendering_internal
