#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/logic/plan_search.h"
#include "kinegraph/task_planning/search/task_proofs.h"

namespace kinegraph::inline task_planning_internal {

/// The logic of a task: enumerates sequences of actions that reach the goal, the shortest first, under constraints that
/// proofs and failures in geometry add.
class TaskLogic {
 public:
  using Actions = std::vector<TaskAction>;

  /// `cancellation` is queried in `next`.
  TaskLogic(LogicDomain domain, std::vector<Literal> goal, std::vector<Literal> start, CancellationToken cancellation);
  TaskLogic(const TaskLogic&) = delete;
  TaskLogic& operator=(const TaskLogic&) = delete;

  const std::vector<Literal>& goal() const { return goal_; }
  const std::vector<Literal>& start() const { return start_; }  ///< facts of the scene
  const GroundProblem& problem() const { return search_->problem(); }
  Actions allActions() const;

  /// The next sequence of actions; none if there is no further one. Throws what `cancellation` throws.
  std::optional<Actions> next();

  bool isCutOff() const { return search_->status() == PlanSearch::Status::limit; }  ///< did `next` reach its limit?
  long expansions() const { return search_->expansions(); }

  /// Facts before and after each action.
  std::vector<std::vector<Literal>> statesAlong(const Actions& actions) const;

  /// Excludes actions that are proved to be impossible.
  void exclude(std::vector<ImpossibleAction> proofs);
  const std::vector<ImpossibleAction>& proofs() const { return proofs_; }

  /// An action is impossible in states in which all of the facts hold; without facts, always.
  void forbid(const TaskAction& action, const std::vector<Literal>& facts);

  /// No further sequence begins with these actions.
  void forbidPrefix(const Actions& actions);

  /// Whether an action can change a fact.
  bool isChangeable(const Literal& fact) const { return problem().factNumber(fact) >= 0; }

  /// Forgets all sequences and prohibitions: only `exclude` stays in force.
  void startOver();

  /// Objects may also be put down to be grasped differently. Starts over.
  void allowRegrasps();

  /// The reason for which proofs and logic leave no sequence at all.
  std::string infeasibility() const;

 private:
  void restart(std::vector<Literal> start);

  const LogicDomain domain_;
  const std::vector<Literal> goal_;
  const CancellationToken cancellation_;
  std::vector<Literal> start_;
  LogicProblem problem_;
  std::unique_ptr<PlanSearch> search_;
  std::exception_ptr interruption_;  ///< thrown by `cancellation_` during a search
  std::vector<ImpossibleAction> proofs_;
};

}  // namespace kinegraph::inline task_planning_internal
