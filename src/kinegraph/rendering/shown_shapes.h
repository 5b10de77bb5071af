#pragma once

#include <memory>
#include <vector>

#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/scene/tree/visual_meshes.h"

namespace kinegraph::inline rendering_internal {

/// A shape in a picture.
struct ShownShape {
  int frame;                                 ///< its id, which is its index, too
  const Shape* shape;                        ///< owned by the frame
  std::shared_ptr<const Geometry> geometry;  ///< what is drawn: the shape's own geometry or its visual mesh
};

/// Returns whether a shape exists for collisions only: it collides, and its alpha is at most .25. The page has a switch
/// for such shapes; pictures omit them.
bool servesCollisionsOnly(const Shape& shape);

/// Returns the shapes that pictures show, by the rules of the page. `visuals_only` omits markers and transparent
/// shapes.
std::vector<ShownShape> shownShapes(const SceneTree& scene, VisualMeshes& visual_meshes, bool visuals_only);

}  // namespace kinegraph::inline rendering_internal
