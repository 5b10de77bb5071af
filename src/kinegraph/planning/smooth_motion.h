#pragma once

#include <optional>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/steering/steering.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph {

/// A motion as KOMO bends it.
struct SmoothedMotion {
  MatrixXd path;  ///< slices, rows from start to goal
  TimedPath timed;
};

/// Bends a motion so that it accelerates less, among what stands still: `slices` postures of it, in equal times, begin a
/// KOMO whose cost is the acceleration, and that is free at all times with `margin` (m). The cubic spline through its slices
/// is then timed. None if no motion is found that is free on the spline, by the margins of the Steering, keeps the limits
/// of joints, and is faster. Straight motions from row to row of the path are free, too.
/// Source: Toussaint, A tutorial on Newton methods for constrained trajectory optimization, 2017.
std::optional<SmoothedMotion> smoothMotion(const Config& config, Steering& steering, const TimedPath& motion,
                                           const MotionLimits& limits, double margin, int slices,
                                           const CancellationToken& cancellation);

}  // namespace kinegraph
