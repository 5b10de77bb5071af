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
