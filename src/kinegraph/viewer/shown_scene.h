#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/viewer/server.h"

namespace kinegraph {

/// A message for a browser.
struct Outgoing {
  std::string data;
  bool binary;
};

/// What is shown at present, and what of it has changed since any earlier revision. Not synchronized.
class ShownScene {
 public:
  /// What one browser has got so far.
  struct Seen {
    std::uint64_t revision = 0;
    std::vector<bool> meshes;
  };

  /// True if anything differs from before.
  bool update(std::span<const ViewItem> items);
  bool setText(std::string ShownScene::*field, const std::string& text);
  void setCamera(const Vector3d& position, const Vector3d& target);

  std::string title, message, error;

  /// The messages that bring a browser from `seen` to the present; `seen` is updated.
  std::vector<Outgoing> messagesSince(Seen& seen) const;

 private:
  struct Shown {
    ViewItem item;
    int mesh = -1;
    std::uint64_t look_revision = 0, pose_revision = 0;
  };
  int meshOf(const ViewItem& item);

  std::uint64_t revision_ = 1, count_revision_ = 1, text_revision_ = 1, camera_revision_ = 0;
  std::vector<Shown> frames_;
  std::map<std::shared_ptr<const Geometry>, int> mesh_index_;
  std::vector<std::string> meshes_;  ///< encoded
  Vector3d camera_position_ = Vector3d::Zero(), camera_target_ = Vector3d::Zero();
};

}  // namespace kinegraph
