#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph::inline scene_internal {

/// Visual geometry of shapes: mesh files, each read once, and textured surfaces.
class VisualMeshes {
 public:
  /// The mesh shown in place of `shape`, in the frame's coordinates; null if the shape's own geometry is shown or the
  /// file cannot be read.
  std::shared_ptr<const Geometry> of(const Shape& shape);

 private:
  using Covered = std::tuple<std::shared_ptr<const Geometry>, std::shared_ptr<const Image>, double, double>;

  std::shared_ptr<const Geometry> fromFile(const Shape& shape);

  std::map<std::string, std::shared_ptr<const Geometry>> meshes_;  ///< by path and pose; null: unreadable
  std::map<Covered, std::shared_ptr<const Geometry>> covered_;     ///< textured surfaces; null: no surface to texture
};

}  // namespace kinegraph::inline scene_internal
