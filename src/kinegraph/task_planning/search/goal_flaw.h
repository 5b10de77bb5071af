#pragma once

#include <string>
#include <vector>

#include "kinegraph/logic/grounding.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the reason for which no action of the default domain can make one of the `unreachable` literals of a problem
/// true: the label, joint, shape or part that a frame lacks, and what to do.
std::string goalFlaw(const Config& C, const GroundProblem& ground);

}  // namespace kinegraph::inline task_planning_internal
