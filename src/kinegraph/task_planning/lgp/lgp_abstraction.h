#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/manipulation_helper.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

/// What LgpTool asks of a domain: plans in logic, and what their actions ask of bodies. Python has it as
/// LGP_TAMP_Abstraction. Subclass it, or DefaultLgpAbstraction, for actions of your own:
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

  /// An abstraction of a scene, without actions. It sees what is changed in the scene later.
  explicit LgpAbstraction(const Config& C) : C(C.scene()) {}
  LgpAbstraction(const LgpAbstraction&) = delete;
  LgpAbstraction& operator=(const LgpAbstraction&) = delete;
  virtual ~LgpAbstraction() = default;

  const Config C;                               ///< the scene
  std::vector<std::string> explicitCollisions;  ///< names of frames, two by two, that do not overlap in any slice

  /// The next plan in logic; none if there is no further one.
  virtual std::optional<std::vector<TaskAction>> getNewActionSequence() { return std::nullopt; }

  /// Whether those were all plans that there are; false where the search for them was given up.
  virtual bool hasAllPlans() const { return true; }

  /// No further plan shall begin like that: it was found infeasible. An abstraction may ignore it.
  virtual void forbidBeginning(const std::vector<TaskAction>& plan) { (void)plan; }

  /// The waypoint problem of K actions, a slice each, without what the actions ask.
  virtual std::shared_ptr<Komo> setup_sequence(const Config& C, int K);

  /// The motion problem of K actions, kSteps slices each, free of collisions, that ends at rest; without what the actions
  /// ask.
  virtual std::shared_ptr<Komo> setup_motion(const Config& C, int K);

  /// Adds what an action asks of the waypoints. `time` is when it is done, in phases; `prev_action` is the action before
  /// it, empty if there is none. Throws ValueError for an action that is not known.
  virtual void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction& prev_action,
                                      const TaskAction& action);

  /// Adds what an action asks of the motion; by default what it asks of the waypoints.
  virtual void add_action_constraints_motion(const std::shared_ptr<Komo>& komo, double time,
                                             const TaskAction& prev_action, const TaskAction& action);

  /// Adds what the actions of a plan ask, of the motion or of the waypoints, then that the explicit pairs do not overlap.
  /// Throws ValueError for an action that is not known, and an odd number of names.
  virtual void add_all(const std::shared_ptr<Komo>& komo, const std::vector<TaskAction>& plan, bool motion);

  /// Makes the problems.
  virtual std::shared_ptr<ManipulationHelper> newHelper() const { return std::make_shared<ManipulationHelper>(); }

 protected:
  /// A problem of that many actions is set up.
  virtual void begin(int actions) { (void)actions; }
};

}  // namespace kinegraph
