#include "kinegraph/task_planning/search/task_logic.h"

#include "kinegraph/logic/grounding.h"
#include "kinegraph/task_planning/search/task_conflicts.h"

namespace kinegraph::inline task_planning_internal {

TaskLogic::TaskLogic(LogicDomain domain, std::vector<Literal> goal, std::vector<Literal> start,
                     CancellationToken cancellation)
    : domain_(std::move(domain)), goal_(std::move(goal)), cancellation_(std::move(cancellation)) {
  restart(std::move(start));
}

void TaskLogic::restart(std::vector<Literal> start) {
  start_ = std::move(start);
  problem_ = {"problem", domain_, {}, domain_.start, goal_};
  problem_.start.insert(problem_.start.end(), start_.begin(), start_.end());
  PlanSearch::Options options;
  options.cancellation = [this] {
    try {
      cancellation_.check();
    } catch (...) {
      interruption_ = std::current_exception();
    }
    return bool(interruption_);
  };
  search_ = std::make_unique<PlanSearch>(ground(problem_), options);
}

TaskLogic::Actions TaskLogic::allActions() const {
  Actions all;
  for (int a = 0; a < int(problem().actions.size()); ++a) all.push_back(problem().action(a));
  return all;
}

std::optional<TaskLogic::Actions> TaskLogic::next() {
  const auto numbers = search_->next();
  if (interruption_) std::rethrow_exception(interruption_);
  if (!numbers) return std::nullopt;
  return actionWords(problem(), *numbers);
}

std::vector<std::vector<Literal>> TaskLogic::statesAlong(const Actions& actions) const {
  return kinegraph::statesAlong(problem(), actionNumbers(problem(), actions));
}

void TaskLogic::exclude(std::vector<ImpossibleAction> proofs) {
  proofs_ = std::move(proofs);
  for (const ImpossibleAction& proof : proofs_) forbid(proof.action, proof.facts);
}

void TaskLogic::forbid(const TaskAction& action, const std::vector<Literal>& facts) {
  search_->forbid(actionNumber(problem(), action), changingFacts(problem(), facts));
}

void TaskLogic::forbidPrefix(const Actions& actions) { search_->forbidBeginning(actionNumbers(problem(), actions)); }

void TaskLogic::startOver() {
  restart(start_);
  exclude(std::move(proofs_));
}

void TaskLogic::allowRegrasps() {
  std::vector<Literal> start = start_;
  for (const std::string& obj : wordsOf(start_, "is_object")) start.push_back({"fresh", {obj}});
  restart(std::move(start));
  exclude(std::move(proofs_));
}

std::string TaskLogic::infeasibility() const {
  if (proofs_.empty() || !PlanSearch(problem()).next()) return contradiction(problem_);
  return neededProofs(problem(), proofs_);
}

}  // namespace kinegraph::inline task_planning_internal
