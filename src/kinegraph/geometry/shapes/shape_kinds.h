#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/geometry/shapes/mass.h"

namespace kinegraph {

/// What distances see of a shape: a core swept by a ball. Where a core has an axis, it is z. Lengths in m.
struct ShapeCore {
  /// The last five are made of the vertices of the shape's mesh (their hull; the hulls of the parts that it names; each
  /// one; a segment for every two), or of its grid.
  enum class Form { point, segment, box, cylinder, box_ellipsoid, hull, hulls_of_parts, points, segments, grid };
  Form form = Form::point;
  double radius = 0.;                      ///< of the ball
  double half_length = 0.;                 ///< of segment and cylinder
  double core_radius = 0.;                 ///< of a cylinder
  Vector3d half_sides = Vector3d::Zero();  ///< of box and box_ellipsoid
  Vector3d radii = Vector3d::Zero();       ///< of the ellipsoid in a box_ellipsoid
};

/// A row of the table of shapes: all that the program knows of a type. What is null or false need not be told.
struct ShapeKind {
  /// What a shape has besides its sizes: a mesh that is what there is to see, the core points that its surface is
  /// swept along, or a grid of numbers.
  enum class Data { none, mesh, core_points, grid };

  /// The simple body that it counts as, sharp or rounded, where facts, grasps and placements speak of such; its first
  /// sizes are x y z of a box, the radius of a ball, the length and the radius of the other two.
  enum class Body { other, box, ball, capsule, cylinder };

  ShapeType type = ShapeType::none;
  std::string_view name;           ///< the word of files
  std::string_view size_names{};   ///< a word for each entry of `Geometry::size`
  std::size_t optional_sizes = 0;  ///< entries that may be given although they have no name
  Data data = Data::none;
  Body body = Body::other;
  bool is_symbol = false;    ///< marks a place, and is no body: never collides, no file format writes it
  bool has_inertia = false;  ///< its surface carries a mass
  bool is_turned = false;    ///< about z: pictures are wound around it
  bool is_drawn_by_page =
      false;  ///< the page builds it from type and sizes (viewer/src/primitives.ts), else gets triangles

  ShapeCore (*core)(const Geometry&) = nullptr;              ///< null: a point
  Mesh (*surface)(const Geometry&) = nullptr;                ///< closed and outward; null: none
  ShellMass (*shell)(const std::vector<double>&) = nullptr;  ///< exact; null: of the triangles of `surface`
  Vector3d (*extent)(const std::vector<double>&) = nullptr;  ///< widths along x y z of what stands and carries
  void (*modernize)(std::vector<double>&) = nullptr;         ///< makes today's sizes of those of older files
  std::string (*repair)(std::vector<double>&) = nullptr;     ///< makes sizes fit each other, returns a warning or ""

  std::size_t sizes() const;  ///< how many `size_names` there are
  bool hasPoints() const { return data == Data::mesh || data == Data::core_points; }
};

/// The table, without ShapeType::none, in the order of the numbers of the types.
std::span<const ShapeKind> shapeKinds();

/// The row of a type; that of `none` has nothing but its name. Throws ValueError for numbers that are no type.
const ShapeKind& shapeKind(ShapeType type);

/// Extent of a shape along its own z axis, m; 0 for those that do not stand on or carry others.
double shapeHeight(ShapeType type, const std::vector<double>& size);

}  // namespace kinegraph
