#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/collision/motion_check.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/tree/frame_data.h"
#include "kinegraph/scene/tree/name_index.h"

namespace kinegraph {
class ConfigViewer;
}

namespace kinegraph::inline scene_internal {

/// The frames of a configuration and the data compiled from them. Config and Frame are handles on it.
///
/// Every edit of a frame reports one of three changes: the structure (frames, parents, joints, shapes, contacts), the
/// constant poses and masses, or q. The KinematicModel, its Parameters and the State are updated on demand.
class SceneTree {
 public:
  SceneTree() = default;
  SceneTree(const SceneTree&) = delete;
  SceneTree& operator=(const SceneTree&) = delete;
  ~SceneTree();

  const std::vector<std::shared_ptr<FrameData>>& frames() const { return frames_; }

  /// Appends a frame; `parent` may be null.
  FrameData& add(std::string name, FrameData* parent);

  /// Removes a frame. Its children become roots and keep their world poses; joints that mimic its joint become
  /// independent.
  void remove(FrameData& frame);
  void clear();

  /// The first frame of that name, or null. The non-const overload builds the name index if needed.
  FrameData* find(std::string_view name) const;
  FrameData* find(std::string_view name) { return indexNames().find(name); }
  FrameData* findLast(std::string_view name);
  void rename(FrameData& frame, std::string name);

  /// The first frame of that name. Throws FrameNotFound with similar names; `who` is the calling function.
  FrameData& get(std::string_view name, std::string_view who) const;
  FrameData& get(std::string_view name, std::string_view who) { return indexNames().get(name, who); }
  std::vector<std::string> names() const;

  /// Links `frame` below `parent` and keeps its relative pose. Throws ValueError if that closes a loop.
  void link(FrameData& frame, FrameData& parent);

  /// Sorts the frames by depth, roots first, stably; ids are renumbered.
  void sortByDepth();

  /// Cuts `frame` from its parent; its `pose` is unchanged.
  void unlink(FrameData& frame);

  /// Appends deep copies of all frames of `other`, names prefixed. Returns the first, or null if there is none. The raw
  /// attributes dominate the cost and can be left out.
  FrameData* append(const SceneTree& other, const std::string& prefix, bool with_attributes = true);

  /// Returns a copy without attributes that later edits do not affect. While the structure is unchanged, copies without
  /// owners are reused and only values are copied.
  std::shared_ptr<const SceneTree> snapshot();

  void structureChanged() {
    ++structure_revision_;
    queried_since_edit_ = false;
  }
  void posesChanged() {
    for (Snapshot& snapshot : snapshots_) snapshot.is_stale = true;
    poses_stale_ = true;
    queried_since_edit_ = false;
  }
  /// Reports a change of one frame's constant pose.
  void poseChanged(const FrameData& frame) {
    queried_since_edit_ = false;
    for (Snapshot& snapshot : snapshots_) snapshot.noteMoved(frame.id);
    if (poses_stale_ || (!moved_.empty() && moved_.back() == &frame)) return;
    moved_.push_back(&frame);
    poses_stale_ = moved_.size() > kMaxMoved;
  }
  void jointsChanged() { q_stale_ = true; }
  void looksChanged(Shape& shape) {
    for (Snapshot& snapshot : snapshots_) snapshot.is_stale = true;
    shape.revision = ++looks_revision_;
  }

  std::uint64_t structureRevision() const { return structure_revision_; }

  /// The last compiled model, of this structure or an earlier one; null before the first compilation.
  const KinematicModel* compiled() const { return model_.get(); }

  /// Compiled on demand and shared until the structure changes.
  const std::shared_ptr<const KinematicModel>& model();
  const std::shared_ptr<const Parameters>& parameters();
  const State& state();

  /// Inertia of each link; collected on demand.
  const std::vector<LinkInertia>& inertias();

  /// The collidable pairs, placed by state().
  NearPairs& nearPairs();

  MotionChecker& motionChecker();

  /// World pose of a frame. The first query after an edit of poses, and many after one of the structure, are computed
  /// along the parents, so a scene built frame by frame is not compiled at every step. Further queries use the State.
  Pose worldPose(const FrameData& frame);

  VectorXd jointState();
  void setJointState(const double* q);

  std::shared_ptr<ConfigViewer> viewer;  ///< the viewer of this scene, shared by all handles; null until first shown

 private:
  static constexpr std::size_t kMaxMoved = 8;  ///< with more moved frames, all poses are collected again

  /// A copy of the scene, and the edits it lacks.
  struct Snapshot {
    std::shared_ptr<SceneTree> scene;
    std::vector<int> moved;  ///< ids of frames whose constant poses have changed
    bool is_stale = false;   ///< whether anything but the structure may have changed

    void noteMoved(int id) {
      if (is_stale || (!moved.empty() && moved.back() == id)) return;
      moved.push_back(id);
      is_stale = moved.size() > kMaxMoved;
    }
  };

  static constexpr std::size_t kFewFrames = 32;  ///< scenes up to this size are searched without an index
  static constexpr std::size_t kCompileSteps =
      16;  ///< compiling one frame costs as much as this number of steps to a parent

  const SceneTree& indexNames();
  Pose poseAlongParents(const FrameData& frame);
  void updateMovedParameters();
  void updateSnapshot(Snapshot& snapshot) const;
  void gatherJointState(double* q) const;

  std::vector<std::shared_ptr<FrameData>> frames_;
  NameIndex names_;
  std::size_t steps_to_parents_ = 0;  ///< steps since the structure was compiled
  std::uint64_t structure_revision_ = 1, compiled_revision_ = 0, looks_revision_ = 0;
  bool poses_stale_ = true, q_stale_ = true, bodies_stale_ = true, queried_since_edit_ = false;
  std::vector<const FrameData*> moved_;  ///< frames moved since the parameters were collected
  std::vector<FrameData*> dof_frames_;   ///< frames whose joints make up q, in its order
  std::shared_ptr<const KinematicModel> model_;
  std::shared_ptr<const Parameters> parameters_;
  std::shared_ptr<Parameters> previous_parameters_;  ///< the previous parameters
  std::vector<const FrameData*> previous_moved_;     ///< frames moved between the previous and the current parameters
  std::unique_ptr<State> state_;
  std::vector<LinkInertia> inertias_;  ///< for the current parameters; empty until needed
  VectorXd q_;                         ///< the q last passed to `state_`
  std::unique_ptr<NearPairs> near_pairs_;
  std::unique_ptr<MotionChecker> motion_checker_;  ///< for the current parameters
  std::vector<Snapshot> snapshots_;
  std::uint64_t snapshot_revision_ = 0;
};

/// Compiles the structure of a scene.
std::shared_ptr<const KinematicModel> compileModel(const SceneTree& scene);

/// Collects the constants of a compiled KinematicModel.
std::shared_ptr<const Parameters> collectParameters(const SceneTree& scene, const KinematicModel& model);

/// Updates the parameters after one frame was moved, including all frames fixed to it.
void updateParameters(const FrameData& frame, const KinematicModel& model, Parameters& parameters);

/// Inertia of each link of a compiled KinematicModel: the sum over its frames.
std::vector<LinkInertia> collectInertias(const SceneTree& scene, const KinematicModel& model,
                                         const Parameters& parameters);

/// Collision rules of the shapes of a scene; see Config::getCollidablePairs.
ContactRules contactRules(const SceneTree& scene);

}  // namespace kinegraph::inline scene_internal
