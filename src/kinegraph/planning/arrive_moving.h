#pragma once

#include <optional>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// Bends the end of a motion that planMotion found from rest to rest, so that it ends with options.end_velocity and
/// end_acceleration (zero if empty). Its last line leads to a point before the goal instead, against the end velocity,
/// and cubics with continuous second derivatives round this corner. Run-ups of several lengths are tried,
/// and the fastest motion is returned. It keeps the limits, the margin and the constraints at all times, as the motion
/// does. None if there is no such motion.
std::optional<MotionPlan> arriveMoving(const Config& config, const MotionPlan& at_rest, const PlanOptions& options,
                                       const CancellationToken& cancellation);

}  // namespace kinegraph::inline planning_internal
