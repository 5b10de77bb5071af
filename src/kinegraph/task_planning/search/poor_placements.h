#pragma once

#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/task_planning/search/task_proofs.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the placements that are excluded as long as other sequences exist.
///
/// - Those that leave no room on a place: the object fits on it as a whole, and so does another one, but not both; or
///   not beside the other one, as it stands there at the start. They are excluded while the other one is there. A goal
///   that wants both there excludes none.
/// - Those onto an object that the goal does not name: an object that makes way is put on the table, not onto another
///   one, which may be narrow and is in the way later. Carriers are exempt.
std::vector<ImpossibleAction> poorPlacements(const Config& C, const std::vector<TaskAction>& actions,
                                             const std::vector<Literal>& start, const std::vector<Literal>& goal);

}  // namespace kinegraph::inline task_planning_internal
