#pragma once

#include "kinegraph/task_planning/lgp/default_lgp_abstraction.h"

namespace kinegraph {

/// Adds what an action of DefaultLgpAbstraction asks of waypoints or of a motion. `time` is when it is done, in phases.
/// Throws ValueError for an action that is not known, or has too few words.
void addLgpAction(DefaultLgpAbstraction& tamp, ManipulationHelper& m, double time, const TaskAction& action);

}  // namespace kinegraph
