#pragma once

#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/rendering/render_mesh.h"

namespace kinegraph {

/// The meshes of all shapes that a rendering context knows, and the pictures on them, as a MuJoCo model lists them.
/// Mesh 0 is the floor.
class MeshLibrary {
 public:
  /// A part of a shape: the number of its mesh, its color if it has its own, and the number of the material with its
  /// picture, or -1.
  struct Part {
    int mesh;
    std::optional<Vector4d> color;
    int material = -1;
  };
  using Shapes = std::set<std::shared_ptr<const Geometry>>;

  /// Takes in what is new, and forgets everything that is not used any more when something is. True if anything
  /// changed. Throws FileError for a damaged picture.
  bool update(const Shapes& shapes);

  const std::vector<Part>& parts(const std::shared_ptr<const Geometry>& shape) const { return parts_.at(shape); }

  /// Points the mesh arrays of `model` into this library.
  void fill(mjModel& model);

 private:
  template <class Pointer>
  using Items = std::vector<std::remove_pointer_t<Pointer>>;  // whose type depends on the version of MuJoCo

  void append(const RenderMesh& mesh);
  int materialOf(const std::shared_ptr<const Image>& image);

  std::map<std::shared_ptr<const Geometry>, std::vector<Part>> parts_;
  std::map<std::shared_ptr<const Geometry>, std::vector<RenderMesh>> meshes_;
  std::vector<int> vertex_start_, vertex_count_, normal_start_, normal_count_, face_start_, face_count_, none_;
  std::vector<float> vertices_, normals_;
  std::vector<int> faces_, face_normals_;
  std::vector<int> texcoord_start_, texcoord_count_, face_texcoords_;
  std::vector<float> texcoords_;
  std::map<std::string_view, int> materials_;  ///< by the bytes of the picture, which belong to a mesh
  std::vector<int> texture_of_material_, texture_types_, texture_widths_, texture_heights_, texture_channels_, linear_;
  Items<decltype(mjModel::tex_adr)> texture_start_;
  Items<decltype(mjModel::tex_data)> texture_bytes_;
  std::unique_ptr<std::remove_pointer_t<decltype(mjModel::mat_texuniform)>[]> not_uniform_;
  std::vector<float> ones_;
};

}  // namespace kinegraph
