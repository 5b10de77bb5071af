#include "kinegraph/rendering/shown_shapes.h"

#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph::inline rendering_internal {

bool servesCollisionsOnly(const Shape& shape) {
  constexpr double kFaint = .25;  // the same threshold as on the page
  return shape.contact != 0 && shape.color && (*shape.color)[3] <= kFaint;
}

std::vector<ShownShape> shownShapes(const SceneTree& scene, VisualMeshes& visual_meshes, bool visuals_only) {
  std::vector<ShownShape> shapes;
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || frame->shape->geometry->type == ShapeType::none) continue;
    const Shape& shape = *frame->shape;
    const bool is_helper = shapeKind(shape.geometry->type).is_symbol || (shape.color && (*shape.color)[3] < 1.);
    const bool is_invisible = shape.color && (*shape.color)[3] <= 0.;
    if ((visuals_only && is_helper) || is_invisible || servesCollisionsOnly(shape)) continue;
    const std::shared_ptr<const Geometry> visual = visual_meshes.of(shape);
    shapes.push_back({frame->id, &shape, visual ? visual : shape.geometry});
  }
  return shapes;
}

}  // namespace kinegraph::inline rendering_internal
