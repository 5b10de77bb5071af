#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/kinematics/joint.h"

namespace kinegraph::inline scene_internal {

/// Explains why `limits` are not the limits of a joint with `limits.size() / 2` dofs (all lower, then all upper); "" if
/// they are valid. [-1 1 -1 1] is not: it would fix every dof.
std::string limitsError(std::span<const double> limits);

/// Older files alternate lower and upper limits, [-1 1 -2 2]. Returns such a list in the current order, [-1 -2 1 2], if
/// it is not valid as it is; `warning` then says so.
std::optional<std::vector<double>> limitsInTurn(std::span<const double> limits, std::string& warning);

/// Sets each entry of q whose limits are equal to this value: a locked joint is nowhere else. `limits` are all lower,
/// then all upper ones, or empty. Joints with a quaternion stay as they are. Returns whether q changed.
bool moveToEqualLimits(std::span<const MotionStep> steps, std::span<const double> limits, std::span<double> q);

}  // namespace kinegraph::inline scene_internal
