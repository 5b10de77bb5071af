#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/manipulation_helper.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

/// The domain of an LgpTool: plans in logic, and the constraints of their actions. In Python it is
/// LGP_TAMP_Abstraction. Subclass it, or DefaultLgpAbstraction, for your own actions:
///
///     class Visits : public DefaultLgpAbstraction {
///       using DefaultLgpAbstraction::DefaultLgpAbstraction;
///       void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction&,
///                                   const TaskAction& action) override {
///         komo->addObjective({time}, FS::positionDiff, {action[1], action[2]}, OT::eq, 10.);
///       }
///     };
///
/// All calls are made on the thread that calls LgpTool.
class LgpAbstraction {
 public:
  static constexpr int kSteps = 30;  ///< slices per action of a motion

  /// An abstraction without actions. It shares the scene, later changes included.
  explicit LgpAbstraction(const Config& C) : C(C.scene()) {}
  LgpAbstraction(const LgpAbstraction&) = delete;
  LgpAbstraction& operator=(const LgpAbstraction&) = delete;
  virtual ~LgpAbstraction() = default;

  const Config C;                               ///< the scene
  std::vector<std::string> explicitCollisions;  ///< pairs of names of frames that overlap in no slice

  /// The next plan in logic; none if there is no further one.
  virtual std::optional<std::vector<TaskAction>> getNewActionSequence() { return std::nullopt; }

  /// Whether all plans were enumerated; false if the search reached a limit.
  virtual bool hasAllPlans() const { return true; }

  /// Excludes plans that begin with these actions, which are infeasible. An abstraction may ignore it.
  virtual void forbidBeginning(const std::vector<TaskAction>& plan) { (void)plan; }

  /// Returns the waypoint problem of K actions, a slice each, without the constraints of the actions.
  virtual std::shared_ptr<Komo> setup_sequence(const Config& C, int K);

  /// Returns the motion problem of K actions, kSteps slices each, collision-free and with rest at the end, without the
  /// constraints of the actions.
  virtual std::shared_ptr<Komo> setup_motion(const Config& C, int K);

  /// Adds the constraints of an action to a waypoint problem. `time` is the end of the action in phases, `prev_action`
  /// the action before it, empty if there is none. Throws ValueError for an unknown action.
  virtual void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction& prev_action,
                                      const TaskAction& action);

  /// Adds the constraints of an action to a motion problem; by default those of the waypoints.
  virtual void add_action_constraints_motion(const std::shared_ptr<Komo>& komo, double time,
                                             const TaskAction& prev_action, const TaskAction& action);

  /// Adds the constraints of all actions of a plan to a motion or waypoint problem, then those of the explicit pairs.
  /// Throws ValueError for an unknown action and for an odd number of names.
  virtual void add_all(const std::shared_ptr<Komo>& komo, const std::vector<TaskAction>& plan, bool motion);

  /// Returns a helper that makes problems.
  virtual std::shared_ptr<ManipulationHelper> newHelper() const { return std::make_shared<ManipulationHelper>(); }

 protected:
  /// Called before a problem of that many actions is set up.
  virtual void begin(int actions) { (void)actions; }
};

}  // namespace kinegraph
