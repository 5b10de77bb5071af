#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

struct aiScene;

namespace kinegraph::inline geometry_internal {

/// Reads a picture referenced by a mesh file, from the same folder. Returns null if it is missing or neither PNG nor
/// JPEG: the mesh is then shown in its colors. Appends the paths of the files that it looks for to `files`.
std::shared_ptr<const Image> imageBeside(const std::string& mesh_path, const std::string& name,
                                         std::vector<std::string>* files = nullptr);

/// The pictures of a mesh file's materials, each read once.
class MeshTextures {
 public:
  MeshTextures(const aiScene& scene, std::string mesh_path, std::vector<std::string>* files)
      : scene_(scene), mesh_path_(std::move(mesh_path)), files_(files) {}

  /// The picture of a material; null if it has none.
  std::shared_ptr<const Image> of(unsigned material);

 private:
  std::shared_ptr<const Image> read(unsigned material) const;

  const aiScene& scene_;
  std::string mesh_path_;
  std::vector<std::string>* files_;                          ///< paths of the files that were looked for, or null
  std::map<unsigned, std::shared_ptr<const Image>> images_;  ///< by material
};

/// Sets texture coordinates of the vertices from `first_vertex` on and, with an image, the image of the triangles from
/// `first_triangle` on. Non-finite coordinates become 0.
void addTexture(Mesh& mesh, std::size_t first_vertex, const std::vector<std::array<float, 2>>& coordinates,
                std::size_t first_triangle, std::shared_ptr<const Image> image);

}  // namespace kinegraph::inline geometry_internal
