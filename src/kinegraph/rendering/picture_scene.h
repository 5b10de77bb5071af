#pragma once

#include <array>
#include <vector>

#include "kinegraph/rendering/picture_drawings.h"
#include "kinegraph/rendering/picture_store.h"
#include "kinegraph/rendering/shown_shapes.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline rendering_internal {

/// A shape at its pose.
struct PictureItem {
  const StoredMesh* stored;
  Eigen::Matrix4d pose;
  Vector4d color;
  bool is_symbol, has_color;
  bool is_image = false;         ///< shown in exactly its colors
  double width = 0., size = 0.;  ///< of a drawing's lines (pixels) and points (m); 0: as in scenes

  bool isTransparent() const { return color[3] < 1. && !is_symbol; }
  bool castsShadow() const {
    return color[3] >= 1. && !is_symbol && !is_image && stored->mesh.kind == PictureMesh::Kind::surface;
  }
  /// Returns the corners of a box around it, m in the world.
  std::array<Vector3d, 8> corners() const;
};

/// The visible shapes of a scene, and a ball around them, as the page computes it.
struct PictureScene {
  std::vector<PictureItem> items;
  Vector3d center = Vector3d::Zero();  ///< m
  double radius = 1.;
  double lowest = 0.;            ///< z, m
  bool has_transparent = false;  ///< shapes
};

/// Collects the shapes of a scene and drawings, and stores new ones on the graphics card. Their context must be in use.
/// Drawings do not change the ball, as on the page.
PictureScene pictureScene(SceneTree& tree, VisualMeshes& visual_meshes, PictureStore& store, bool visuals_only,
                          const std::vector<PictureDrawing>& drawings);

}  // namespace kinegraph::inline rendering_internal
