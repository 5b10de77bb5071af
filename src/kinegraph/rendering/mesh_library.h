#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "kinegraph/rendering/mujoco.h"
#include "kinegraph/rendering/render_mesh.h"

namespace kinegraph {

/// The meshes of all shapes that a rendering context knows, as a MuJoCo model lists them. Mesh 0 is the floor.
class MeshLibrary {
 public:
  /// A part of a shape: the number of its mesh, and its colour if it has its own.
  struct Part {
    int mesh;
    std::optional<Vector4d> color;
  };
  using Shapes = std::set<std::shared_ptr<const Geometry>>;

  /// Takes in what is new, and forgets everything that is not used any more when something is. True if anything
  /// changed.
  bool update(const Shapes& shapes);

  const std::vector<Part>& parts(const std::shared_ptr<const Geometry>& shape) const { return parts_.at(shape); }

  /// Points the mesh arrays of `model` into this library.
  void fill(mjModel& model);

 private:
  void append(const RenderMesh& mesh);

  std::map<std::shared_ptr<const Geometry>, std::vector<Part>> parts_;
  std::map<std::shared_ptr<const Geometry>, std::vector<RenderMesh>> meshes_;
  std::vector<int> vertex_start_, vertex_count_, normal_start_, normal_count_, face_start_, face_count_, none_, zeros_;
  std::vector<float> vertices_, normals_;
  std::vector<int> faces_, face_normals_;
};

}  // namespace kinegraph
