#include "kinegraph/task_planning/search/branch_log.h"

#include <algorithm>

namespace kinegraph::inline task_planning_internal {

void BranchLog::addGivenUp(const Actions& actions, const std::string& condition, FutureFailure failure) {
  failure->begin(Priority::normal);
  pending_.push_back({actions, condition, std::move(failure), true});
}

void BranchLog::addCause(const std::string& cause) {
  const auto known = std::ranges::find(causes_, cause, &std::pair<std::string, int>::first);
  if (known == causes_.end())
    causes_.emplace_back(cause, 1);
  else
    ++known->second;
}

/// Computes the causes of pending branches.
void BranchLog::settle() {
  for (const Branch& branch : std::exchange(pending_, {})) {
    const TaskFailure failure = branch.failure ? branch.failure->get() : TaskFailure();
    const std::string cause = branch.condition + failure.cause;
    const auto is_same = [&](const TaskBranch& b) { return b.actions == branch.actions && b.cause == cause; };
    if (branch.is_given_up) {
      if (std::ranges::any_of(tree_, is_same)) continue;  // it failed before regrasps were allowed, too
      addCause(cause);
    }
    tree_.push_back({branch.actions, cause, failure.configuration});
  }
}

const std::vector<TaskBranch>& BranchLog::tree() {
  settle();
  return tree_;
}

std::vector<std::pair<std::string, int>> BranchLog::causes() {
  settle();
  auto sorted = causes_;
  std::ranges::stable_sort(sorted, std::greater<>(), &std::pair<std::string, int>::second);
  return sorted;
}

std::string BranchLog::mainCause() {
  const auto all = causes();
  return all.empty() ? "nothing was tried" : all[0].first;
}

}  // namespace kinegraph::inline task_planning_internal
