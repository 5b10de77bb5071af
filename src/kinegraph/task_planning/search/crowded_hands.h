#pragma once

#include "kinegraph/scene/config.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph::inline task_planning_internal {

/// Whether the fingers or the palm of a hand were in the way in some branch of a search that failed.
bool isInTheWay(const Config& C, const TaskPlan& failed);

/// Whether the fingers of a hand pass something that their action does not name with less than the margin, as the
/// warnings of a plan say.
bool isCrowded(const Config& C, const TaskPlan& plan);

}  // namespace kinegraph::inline task_planning_internal
