#include "kinegraph/rendering/mesh_library.h"

#include <algorithm>

namespace kinegraph {

namespace {

constexpr float kFloorHalf = 5.f;  // m

RenderMesh floorMesh() {
  const float h = kFloorHalf;
  return {{-h, -h, 0, h, -h, 0, h, h, 0, -h, h, 0}, {0, 0, 1}, {0, 1, 2, 0, 2, 3}, {0, 0, 0, 0, 0, 0}, std::nullopt};
}

}  // namespace

void MeshLibrary::append(const RenderMesh& mesh) {
  vertex_start_.push_back(int(vertices_.size() / 3));
  vertex_count_.push_back(int(mesh.vertices.size() / 3));
  normal_start_.push_back(int(normals_.size() / 3));
  normal_count_.push_back(int(mesh.normals.size() / 3));
  face_start_.push_back(int(faces_.size() / 3));
  face_count_.push_back(int(mesh.faces.size() / 3));
  vertices_.insert(vertices_.end(), mesh.vertices.begin(), mesh.vertices.end());
  normals_.insert(normals_.end(), mesh.normals.begin(), mesh.normals.end());
  faces_.insert(faces_.end(), mesh.faces.begin(), mesh.faces.end());
  face_normals_.insert(face_normals_.end(), mesh.face_normals.begin(), mesh.face_normals.end());
}

bool MeshLibrary::update(const Shapes& shapes) {
  const bool known =
      std::all_of(shapes.begin(), shapes.end(), [&](const auto& shape) { return meshes_.contains(shape); });
  if (known && !vertex_start_.empty()) return false;
  std::erase_if(meshes_, [&](const auto& entry) { return !shapes.contains(entry.first); });
  for (const auto& shape : shapes) {
    if (!meshes_.contains(shape)) meshes_[shape] = renderMeshes(*shape);
  }
  for (auto* numbers : {&vertex_start_, &vertex_count_, &normal_start_, &normal_count_, &face_start_, &face_count_,
                        &faces_, &face_normals_}) {
    numbers->clear();
  }
  vertices_.clear();
  normals_.clear();
  parts_.clear();
  append(floorMesh());
  for (const auto& [shape, meshes] : meshes_) {
    std::vector<Part>& parts = parts_[shape];
    for (const RenderMesh& mesh : meshes) {
      parts.push_back({int(vertex_start_.size()), mesh.color});
      append(mesh);
    }
  }
  none_.assign(vertex_start_.size(), -1);
  zeros_.assign(vertex_start_.size(), 0);
  return true;
}

void MeshLibrary::fill(mjModel& model) {
  model.nmesh = decltype(model.nmesh)(vertex_start_.size());
  model.nmeshvert = decltype(model.nmeshvert)(vertices_.size() / 3);
  model.nmeshnormal = decltype(model.nmeshnormal)(normals_.size() / 3);
  model.nmeshface = decltype(model.nmeshface)(faces_.size() / 3);
  model.mesh_vertadr = vertex_start_.data();
  model.mesh_vertnum = vertex_count_.data();
  model.mesh_normaladr = normal_start_.data();
  model.mesh_normalnum = normal_count_.data();
  model.mesh_faceadr = face_start_.data();
  model.mesh_facenum = face_count_.data();
  model.mesh_texcoordadr = none_.data();
  model.mesh_texcoordnum = zeros_.data();
  model.mesh_graphadr = none_.data();
  model.mesh_vert = vertices_.data();
  model.mesh_normal = normals_.data();
  model.mesh_face = faces_.data();
  model.mesh_facenormal = face_normals_.data();
  model.mesh_facetexcoord = nullptr;
}

}  // namespace kinegraph
