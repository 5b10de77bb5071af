#pragma once

#include <functional>
#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/tool_paths/plan_tool_path.h"

namespace kinegraph::inline tool_paths_internal {

/// Appends the stretches between s = `from` and `to` on which the tool is slower than `speed_of`(s) by more than .5
/// %. Each names the limit that is the nearest one for the longest time. The last dof of `timed` and of `limits` is
/// the tool's way.
void addSlowStretches(const TimedPath& timed, int path, double from, double to, const MotionLimits& limits,
                      const KinematicModel& model, const std::function<double(double)>& speed_of,
                      std::vector<SlowStretch>& slow);

/// The share of the duration in which the tool moves steadily at more than half of `speed_of`(s), but not at it,
/// although all limits have room: the grid of the time scaling is too coarse.
double idleShare(const TimedPath& timed, const MotionLimits& limits, const std::function<double(double)>& speed_of);

}  // namespace kinegraph::inline tool_paths_internal
