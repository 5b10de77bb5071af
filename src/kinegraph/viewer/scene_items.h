#pragma once

#include <memory>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/scene/tree/visual_meshes.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::inline viewer_internal {

/// The items by which a viewer shows a configuration. Values that depend on the structure are cached until it changes.
class SceneItems {
 public:
  void read(const Config& config);

  /// A counter that increases with changes of frames, joints or shapes, and with another scene.
  int structure() const { return structure_; }
  const std::vector<ViewItem>& items() const { return items_; }

  /// Returns the indices of items that differ from the read before, ascending.
  const std::vector<int>& changed() const { return changed_; }
  const ShownJoints& joints() const { return joints_; }

  /// Returns whether `config` is the scene of the last read, with the same structure.
  bool isOf(const Config& config) const;

 private:
  std::weak_ptr<const SceneTree> scene_;
  std::uint64_t scene_structure_ = 0;
  int structure_ = 0;
  std::vector<ViewItem> items_;
  std::vector<int> changed_;
  std::vector<RigidTransform> poses_;  ///< of the items
  /// The data that determine a frame's details; with a joint or exclusions, the structure matters, too.
  struct SentFrame {
    bool refers_to_others = false;  ///< it had a joint or exclusions
    SharedGraph attributes;
    std::optional<Inertia> inertia;
    std::weak_ptr<const Shape> shape;
    std::shared_ptr<const Geometry> geometry;
    std::uint64_t shape_revision = 0;  ///< revision of the shape
    int contact = 0;
    bool knows(const FrameData& frame) const;
    void remember(const FrameData& frame);
  };
  bool isUnchanged(const FrameData& frame, bool same_structure) const;

  std::vector<SentFrame> sent_;  ///< per frame, when its details were written
  ShownJoints joints_;
  VisualMeshes visual_meshes_;
};

/// Returns a frame's `.g` attributes without its pose and joint values, which change, and without long lists of
/// numbers.
std::string detailsOf(const FrameData& frame);

/// Returns the world poses of all frames.
std::vector<Pose> posesOf(const Config& config);

}  // namespace kinegraph::inline viewer_internal
