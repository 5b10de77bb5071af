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

/// The frames of a configuration and what is compiled from them. Config and Frame are handles on it.
///
/// Whoever changes a frame says which of three things is no longer true: the structure (frames, parents, joints,
/// shapes, contacts), the constant poses and masses, or q. The Program, its Parameters and the State follow when they
/// are asked for.
class SceneTree {
 public:
  SceneTree() = default;
  SceneTree(const SceneTree&) = delete;
  SceneTree& operator=(const SceneTree&) = delete;
  ~SceneTree();

  const std::vector<std::shared_ptr<FrameData>>& frames() const { return frames_; }

  /// Appends a frame; `parent` may be null.
  FrameData& add(std::string name, FrameData* parent);

  /// Removes a frame. Its children become roots and stay where they are; joints that mimic it become joints of their
  /// own.
  void remove(FrameData& frame);
  void clear();

  /// The first frame of that name, or null. Who may edit the scene has its names indexed on the way.
  FrameData* find(std::string_view name) const;
  FrameData* find(std::string_view name) { return indexNames().find(name); }
  FrameData* findLast(std::string_view name);
  void rename(FrameData& frame, std::string name);

  /// The first frame of that name. Throws FrameNotFound with similar names; `who` is the call that asks.
  FrameData& get(std::string_view name, std::string_view who) const;
  FrameData& get(std::string_view name, std::string_view who) { return indexNames().get(name, who); }
  std::vector<std::string> names() const;

  /// Links `frame` below `parent` keeping its relative pose. Throws ValueError if that closes a loop.
  void link(FrameData& frame, FrameData& parent);

  /// Brings the frames into the order roots first, then by depth; those of one depth keep theirs. Ids follow.
  void sortByDepth();

  /// Cuts `frame` from its parent; the pose is left as it is.
  void unlink(FrameData& frame);

  /// Appends deep copies of all frames of `other`, names prefixed. Returns the first, or null if there is none.
  /// Attributes as read, which nothing here interprets, are most of the work and can be left out.
  FrameData* append(const SceneTree& other, const std::string& prefix, bool with_attributes = true);

  /// A copy without attributes that later edits do not touch. Copies that nobody holds any more are used again while
  /// the structure stays: then only values are copied.
  std::shared_ptr<const SceneTree> snapshot();

  void structureChanged() {
    ++structure_revision_;
    asked_since_edit_ = false;
  }
  void posesChanged() {
    for (Snapshot& snapshot : snapshots_) snapshot.is_stale = true;
    poses_stale_ = true;
    asked_since_edit_ = false;
  }
  /// The constant pose of one frame.
  void poseChanged(const FrameData& frame) {
    asked_since_edit_ = false;
    for (Snapshot& snapshot : snapshots_) snapshot.noteMoved(frame.id);
    if (poses_stale_ || (!moved_.empty() && moved_.back() == &frame)) return;
    moved_.push_back(&frame);
    poses_stale_ = moved_.size() > kMostMoved;
  }
  void jointsChanged() { q_stale_ = true; }
  void looksChanged(Shape& shape) {
    for (Snapshot& snapshot : snapshots_) snapshot.is_stale = true;
    shape.revision = ++looks_revision_;
  }

  std::uint64_t structureRevision() const { return structure_revision_; }

  /// What was compiled last, of this structure or an earlier one; null if nothing was.
  const KinematicModel* compiled() const { return model_.get(); }

  /// Compiled on demand and shared until the structure changes.
  const std::shared_ptr<const KinematicModel>& model();
  const std::shared_ptr<const Parameters>& parameters();
  const State& state();

  /// The collidable pairs, placed by state().
  NearPairs& nearPairs();

  MotionChecker& motionChecker();

  /// World pose of a frame. The first question after an edit of poses, and many after one of the structure, are answered
  /// along the parents, so that scenes can be built frame by frame without compiling them at every step; those that
  /// follow are answered by the State.
  Pose worldPose(const FrameData& frame);

  VectorXd jointState();
  void setJointState(const double* q);

  std::shared_ptr<ConfigViewer> viewer;  ///< what shows the scene to whoever has a handle on it; null until it is shown

 private:
  static constexpr std::size_t kMostMoved = 8;  ///< beyond that, all poses are collected anew

  /// A copy of the scene, and what it lacks of the edits since.
  struct Snapshot {
    std::shared_ptr<SceneTree> scene;
    std::vector<int> moved;  ///< ids of frames whose constant poses have changed
    bool is_stale = false;   ///< may anything have changed that keeps the structure?

    void noteMoved(int id) {
      if (is_stale || (!moved.empty() && moved.back() == id)) return;
      moved.push_back(id);
      is_stale = moved.size() > kMostMoved;
    }
  };

  static constexpr std::size_t kFewFrames = 32;     ///< found by looking at all
  static constexpr std::size_t kCompileSteps = 16;  ///< a frame takes as long to compile as so many steps to a parent

  const SceneTree& indexNames();
  Pose poseAlongParents(const FrameData& frame);
  void moveInParameters();
  void bringUpToDate(Snapshot& snapshot) const;
  void gatherJointState(double* q) const;

  std::vector<std::shared_ptr<FrameData>> frames_;
  NameIndex names_;
  std::size_t steps_to_parents_ = 0;  ///< since the structure was compiled
  std::uint64_t structure_revision_ = 1, compiled_revision_ = 0, looks_revision_ = 0;
  bool poses_stale_ = true, q_stale_ = true, bodies_stale_ = true, asked_since_edit_ = false;
  std::vector<const FrameData*> moved_;  ///< since the parameters were collected
  std::vector<FrameData*> dof_frames_;   ///< those whose joints make up q, in its order
  std::shared_ptr<const KinematicModel> model_;
  std::shared_ptr<const Parameters> parameters_;
  std::shared_ptr<Parameters> parameters_before_;  ///< the last ones
  std::vector<const FrameData*> moved_before_;     ///< between these two
  std::unique_ptr<State> state_;
  VectorXd q_;  ///< as last given to `state_`
  std::unique_ptr<NearPairs> near_pairs_;
  std::unique_ptr<MotionChecker> motion_checker_;  ///< of these parameters
  std::vector<Snapshot> snapshots_;
  std::uint64_t snapshot_revision_ = 0;
};

/// Compiles the structure of a scene.
std::shared_ptr<const KinematicModel> compileModel(const SceneTree& scene);

/// Collects the constants that belong to a compiled Program.
std::shared_ptr<const Parameters> collectParameters(const SceneTree& scene, const KinematicModel& model);

/// Brings those up to date of a frame that was moved, and of the frames that are fixed to it.
void updateParameters(const FrameData& frame, const KinematicModel& model, Parameters& parameters);

/// What each link of a compiled Program weighs: the sum of its frames' inertias.
std::vector<LinkInertia> collectInertias(const SceneTree& scene, const KinematicModel& model,
                                         const Parameters& parameters);

/// Which shapes of a scene may collide; the rule is at Config::getCollidablePairs.
ContactRules contactRules(const SceneTree& scene);

}  // namespace kinegraph
