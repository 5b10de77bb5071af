#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::inline viewer_internal {

/// Changes that users make in browsers: joint values and poses of frames. Browsers see the effect at once, on a copy of
/// the scene; the program applies the changes to its own scene with takeInto. Any browser can undo the last 100 edits.
/// Thread-safe.
class SceneEdits {
 public:
  /// Sets the scene of subsequent commands. Pending changes persist while `structure` stays the same.
  void setScene(std::shared_ptr<const SceneTree> scene, int structure);

  /// Applies a command. Returns the changed scene, or nothing for a command that does not apply.
  std::optional<EditedScene> apply(const Command& command);

  /// Moves all changes into `config`, which has the structure of the scene. Returns whether there were any.
  bool takeInto(Config& config);

  bool hasAny() const;

  /// Returns the warnings about the changed scene.
  std::vector<SceneWarning> warnings();

  /// Returns the distance (m) below which browsers show lines between shapes; 0: no browser shows them.
  double margin() const;
  void forgetMargin();

 private:
  /// Former values of what one edit changed. Successive edits of the same joint or frame, as by dragging, are one.
  struct Step {
    std::map<int, double> joints;  ///< dof -> value
    std::map<int, Pose> frames;    ///< frame -> pose in its parent, or in the world without one
    std::pair<int, int> edited;    ///< kind of the command, and its joint or frame
    std::chrono::steady_clock::time_point time;
  };
  Config& edited();
  /// Applies a command that edits the scene, and stores how to undo it.
  bool edit(const Command& command);
  void remember(Step step);
  /// Restores the values of the last step of `from`, and moves the present ones to `to`.
  bool restore(std::deque<Step>& from, std::deque<Step>& to);
  bool change(const Command& command);
  void setJoint(int joint, double value);
  void setAllJoints(const VectorXd& q);
  bool moveFrame(int id, const std::vector<double>& numbers);

  mutable std::mutex mutex_;
  std::shared_ptr<const SceneTree> scene_;
  int structure_ = 0;
  std::optional<Config> edited_;  ///< the changed scene; created with the first change
  std::map<int, double> joints_;  ///< dof -> value
  std::map<int, Pose> frames_;    ///< frame -> pose in its parent, or in the world without one
  std::deque<Step> undo_, redo_;
  double margin_ = 0.;
  Rng random_;
};

}  // namespace kinegraph::inline viewer_internal
