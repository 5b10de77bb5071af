#include "kinegraph/scene/tree/visual_meshes.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/mesh_cache.h"
#include "kinegraph/geometry/shapes/textured_surface.h"

namespace kinegraph::inline scene_internal {

std::shared_ptr<const Geometry> VisualMeshes::of(const Shape& shape) {
  std::shared_ptr<const Geometry> geometry = fromFile(shape);
  if (!shape.texture) return geometry;
  const std::shared_ptr<const Geometry> bare = geometry ? geometry : shape.geometry;
  const auto [place, is_new] =
      covered_.try_emplace(Covered{bare, shape.texture, shape.texture_repeat[0], shape.texture_repeat[1]});
  if (is_new) {
    Mesh mesh = texturedSurface(*bare, shape.texture, shape.texture_repeat);
    if (!mesh.triangles.empty()) {
      auto covered = std::make_shared<Geometry>();
      covered->type = ShapeType::mesh;
      covered->mesh = std::make_shared<Mesh>(std::move(mesh));
      place->second = covered;
    }
  }
  return place->second ? place->second : geometry;
}

std::shared_ptr<const Geometry> VisualMeshes::fromFile(const Shape& shape) {
  if (shape.visual_mesh.empty()) return nullptr;
  const std::string key = cat(shape.visual_mesh, " ", shape.visual_pose.numbers().transpose());
  const auto [place, is_new] = meshes_.try_emplace(key);
  if (!is_new) return place->second;
  try {
    Mesh mesh = *sharedMeshFile(shape.visual_mesh);
    for (Vector3d& p : mesh.vertices) p = shape.visual_pose.p + shape.visual_pose.q * p;
    auto geometry = std::make_shared<Geometry>();
    geometry->type = ShapeType::mesh;
    geometry->mesh = std::make_shared<Mesh>(std::move(mesh));
    place->second = geometry;
  } catch (const FileError&) {  // optional: the shape itself is shown
  }
  return place->second;
}

}  // namespace kinegraph::inline scene_internal
