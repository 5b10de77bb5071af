#pragma once

#include <memory>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {
class CollisionBody;
}

namespace kinegraph::inline geometry_internal {

struct CellField;

/// The numbers of a grid as a function of space: interpolated by smooth cubics (Catmull & Rom) along each axis. Beyond
/// the grid's box, at a distance r from its nearest point c, the field is sqrt(value(c)^2 + r^2), or value(c) + r if
/// that value is negative. If the values are distances, the former does not exceed the distance. Continuous everywhere;
/// its gradient is continuous within the box. Local coordinates, m.
struct GridField {
  GridField(std::shared_ptr<const Grid> grid, const Vector3d& size);

  /// The grid of a `cells` shape.
  explicit GridField(std::unique_ptr<const CellField> field);
  ~GridField();

  /// Not for cells.
  double value(const Vector3d& point, Vector3d& gradient) const;

  std::shared_ptr<const Grid> grid;        ///< null for cells
  std::unique_ptr<const CellField> cells;  ///< null for others
  Vector3d half;                           ///< half sides of the box
  Vector3d step;                           ///< spacing of the grid points
  double overhang = 0.;                    ///< maximum extent of the non-positive points beyond the box
  std::shared_ptr<const CollisionBody>
      surface;  ///< zero crossings on the edges of the grid; its corners if there are none; corners around solid cells
};

}  // namespace kinegraph::inline geometry_internal
