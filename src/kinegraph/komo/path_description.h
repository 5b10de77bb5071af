#pragma once

#include "kinegraph/komo/path_problem.h"

namespace kinegraph {

/// "positionDiff of l_gripper, target"
std::string objectiveName(const Objective& objective);

/// A residual of a motion problem in a person's terms. The group is the objective's index.
RowDescription describePathRow(const Path& path, const PathProblem& problem, int row);

/// An entry of x: the joint's frame, its slice and unit.
VariableDescription describePathVariable(const Path& path, int variable);

/// The pairs of shapes that overlap, where the residual is about collisions, at the present path.
std::vector<std::string> pathRowDetails(const Path& path, const PathProblem& problem, int row);

}  // namespace kinegraph
