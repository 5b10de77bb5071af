#pragma once

#include <memory>
#include <set>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The configuration that a motion problem is made from, as it was then; later edits of it do not show here.
struct InitialConfiguration {
  InitialConfiguration() = default;
  explicit InitialConfiguration(const Config& config);

  bool empty() const { return !model; }

  /// A copy of the scene, at the q that was given.
  Config config() const;

  /// Gives the frames of `copy`, a copy of this scene, the attributes that they had: snapshots have none.
  void restoreAttributes(Config& copy) const;

  /// Takes over the poses of frames that no joint moves. `config` has the same frames and joints.
  void transferPoses(const Config& config);

  bool isShared(int frame) const { return shared_joints.contains(frame); }

  std::shared_ptr<const SceneTree> tree;  ///< without the frames' attributes
  std::shared_ptr<const KinematicModel> model;
  std::shared_ptr<const Parameters> parameters;
  VectorXd q;
  std::vector<int> joint_frames;  ///< those whose joints make up q
  std::set<int> shared_joints;    ///< of these, those whose dofs are the same in all slices

 private:
  std::shared_ptr<const SceneTree> source_;  ///< where it came from, for the attributes
};

/// The same for any scene that began as a copy of the given one: frames that hang, without a joint, below the same
/// parent in both take over the pose that they have in `config`.
void transferPoses(SceneTree& target, const Config& config);

}  // namespace kinegraph
