#pragma once

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline collision_internal {

/// The motion of a convex body relative to solid cells, between two times. Local coordinates of the cells, m.
struct MotionAmongCells {
  const CollisionBody& convex;
  const CollisionBody& cells;
  RigidTransform begin, end;  ///< poses of the convex body
  double travel = 0.;         ///< bound of the length of the path of any of its points
  double bow = 0.;            ///< bound of the deviation of any of its points from the straight line between both ends
};

/// Whether a convex body keeps a margin from all solid cells throughout a motion. The search ends with the first cell
/// that is too near, or for which the bounds of the motion prove nothing.
struct CellVerdict {
  enum Kind {
    apart,
    near_begin,  ///< a cell is closer at the beginning
    near_end,    ///< ... at the end
    unknown,     ///< a cell keeps the margin at both ends, but not surely in between; impossible without travel
  };
  Kind kind = apart;
  double distance = 0.;  ///< of that cell, the lesser one of both ends, m
};

/// Checks a motion. `margin` plus the radius of the body must be positive, m.
///
/// Ever smaller cubes of cells are excluded in two ways: by their distances from the body at both ends, less the
/// travel, or by a direction along which the body is ahead of them at both ends by the margin and the bow. They are
/// normals between the body and the cells that were measured before; one of them excludes most of a surface.
CellVerdict separateFromCells(const MotionAmongCells& motion, double margin);

}  // namespace kinegraph::inline collision_internal
