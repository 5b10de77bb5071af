#pragma once

#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

namespace kinegraph::inline task_planning_internal {

/// Adds the constraints of an action of DefaultLgpAbstraction to a waypoint or motion problem. `time` is the end of the
/// action, in phases. Throws ValueError for an unknown action, or one with too few words.
void addLgpAction(DefaultLgpAbstraction& tamp, ManipulationHelper& m, double time, const TaskAction& action);

}  // namespace kinegraph::inline task_planning_internal
