#pragma once

#include <functional>

#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// Finds the first unseen place of an occupancy map that prevents a motion. `plan_in` plans the same motion in a copy
/// of the scene whose unseen cells are free. None without such cells or such a motion.
std::optional<UnseenPlace> findUnseenPlace(const Config& config, double margin,
                                           const std::function<MotionPlan(const Config&)>& plan_in);

}  // namespace kinegraph::inline planning_internal
