#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/dynamic_obstacles/dynamic_check.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline planning_internal {

/// A time scaling along a curve that avoids dynamic obstacles.
struct DynamicTiming {
  /// A stop of the robot.
  struct Wait {
    double begin, seconds;  ///< s
    double place;           ///< path parameter s of the curve
  };
  bool was_found = false;
  bool is_fastest = false;  ///< the fastest time scaling is collision-free
  TimeScaling scaling;
  std::vector<Wait> waits;
  std::optional<DynamicContact> met;  ///< first contact of the fastest time scaling
  std::string message;                ///< why no timing was found
  long tries = 0;                     ///< number of legs that were checked
};

/// Computes a time scaling along a curve whose fastest scaling is known. If the fastest one is collision-free, it
/// stays. At the end the robot stands still, and no obstacle may come there later.
///
/// Otherwise stations along the curve, the stops of the curve among them, allow the robot to wait. A leg is the fastest
/// motion from a station to a later one, or the same motion slowed down. Within one safe interval of a station the
/// earliest arrival is best, so that A* over arrival times visits each station once per safe interval. A leg that
/// collides at one departure is tried at later ones. Sources: Phillips, Likhachev, SIPP: Safe interval path planning
/// for dynamic environments, 2011; Kant, Zucker, Toward efficient trajectory planning: the path-velocity decomposition,
/// 1986.
DynamicTiming timeAmongObstacles(const TimedPath& fastest, const MotionLimits& limits, DynamicCheck& check,
                                 const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline planning_internal
