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
#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

namespace kinegraph {

/// Actions from a `.lgp` file and the `.fol` file that it names:
///
///     fol: <kitchen.fol>
///     terminal: "(on tray cup) (on table jug)"
///     coll: [cup jug]          # pairs of frames that do not overlap, also in waypoints
///
/// They are pick_touch, pick_box, handover, place_straightOn, place_box, poseEq, gripper_push, end_push; pick and place, as
/// files of earlier years call the first and the fourth. Actions of other names need a subclass. Python has it as
/// default_LGP_TAMP_Abstraction.
class DefaultLgpAbstraction : public LgpAbstraction {
 public:
  /// Reads the files, and what the scene says in logic. `cancellation` is asked now and then while logic is searched, and may
  /// throw to end it. Throws FileError; ParseError, with the place, for files that are wrong, words of the goal that are
  /// not known, and goals that no action leads to; FrameNotFound for a pair.
  DefaultLgpAbstraction(const Config& C, const std::string& lgp_file, CancellationToken cancellation = {});

  const LogicDomain& domain() const { return search_->problem().problem.domain; }

  /// The search that plans come from.
  const std::shared_ptr<PlanSearch>& search() const { return search_; }

  /// The next plan in logic, the shortest first.
  std::optional<std::vector<TaskAction>> getNewActionSequence() override;
  bool hasAllPlans() const override { return search_->status() != PlanSearch::Status::limit; }
  void forbidBeginning(const std::vector<TaskAction>& plan) override;
  void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction& prev_action,
                              const TaskAction& action) override;

  // --- for actions of your own -------------------------------------------------------------------------------------

  /// From a time on (in phases) an object sits at a frame; it does not jump there. Python calls it `switch`. Throws
  /// FrameNotFound.
  void switchTo(ManipulationHelper& m, double time, const std::string& frame, const std::string& obj);

  /// Slices per action of a problem that was set up: 1 for waypoints.
  int steps(const Komo& komo) const;

  /// Does the plan end at that time, of the problem that was set up last?
  bool is_last(double time) const;

 protected:
  void begin(int actions) override;

 private:
  std::shared_ptr<PlanSearch> search_;
  std::exception_ptr interruption_;          ///< by `cancellation`, while logic was searched
  std::map<std::string, std::string> held_;  ///< what each object sits at, in the problem that was set up last
  int count_ = 1;                            ///< of its actions
};

}  // namespace kinegraph
