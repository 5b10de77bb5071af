#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph {

/// What shapes are shown with: mesh files, read once each, and surfaces with pictures on them.
class VisualMeshes {
 public:
  /// The mesh that is shown in place of `shape`, in the frame's coordinates; null if that is the shape's own geometry,
  /// as also where a file cannot be had.
  std::shared_ptr<const Geometry> of(const Shape& shape);

 private:
  using Covered = std::tuple<std::shared_ptr<const Geometry>, std::shared_ptr<const Image>, double, double>;

  std::shared_ptr<const Geometry> fromFile(const Shape& shape);

  std::map<std::string, std::shared_ptr<const Geometry>> meshes_;  ///< by path and pose; null: not to be had
  std::map<Covered, std::shared_ptr<const Geometry>>
      covered_;  ///< with pictures; null: there is nothing to put them on
};

}  // namespace kinegraph
