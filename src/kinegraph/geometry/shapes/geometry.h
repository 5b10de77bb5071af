#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A picture as the bytes of a PNG or JPEG file.
struct Image {
  std::string bytes;
  std::string path = {};  ///< of its file; empty if embedded in another file
};

/// Kinds of shapes. The numbers are those of the Python enum `ry.ST`.
enum class ShapeType : int {
  none = -1,
  box = 0,
  sphere = 1,
  capsule = 2,
  mesh = 3,
  cylinder = 4,
  marker = 5,
  pointCloud = 6,
  ssCvx = 7,
  ssBox = 8,
  ssCylinder = 9,
  ssBoxElip = 10,
  quad = 11,
  camera = 12,
  sdf = 13,
  tensor = 14,
  lines = 15,
  plane = 16,
};

/// Triangles of a mesh that show a picture instead of colors.
struct TexturedTriangles {
  std::uint32_t first = 0, count = 0;  ///< in the list of triangles
  std::shared_ptr<const Image> image;
};

/// A triangle mesh, or a point set if `triangles` is empty. Local coordinates, m.
struct Mesh {
  std::vector<Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint8_t, 4>> colors;  ///< rgba: one per vertex, one for all, or none
  std::vector<std::uint32_t> parts = {};  ///< the first vertex of each convex part, ascending; empty: not divided
  std::vector<std::array<float, 2>> texcoords =
      {};  ///< per vertex: position in a picture, to the right and up, in 0..1; or none
  std::vector<TexturedTriangles> textures = {};  ///< ascending; none without `texcoords`
};

/// Numbers on a regular grid that fills a box centered at the origin; the last index is fastest.
struct Grid {
  std::array<int, 3> cells = {0, 0, 0};  ///< values per axis, at least 2
  std::vector<float> values;
  float at(int i, int j, int k) const { return values[(std::size_t(i) * cells[1] + j) * cells[2] + k]; }
};

/// A shape without pose, color or owner: type, size, and mesh or core points if the type has them.
/// `size` has exactly the entries of the type (m):
///   box x y z | sphere r | capsule length r | cylinder length r | ssBox x y z r | ssCylinder length R r
///   ssBoxElip x y z ex ey ez r | ssCvx r | quad x y | plane x y | marker length | sdf, tensor x y z | camera none, or
///   its symbol's length | others none
/// Boxes have full outer widths including rounding; the axis of capsule and cylinder is z; the length of a capsule is
/// the length of its core segment. A plane is endless, and solid below its xy plane; its sizes are those of the
/// rectangle that is drawn.
struct Geometry {
  ShapeType type = ShapeType::none;
  std::vector<double> size;
  std::shared_ptr<const Mesh> mesh;        ///< mesh, pointCloud, lines; core points of ssCvx (its vertices)
  std::string mesh_file = {};              ///< path of the source file of `mesh`, or empty
  Vector3d mesh_scale = Vector3d::Ones();  ///< scale applied to its points
  std::shared_ptr<const Grid> grid = {};   ///< of tensor and sdf, if the values are known
};

}  // namespace kinegraph
