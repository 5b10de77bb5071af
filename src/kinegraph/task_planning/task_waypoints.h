#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/task_planning/manipulation_helper.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_rules.h"

namespace kinegraph {

/// The waypoint problem of a sequence of actions, in one variant of each: one Komo with a slice per action, and grasps and
/// placements that all slices share. Rules add to it what their actions ask, through `komo()`, `m`, and the calls below;
/// times are in phases, that of the i-th action (from 0 on) is i + 1. Calls throw FrameNotFound for frames that are not
/// there.
class TaskWaypoints : public std::enable_shared_from_this<TaskWaypoints> {
 public:
  /// The problem without what the actions ask. `helper`: of another kind than ManipulationHelper; none: that.
  TaskWaypoints(const Config& C, std::vector<TaskAction> actions, std::vector<std::string> variants,
                std::shared_ptr<ManipulationHelper> helper = nullptr);

  /// Adds what all the actions ask. Throws NameError for an action that has no rule.
  void addActions(const TaskRules& rules);

  const std::shared_ptr<ManipulationHelper> m;  ///< of the problem
  const Config C;                               ///< the scene; with a large frame on places where something is laid
  const std::vector<TaskAction> actions;
  const std::vector<std::string> variants;

  Komo& komo() { return *m->komo; }

  /// From a time on the hand holds the object, in a pose that is found. `touching`: their surfaces touch, as where a stick
  /// takes something along; they are `gap` m apart.
  void attach(double time, const std::string& hand, const std::string& obj, bool touching = false, double gap = 0.);

  /// From a time on the object stands on a place, upright.
  void put(double time, const std::string& obj, const std::string& to);

  /// From a time on the object, a box, lies on a place with one of its faces up: x y z xNeg yNeg zNeg. Throws ValueError
  /// for another one.
  void lay(double time, const std::string& obj, const std::string& to, const std::string& face);

  /// Between `start`, when the pusher touches it, and `end` the object is pushed straight to a place, from behind, without
  /// turning.
  void push(double start, double end, const std::string& pusher, const std::string& obj, const std::string& to);

  /// A hand that has held a handle since the time before moves its door or drawer until it is open, or closed. Throws
  /// ValueError for what is no door.
  void guide(double time, const std::string& door, const std::string& handle, const std::string& hand, bool opens);

  /// A starting point, the variables of the problem: hands near what they do. `rng` draws placements and, where `grasps`,
  /// grasps; without one, placements are in the middle.
  VectorXd start(Rng* rng, bool grasps = true) const;

 private:
  /// Dofs of frames that were added; they are the first ones in x, in this order.
  struct Slot {
    enum class Kind { grasp, place, lay, push };
    Kind kind;
    int first;
    std::string frame;
    std::string face = {};  ///< of what is laid
  };

  void addSlot(Slot::Kind kind, const std::string& frame, int dofs, const std::string& face = {});
  void keepDoors();
  VectorXd startOf(std::size_t action, const VectorXd& before, std::map<std::string, Vector3d>& at,
                   const std::map<std::string, Vector3d>& offsets) const;
  void switchTo(double time, const std::string& frame, const std::string& obj);
  Vector3d startSlot(const Slot& slot, const Nlp& nlp, VectorXd& x, Rng* rng, bool grasps) const;

  const std::vector<TaskDoor> doors_;
  std::vector<Slot> slots_;
  int slot_dofs_ = 0;
  std::map<std::string, std::string> held_;                 ///< what each object moves with
  std::map<std::string, std::vector<std::string>> beside_;  ///< what was put on each place so far
};

/// With what all the actions ask.
std::shared_ptr<TaskWaypoints> makeTaskWaypoints(const Config& C, std::vector<TaskAction> actions,
                                                 std::vector<std::string> variants, const TaskRules& rules,
                                                 std::shared_ptr<ManipulationHelper> helper = nullptr);

}  // namespace kinegraph
