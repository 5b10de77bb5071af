#include "kinegraph/geometry/mesh_file.h"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

std::array<std::uint8_t, 4> bytes(const aiColor4D& color) {
  const auto byte = [](float x) { return std::uint8_t(std::lround(255.f * std::clamp(x, 0.f, 1.f))); };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

void append(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, Mesh& mesh) {
  const aiMatrix4x4 transform = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    aiColor4D diffuse(.8f, .8f, .8f, 1.f);
    if (part.mMaterialIndex < scene.mNumMaterials) {
      scene.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    }
    const std::uint32_t first = std::uint32_t(mesh.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = transform * part.mVertices[v];
      mesh.vertices.emplace_back(p.x, p.y, p.z);
      mesh.colors.push_back(bytes(part.HasVertexColors(0) ? part.mColors[0][v] : diffuse));
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 3) mesh.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
  for (unsigned child = 0; child < node.mNumChildren; ++child) append(scene, *node.mChildren[child], transform, mesh);
}

}  // namespace

Mesh readMeshFile(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw FileError(cat("mesh file '", path, "' does not exist"));
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (!scene || !scene->mRootNode) {
    throw FileError(cat("mesh file '", path, "' cannot be read: ", importer.GetErrorString()));
  }
  Mesh mesh;
  append(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  if (mesh.vertices.empty()) throw FileError(cat("mesh file '", path, "' holds no vertices"));
  const auto broken =
      std::find_if_not(mesh.vertices.begin(), mesh.vertices.end(), [](const Vector3d& p) { return p.allFinite(); });
  if (broken != mesh.vertices.end()) {
    throw FileError(cat("mesh file '", path, "': vertex ", broken - mesh.vertices.begin(), " is (", broken->transpose(),
                        "); coordinates must be finite"));
  }
  return mesh;
}

}  // namespace kinegraph
