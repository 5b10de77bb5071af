#pragma once

#include <string>
#include <vector>

#include "kinegraph/task_planning/motions/meant_contacts.h"
#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph::inline task_planning_internal {

/// Tolerances are not computed beyond this, m.
inline constexpr double kMaxTolerance = .03;

/// Tolerance of a robust step, m.
inline constexpr double kRobust = 3e-3;

/// Returns the error of the poses of the robot and of objects that an action survives: the least clearance of the
/// robot, and of what it carries, to all else along the motion; the clearance of the open hand around an object that
/// is taken, also while it approaches; and the distance of the center of mass from the edges of its support for one
/// that is put down. `C`: the scene of the motion, `path`: (T, n).
StepTolerance toleranceOf(const Config& C, const Surroundings& around, const MatrixXd& path, const TaskAction& action,
                          const std::vector<std::string>& hands);

}  // namespace kinegraph::inline task_planning_internal
