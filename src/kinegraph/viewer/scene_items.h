#pragma once

#include <memory>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/visual_meshes.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph {

/// A configuration as a viewer shows it. What follows from the structure is kept until that changes.
class SceneItems {
 public:
  void read(const Config& config);

  /// One more than before whenever frames, joints or shapes have changed, or another scene is shown.
  int structure() const { return structure_; }
  const std::vector<ViewItem>& items() const { return items_; }
  const std::vector<ShownJoint>& joints() const { return joints_; }

  /// True if `config` is the scene that was read last, and has the same structure.
  bool isOf(const Config& config) const;

 private:
  std::weak_ptr<const SceneTree> scene_;
  std::uint64_t scene_structure_ = 0;
  int structure_ = 0;
  std::vector<ViewItem> items_;
  /// What the details of a frame follow from; with a joint or exclusions, from the structure, too.
  struct Told {
    bool refers_to_others = false;  ///< it had such
    SharedGraph attributes;
    std::optional<Inertia> inertia;
    std::weak_ptr<const Shape> shape;
    std::shared_ptr<const Geometry> geometry;
    std::uint64_t look = 0;  ///< revision of the shape
    int contact = 0;
    bool knows(const FrameData& frame) const;
    void remember(const FrameData& frame);
  };
  bool saysTheSame(const FrameData& frame, bool same_structure) const;

  std::vector<Told> told_;  ///< per frame, when its details were written
  std::vector<ShownJoint> joints_;
  VisualMeshes visual_meshes_;
};

/// What a `.g` file would say of a frame, but for its pose and joint values, which change, and long lists of numbers.
std::string detailsOf(const FrameData& frame);

/// World poses of all frames.
std::vector<Pose> posesOf(const Config& config);

}  // namespace kinegraph
