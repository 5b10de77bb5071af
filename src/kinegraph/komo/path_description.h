#pragma once

#include "kinegraph/komo/path_problem.h"

namespace kinegraph::inline komo_internal {

/// Returns a name such as "positionDiff of l_gripper, target".
std::string objectiveName(const Objective& objective);

/// Describes a residual of a trajectory optimization problem. The group is the index of the objective.
RowDescription describePathComponent(const Path& path, const PathProblem& problem, int row);

/// Describes an entry of x: the frame of its joint, its slice and unit.
VariableDescription describePathVariable(const Path& path, int variable);

/// Returns the overlapping pairs at the present path if the residual is about collisions.
std::vector<std::string> pathComponentDetails(const Path& path, const PathProblem& problem, int row);

}  // namespace kinegraph::inline komo_internal
