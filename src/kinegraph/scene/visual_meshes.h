#pragma once

#include <map>
#include <memory>
#include <string>

#include "kinegraph/scene/frame_data.h"

namespace kinegraph {

/// The mesh files that shapes are shown with, read once each.
class VisualMeshes {
 public:
  /// The mesh that is shown in place of `shape`, in the frame's coordinates; null if it has none or the file cannot be had.
  std::shared_ptr<const Geometry> of(const Shape& shape);

 private:
  std::map<std::string, std::shared_ptr<const Geometry>> meshes_;  ///< by path and pose; null: not to be had
};

}  // namespace kinegraph
