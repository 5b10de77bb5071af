#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/viewer/server.h"

namespace kinegraph {

/// A message for a browser. Large ones are shared by all browsers.
struct Outgoing {
  std::shared_ptr<const std::string> data;
  bool binary;
};

/// What is shown at present, and what of it has changed since any earlier revision. Not synchronized.
class ShownScene {
 public:
  /// What one browser has got so far.
  struct Seen {
    std::uint64_t revision = 0;
    std::set<int> meshes;  ///< those in use at that revision; a browser forgets the others
  };

  /// True if anything differs from before.
  bool update(std::span<const ViewItem> items);
  bool setText(std::string ShownScene::*field, const std::string& text);
  void setCamera(const Vector3d& position, const Vector3d& target);

  std::string title, message, error;

  /// The messages that bring a browser from `seen` to the present; `seen` is updated.
  std::vector<Outgoing> messagesSince(Seen& seen) const;

 private:
  /// A mesh as it is sent, under a number that is never used again.
  struct SentMesh {
    int number;
    std::shared_ptr<const std::string> data;
  };
  struct Shown {
    ViewItem item;
    std::shared_ptr<const SentMesh> mesh;
    std::uint64_t look_revision = 0, pose_revision = 0;
  };
  std::shared_ptr<const SentMesh> meshOf(const ViewItem& item);

  std::uint64_t revision_ = 1, count_revision_ = 1, text_revision_ = 1, camera_revision_ = 0;
  std::vector<Shown> frames_;
  std::map<std::shared_ptr<const Geometry>, std::shared_ptr<const SentMesh>> meshes_;  ///< those that frames show
  int next_mesh_ = 0;
  Vector3d camera_position_ = Vector3d::Zero(), camera_target_ = Vector3d::Zero();
};

}  // namespace kinegraph
