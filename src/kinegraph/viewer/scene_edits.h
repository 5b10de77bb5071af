#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph {

/// What people change in browsers: joint values and poses of frames. Browsers see the effect at once, on a copy of the
/// scene; the program's own scene takes the changes over when the program asks for them. For several threads.
class SceneEdits {
 public:
  /// The scene that commands refer to from now on. Changes that were not taken are kept while `structure` stays.
  void setScene(std::shared_ptr<const SceneTree> scene, int structure);

  /// Makes a change; the scene with it, or nothing if the command means nothing here.
  std::optional<EditedScene> apply(const Command& command);

  /// Moves all changes into `config`, which has the structure of the scene. True if there were any.
  bool takeInto(Config& config);

  bool hasAny() const;

  /// What there is to say about the scene with the changes.
  std::vector<SceneNote> notes();

  /// How near, m, shapes have to be that browsers want to see lines between; 0: none wants to.
  double margin() const;
  void forgetMargin();

 private:
  Config& edited();
  bool change(const Command& command);
  void setJoint(int joint, double value);
  void setAllJoints(const VectorXd& q);
  bool moveFrame(int id, const std::vector<double>& numbers);

  mutable std::mutex mutex_;
  std::shared_ptr<const SceneTree> scene_;
  int structure_ = 0;
  std::optional<Config> edited_;  ///< the scene with the changes; made when there is first something to change
  std::map<int, double> joints_;  ///< dof -> value
  std::map<int, Pose> frames_;    ///< frame -> pose in its parent, or in the world without one
  double margin_ = 0.;
  Rng random_;
};

}  // namespace kinegraph
