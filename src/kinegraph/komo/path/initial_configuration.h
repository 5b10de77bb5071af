#pragma once

#include <memory>
#include <set>
#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

/// Snapshot of the configuration from which a problem is made. Later edits of the Config have no effect on it.
struct InitialConfiguration {
  InitialConfiguration() = default;
  explicit InitialConfiguration(const Config& config);

  bool empty() const { return !model; }

  /// Returns a copy of the scene at the initial q.
  Config config() const;

  /// Restores the attributes of the frames of `copy`, a copy of this scene; snapshots do not store them.
  void restoreAttributes(Config& copy) const;

  /// Copies the poses of frames that no joint moves. `config` has the same frames and joints.
  void transferPoses(const Config& config);

  bool isShared(int frame) const { return shared_joints.contains(frame); }

  std::shared_ptr<const SceneTree> tree;  ///< without the frames' attributes
  std::shared_ptr<const KinematicModel> model;
  std::shared_ptr<const Parameters> parameters;
  VectorXd q;
  std::vector<int> joint_frames;  ///< frames whose joints make up q
  std::set<int> shared_joints;    ///< those of joint_frames whose dofs are the same in all slices

 private:
  std::shared_ptr<const SceneTree> source_;  ///< the original scene, for the attributes
};

/// Copies the poses of frames without joint from `config` to a scene that started as a copy of the initial one. Only
/// frames with the same parent in both are changed.
void transferPoses(SceneTree& target, const Config& config);

}  // namespace kinegraph::inline komo_internal
