#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/geometry/shapes/mass.h"

namespace kinegraph::inline geometry_internal {

/// Collision geometry of a shape: a core swept by a ball. The axis of a core, if any, is z. Lengths in m.
struct ShapeCore {
  /// `half_space` is everything below the xy plane. Of the others, five use the vertices of the shape's mesh (their
  /// hull; the hulls of its convex parts; each vertex; a segment per pair of vertices) or its grid.
  enum class Form {
    point,
    segment,
    box,
    cylinder,
    box_ellipsoid,
    half_space,
    hull,
    hulls_of_parts,
    points,
    segments,
    grid
  };
  Form form = Form::point;
  double radius = 0.;                      ///< of the ball
  double half_length = 0.;                 ///< of segment and cylinder
  double core_radius = 0.;                 ///< of a cylinder
  Vector3d half_sides = Vector3d::Zero();  ///< of box and box_ellipsoid
  Vector3d radii = Vector3d::Zero();       ///< of the ellipsoid in a box_ellipsoid
};

/// Table entry of a shape type with all type-specific properties. Null and false are the defaults.
struct ShapeKind {
  /// Data besides the sizes: a mesh that is the visible shape, the core points of a swept surface, or a grid of
  /// numbers.
  enum class Data { none, mesh, core_points, grid };

  /// Simplified body, sharp or rounded, for facts, grasps and placements; its first sizes are x y z of a box, the
  /// radius of a ball, length and radius of the other two.
  enum class Body { other, box, ball, capsule, cylinder };

  ShapeType type = ShapeType::none;
  std::string_view name;           ///< name in files
  std::string_view size_names{};   ///< a name for each entry of `Geometry::size`
  std::size_t optional_sizes = 0;  ///< number of additional unnamed entries allowed
  Data data = Data::none;
  Body body = Body::other;
  bool is_symbol = false;    ///< marks a place only: never collides, no file format writes it
  bool has_inertia = false;  ///< its surface can carry a mass
  bool is_round = false;     ///< round about z: pictures wrap around the axis
  bool is_drawn_by_page =
      false;  ///< the page builds it from type and sizes (viewer/src/primitives.ts); others are sent as triangles

  ShapeCore (*core)(const Geometry&) = nullptr;              ///< null: a point
  Mesh (*surface)(const Geometry&) = nullptr;                ///< closed and outward; null: none
  ShellMass (*shell)(const std::vector<double>&) = nullptr;  ///< exact; null: computed from the triangles of `surface`
  Vector3d (*extent)(const std::vector<double>&) =
      nullptr;                                            ///< widths along x y z for standing on and carrying objects
  void (*modernize)(std::vector<double>&) = nullptr;      ///< converts the sizes of older files
  std::string (*repair)(std::vector<double>&) = nullptr;  ///< makes sizes consistent; returns a warning or ""

  std::size_t sizes() const;  ///< number of `size_names`
  bool hasPoints() const { return data == Data::mesh || data == Data::core_points; }
};

/// The table in the order of the type numbers, without ShapeType::none.
std::span<const ShapeKind> shapeKinds();

/// The entry of a type; that of `none` has only a name. Throws ValueError for an invalid number.
const ShapeKind& shapeKind(ShapeType type);

/// Extent of a shape along its own z axis, m; 0 for shapes that neither stand on nor carry others.
double shapeHeight(ShapeType type, const std::vector<double>& size);

}  // namespace kinegraph::inline geometry_internal
