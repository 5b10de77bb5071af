#pragma once

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/logic/plan_search.h"
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

/// Actions from a `.lgp` file and the `.fol` file that it names:
///
///     fol: <kitchen.fol>
///     terminal: "(on tray cup) (on table jug)"
///     coll: [cup jug]          # pairs of frames that do not overlap, also in waypoints
///
/// The actions are pick_touch, pick_box, handover, place_straightOn, place_box, poseEq, gripper_push and end_push.
/// Older files call the first pick and the fourth place. Other actions need a subclass. In Python it is
/// default_LGP_TAMP_Abstraction.
class DefaultLgpAbstraction : public LgpAbstraction {
 public:
  /// Reads the files and the facts of the scene. `cancellation` is queried during the search in logic, and may throw.
  /// Throws FileError; ParseError with the position for invalid files, unknown words of the goal, and goals that no
  /// action reaches; FrameNotFound for a pair.
  DefaultLgpAbstraction(const Config& C, const std::string& lgp_file, CancellationToken cancellation = {});

  const LogicDomain& domain() const { return search_->problem().problem.domain; }

  /// The search that enumerates the plans.
  const std::shared_ptr<PlanSearch>& search() const { return search_; }

  /// The next plan in logic, the shortest first.
  std::optional<std::vector<TaskAction>> getNewActionSequence() override;
  bool hasAllPlans() const override { return search_->status() != PlanSearch::Status::limit; }
  void forbidBeginning(const std::vector<TaskAction>& plan) override;
  void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction& prev_action,
                              const TaskAction& action) override;

  // --- for actions of your own -------------------------------------------------------------------------------------

  /// Attaches an object to a frame from a time on (in phases), without a jump. In Python it is `switch`. Throws
  /// FrameNotFound.
  void switchTo(ManipulationHelper& m, double time, const std::string& frame, const std::string& obj);

  /// Slices per action of a problem: 1 for waypoints.
  int steps(const Komo& komo) const;

  /// Whether the plan of the last problem ends at a time.
  bool is_last(double time) const;

 protected:
  void begin(int actions) override;

 private:
  std::shared_ptr<PlanSearch> search_;
  std::exception_ptr interruption_;          ///< thrown by `cancellation` during a search
  std::map<std::string, std::string> held_;  ///< by object: the frame it is attached to, in the last problem
  int count_ = 1;                            ///< number of its actions
};

}  // namespace kinegraph
