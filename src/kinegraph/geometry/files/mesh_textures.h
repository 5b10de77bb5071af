#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

struct aiScene;

namespace kinegraph {

/// Reads a picture referenced by a mesh file, from the same folder. Returns null if it is missing or neither PNG nor
/// JPEG: the mesh is then shown in its colors.
std::shared_ptr<const Image> imageBeside(const std::string& mesh_path, const std::string& name);

/// The pictures of a mesh file's materials, each read once.
class MeshTextures {
 public:
  MeshTextures(const aiScene& scene, std::string mesh_path) : scene_(scene), mesh_path_(std::move(mesh_path)) {}

  /// The picture of a material; null if it has none.
  std::shared_ptr<const Image> of(unsigned material);

 private:
  std::shared_ptr<const Image> read(unsigned material) const;

  const aiScene& scene_;
  std::string mesh_path_;
  std::map<unsigned, std::shared_ptr<const Image>> images_;  ///< by material
};

/// Sets texture coordinates of the vertices from `first_vertex` on and, with an image, the image of the triangles from
/// `first_triangle` on. Non-finite coordinates become 0.
void addTexture(Mesh& mesh, std::size_t first_vertex, const std::vector<std::array<float, 2>>& coordinates,
                std::size_t first_triangle, std::shared_ptr<const Image> image);

}  // namespace kinegraph
