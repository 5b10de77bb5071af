#include "kinegraph/geometry/shapes/tessellation.h"

#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph::inline geometry_internal {

Mesh tessellate(const Geometry& geometry) {
  const ShapeKind& kind = shapeKind(geometry.type);
  return kind.surface ? kind.surface(geometry) : Mesh{};
}

}  // namespace kinegraph::inline geometry_internal
