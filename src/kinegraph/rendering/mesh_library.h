#pragma once

#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/rendering/render_mesh.h"

namespace kinegraph::inline rendering_internal {

/// The meshes and images of all shapes in a rendering context, in the arrays of a MuJoCo model. Mesh 0 is the floor.
class MeshLibrary {
 public:
  /// A part of a shape: the index of its mesh, its own color if it has one, and the index of the material with its
  /// image, or -1.
  struct Part {
    int mesh;
    std::optional<Vector4d> color;
    int material = -1;
  };
  using Shapes = std::set<std::shared_ptr<const Geometry>>;

  /// Adds new shapes; then also removes unused ones. Returns whether anything changed. Throws FileError for a damaged
  /// image.
  bool update(const Shapes& shapes);

  const std::vector<Part>& parts(const std::shared_ptr<const Geometry>& shape) const { return parts_.at(shape); }

  /// Sets the mesh arrays of `model` to those of this library.
  void fill(mjModel& model);

 private:
  template <class Pointer>
  using Items = std::vector<std::remove_pointer_t<Pointer>>;  // the type depends on the version of MuJoCo

  void append(const RenderMesh& mesh);
  int materialOf(const std::shared_ptr<const Image>& image);

  std::map<std::shared_ptr<const Geometry>, std::vector<Part>> parts_;
  std::map<std::shared_ptr<const Geometry>, std::vector<RenderMesh>> meshes_;
  std::vector<int> vertex_start_, vertex_count_, normal_start_, normal_count_, face_start_, face_count_, none_;
  std::vector<float> vertices_, normals_;
  std::vector<int> faces_, face_normals_;
  std::vector<int> texcoord_start_, texcoord_count_, face_texcoords_;
  std::vector<float> texcoords_;
  std::map<std::string_view, int> materials_;  ///< by the image's bytes, which a mesh owns
  std::vector<int> texture_of_material_, texture_types_, texture_widths_, texture_heights_, texture_channels_, linear_;
  Items<decltype(mjModel::tex_adr)> texture_start_;
  Items<decltype(mjModel::tex_data)> texture_bytes_;
  std::unique_ptr<std::remove_pointer_t<decltype(mjModel::mat_texuniform)>[]> not_uniform_;
  std::vector<float> ones_;
};

}  // namespace kinegraph::inline rendering_internal
