#include "kinegraph/rendering/picture_scene.h"

#include <algorithm>

#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline rendering_internal {

namespace {

const Vector4d kUsualColor(.8, .8, .8, 1.);

/// Finds the ball around the box around the boxes of all items.
void findBall(PictureScene& scene) {
  Vector3d lower(-1., -1., 0.), upper(1., 1., 1.);
  bool first = true;
  for (const PictureItem& item : scene.items) {
    for (const Vector3d& p : item.corners()) {
      lower = first ? p : Vector3d(lower.cwiseMin(p));
      upper = first ? p : Vector3d(upper.cwiseMax(p));
      first = false;
    }
  }
  scene.center = .5 * (lower + upper);
  scene.radius = std::max(.5 * (upper - lower).norm(), 1e-4);
  scene.lowest = lower.z();
}

/// Adds drawings to the items.
void addDrawings(PictureScene& scene, const std::vector<PictureDrawing>& drawings, PictureStore& store) {
  for (const PictureDrawing& drawing : drawings) {
    PictureItem item;
    item.stored = &store.of(drawing.mesh);
    if (item.stored->mesh.parts.empty()) continue;
    item.pose = Eigen::Matrix4d::Identity();
    item.pose.topLeftCorner<3, 3>() = drawing.pose.q.toRotationMatrix();
    item.pose.topRightCorner<3, 1>() = drawing.pose.p;
    item.color = drawing.color;
    item.has_color = true;
    item.is_symbol =
        drawing.colors == PictureDrawing::Colors::symbol && drawing.mesh->kind == PictureMesh::Kind::surface;
    item.is_image = drawing.colors == PictureDrawing::Colors::image;
    item.width = drawing.width;
    item.size = drawing.size;
    scene.has_transparent = scene.has_transparent || item.isTransparent();
    for (const Vector3d& p : item.corners()) scene.lowest = std::min(scene.lowest, p.z());
    scene.items.push_back(item);
  }
}

}  // namespace

std::array<Vector3d, 8> PictureItem::corners() const {
  std::array<Vector3d, 8> corners;
  const PictureMesh& mesh = stored->mesh;
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d p;
    for (int k = 0; k < 3; ++k) p[k] = corner >> k & 1 ? mesh.upper[k] + size : mesh.lower[k] - size;
    corners[std::size_t(corner)] = pose.topLeftCorner<3, 3>() * p + pose.topRightCorner<3, 1>();
  }
  return corners;
}

PictureScene pictureScene(SceneTree& tree, VisualMeshes& visual_meshes, PictureStore& store, bool visuals_only,
                          const std::vector<PictureDrawing>& drawings) {
  PictureScene scene;
  const State& state = tree.state();
  for (const ShownShape& shown : shownShapes(tree, visual_meshes, visuals_only)) {
    PictureItem item;
    const std::vector<double>& size = shown.geometry->size;
    item.is_symbol = shapeKind(shown.geometry->type).is_symbol;
    item.stored = item.is_symbol ? &store.marker(size.empty() ? .1 : size.back()) : &store.of(shown.geometry);
    if (item.stored->mesh.parts.empty()) continue;
    const RigidTransform X_WG = state.pose(shown.frame);
    item.pose = Eigen::Matrix4d::Identity();
    item.pose.topLeftCorner<3, 3>() = X_WG.R;
    item.pose.topRightCorner<3, 1>() = X_WG.p;
    item.has_color = shown.shape->color.has_value();
    item.color = shown.shape->color.value_or(kUsualColor);
    scene.has_transparent = scene.has_transparent || item.isTransparent();
    scene.items.push_back(item);
  }
  findBall(scene);
  addDrawings(scene, drawings, store);
  store.tidy();
  return scene;
}

}  // namespace kinegraph::inline rendering_internal
