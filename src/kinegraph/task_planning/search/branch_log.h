#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/search/task_failure.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph::inline task_planning_internal {

/// Records the branches that a search tried and counts the causes for which it gave them up. Causes of failures are
/// computed only when the log is read.
class BranchLog {
 public:
  using Actions = std::vector<TaskAction>;

  void addPlan(const Actions& actions) { pending_.push_back({actions, "", nullptr}); }

  /// A branch that the logic proposed, and that was dropped without being tried.
  void addDropped(const Actions& actions, const std::string& cause) { pending_.push_back({actions, cause, nullptr}); }

  /// A branch that was given up; its cause is `condition`, "while (closed drawer): ", and that of the failure. The same
  /// branch with the same cause is recorded once.
  void addGivenUp(const Actions& actions, const std::string& condition, FutureFailure failure);

  void addCause(const std::string& cause);

  const std::vector<TaskBranch>& tree();

  /// Causes and how often each occurred, the most frequent first.
  std::vector<std::pair<std::string, int>> causes();

  /// The most frequent cause.
  std::string mainCause();

 private:
  struct Branch {
    Actions actions;
    std::string condition;
    FutureFailure failure;
    bool is_given_up = false;
  };

  void settle();

  std::vector<Branch> pending_;  ///< branches whose causes are not known yet; they follow those of tree_
  std::vector<TaskBranch> tree_;
  std::vector<std::pair<std::string, int>> causes_;
};

}  // namespace kinegraph::inline task_planning_internal
