#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/task_planning/manipulation_helper.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {
struct Placement;
struct TaskDoor;
}

namespace kinegraph {

/// Default of the clearance that planTask keeps between all bodies whose contact is not meant, m.
inline constexpr double kTaskMargin = .005;

/// Default speed of hands close to where they take or leave something, m/s.
inline constexpr double kContactSpeed = .15;

/// The waypoint problem of a sequence of actions in one variant each: a Komo with a slice per action, and grasps and
/// placements shared by all slices. Rules add the constraints of their actions through `komo()`, `m`, and the calls
/// below. Times are in phases; action i, counted from 0, ends at i + 1. Calls throw FrameNotFound for unknown frames.
class TaskWaypoints : public std::enable_shared_from_this<TaskWaypoints> {
 public:
  /// Makes the problem without the constraints of the actions. `helper`: null for a ManipulationHelper. `margin`:
  /// preferred clearance of all pairs, m. `later`: actions that follow; placements leave room for theirs.
  TaskWaypoints(const Config& C, std::vector<TaskAction> actions, std::vector<std::string> variants,
                std::shared_ptr<ManipulationHelper> helper = nullptr, double margin = kTaskMargin,
                const std::vector<TaskAction>& later = {});
  ~TaskWaypoints();
  TaskWaypoints(const TaskWaypoints&) = delete;

  /// Adds the constraints of all actions. Throws NameError for an action without a rule.
  void addActions(const TaskRules& rules);

  const std::shared_ptr<ManipulationHelper> m;  ///< helper for the problem
  const Config C;                               ///< the scene, with a large frame on places for `lay`
  const std::vector<TaskAction> actions;
  const std::vector<std::string> variants;
  const double margin;  ///< m

  Komo& komo() { return *m->komo; }

  /// Lets a hand hold an object from a time on, in a pose that the solver finds. `touching`: the surfaces are `gap` m
  /// apart, as of a stick that takes an object along.
  void attach(double time, const std::string& hand, const std::string& obj, bool touching = false, double gap = 0.);

  /// Lets an object rest on a place from a time on, as it lies now or upright (variant `upright`): with its whole
  /// footprint on it if there is room, else with its center well inside; close to the choice of placementsOf.
  void put(double time, const std::string& obj, const std::string& to);

  /// Lets a box lie on a place from a time on, with a face up: x y z xNeg yNeg zNeg. Throws ValueError for other faces.
  void lay(double time, const std::string& obj, const std::string& to, const std::string& face);

  /// Pushes an object straight to a place between `start`, the first contact, and `end`, from behind and without
  /// rotation.
  void push(double start, double end, const std::string& pusher, const std::string& obj, const std::string& to);

  /// Opens or closes a door or drawer by a hand that has held its handle since the action before. Throws ValueError if
  /// the frame is no door.
  void guide(double time, const std::string& door, const std::string& handle, const std::string& hand, bool opens);

  /// Returns an initial guess of the variables, with hands close to the objects that they handle. `rng` samples
  /// placements and, with `grasps`, grasps; without `rng`, placements are central.
  VectorXd start(Rng* rng, bool grasps = true) const;

 private:
  enum class SlotKind;
  struct Slot;

  /// Dofs of an added frame. Slots are the first dofs in x, in this order.
  void addSlot(SlotKind kind, const std::string& frame, int dofs, const std::string& face = {});
  void keepDoors();
  VectorXd startOf(std::size_t action, const VectorXd& before, std::map<std::string, Vector3d>& at,
                   const std::map<std::string, Vector3d>& offsets, int angles) const;
  void switchTo(double time, const std::string& frame, const std::string& obj);
  Vector3d startSlot(const Slot& slot, VectorXd& x, Rng* rng, bool grasps) const;

  const std::vector<TaskDoor> doors_;
  const std::vector<std::optional<Placement>> placements_;  ///< of each action
  std::vector<Slot> slots_;
  int slot_dofs_ = 0;
  std::map<std::string, std::string> held_;                 ///< by object: the frame it is attached to
  std::map<std::string, std::vector<std::string>> beside_;  ///< by place: the objects put there so far
};

/// Makes the problem with the constraints of all actions.
std::shared_ptr<TaskWaypoints> makeTaskWaypoints(const Config& C, std::vector<TaskAction> actions,
                                                 std::vector<std::string> variants, const TaskRules& rules,
                                                 std::shared_ptr<ManipulationHelper> helper = nullptr,
                                                 double margin = kTaskMargin,
                                                 const std::vector<TaskAction>& later = {});

}  // namespace kinegraph
