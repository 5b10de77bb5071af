#pragma once

#include <optional>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/steering/steering.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline planning_internal {

/// A motion smoothed by KOMO.
struct SmoothedMotion {
  MatrixXd path;  ///< the slices, from start to goal
  TimedPath timed_path;
};

/// Smooths a motion among static obstacles so that it accelerates less. `slices` configurations at equal times of the
/// motion initialize a KOMO problem, whose cost is the acceleration and whose collision constraints keep `margin` (m)
/// continuously. The result is a timed cubic spline through the slices. It is collision-free, and so are the straight
/// edges between the slices, by the margins of the Steering; it keeps the joint limits and is faster. Else none.
/// Source: Toussaint, A tutorial on Newton methods for constrained trajectory optimization, 2017.
std::optional<SmoothedMotion> smoothMotion(const Config& config, Steering& steering, const TimedPath& motion,
                                           const MotionLimits& limits, double margin, int slices,
                                           const CancellationToken& cancellation);

}  // namespace kinegraph::inline planning_internal
