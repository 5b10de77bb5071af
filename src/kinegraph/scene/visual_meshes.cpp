#include "kinegraph/scene/visual_meshes.h"

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/geometry/mesh_file.h"

namespace kinegraph {

std::shared_ptr<const Geometry> VisualMeshes::of(const Shape& shape) {
  if (shape.visual_mesh.empty()) return nullptr;
  const std::string key = cat(shape.visual_mesh, " ", shape.visual_pose.numbers().transpose());
  const auto [place, is_new] = meshes_.try_emplace(key);
  if (!is_new) return place->second;
  try {
    Mesh mesh = readMeshFile(shape.visual_mesh);
    for (Vector3d& p : mesh.vertices) p = shape.visual_pose.p + shape.visual_pose.q * p;
    auto geometry = std::make_shared<Geometry>();
    geometry->type = ShapeType::mesh;
    geometry->mesh = std::make_shared<Mesh>(std::move(mesh));
    place->second = geometry;
  } catch (const FileError&) {  // optional: the shape itself is shown
  }
  return place->second;
}

}  // namespace kinegraph
