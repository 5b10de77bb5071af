#pragma once

#include <memory>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph {

class CollisionBody;

/// The numbers of a grid as a function of space: interpolated by cubics that are smooth (Catmull & Rom) along each
/// axis. Beyond the grid's box, at a distance r from its nearest point c, it is sqrt(value(c)^2 + r^2), which is not
/// more than the distance if the values are distances, or value(c) + r where that value is negative. Continuous
/// everywhere, within the box with its gradient. Local coordinates, m.
struct GridField {
  GridField(std::shared_ptr<const Grid> grid, const Vector3d& size);
  ~GridField();

  double value(const Vector3d& point, Vector3d& gradient) const;

  std::shared_ptr<const Grid> grid;
  Vector3d half;         ///< half sides of the box
  Vector3d step;         ///< between grid points
  double overhang = 0.;  ///< how far the points that are not positive may reach beyond the box
  std::shared_ptr<const CollisionBody>
      surface;  ///< the points where edges of the grid cross zero; its corners if none do
};

}  // namespace kinegraph
