#include <array>

#include "kinegraph/api/execution/task_execution.h"
#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

std::string taskEventName(TaskEventKind kind) {
  constexpr std::array names = {"start", "motion", "grip", "failure", "repair", "end"};
  return names[std::size_t(kind)];
}

std::string TaskEvent::str() const {
  std::string text = taskEventName(kind);
  if (!message.empty()) return cat(text, ": ", message);
  return action.empty() ? text : cat(text, ": ", planText({action}));
}

std::string TaskExecution::str() const {
  std::string text =
      cat(feasible ? "reached the goal" : "stopped", " after ", done, done == 1 ? " action" : " actions");
  if (repairs > 0) text += cat(" and ", repairs, repairs == 1 ? " repair" : " repairs");
  return feasible ? text : cat(text, ": ", message);
}

}  // namespace kinegraph
