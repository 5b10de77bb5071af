#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

struct aiScene;

namespace kinegraph {

/// A picture that a mesh file names, beside that file; null if there is none, or it is neither PNG nor JPEG: the mesh
/// is then shown in its colors.
std::shared_ptr<const Image> imageBeside(const std::string& mesh_path, const std::string& name);

/// The pictures of the materials of a mesh file, read once each.
class MeshTextures {
 public:
  MeshTextures(const aiScene& scene, std::string mesh_path) : scene_(scene), mesh_path_(std::move(mesh_path)) {}

  /// Null if the material has none.
  std::shared_ptr<const Image> of(unsigned material);

 private:
  std::shared_ptr<const Image> read(unsigned material) const;

  const aiScene& scene_;
  std::string mesh_path_;
  std::map<unsigned, std::shared_ptr<const Image>> images_;  ///< by material
};

/// Gives the vertices of a mesh from `first_vertex` texture coordinates, and with an image, its triangles from
/// `first_triangle` that image. Coordinates that are not finite count as 0.
void addTexture(Mesh& mesh, std::size_t first_vertex, const std::vector<std::array<float, 2>>& coordinates,
                std::size_t first_triangle, std::shared_ptr<const Image> image);

}  // namespace kinegraph
