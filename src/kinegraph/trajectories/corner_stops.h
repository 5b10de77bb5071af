#pragma once

#include <vector>

#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline trajectories_internal {

/// Returns the corners of a timed path with jerk limits at which a stop takes less time than the blend. A corner is an
/// index of `halves`, the lengths of the path's blends (blendHalves). Both motions are compared between the middles of
/// the adjacent lines, at the speeds that the motion has there.
std::vector<int> cornersWithFasterStops(const TimedPath& timed, const std::vector<double>& halves,
                                        const MotionLimits& limits);

}  // namespace kinegraph::inline trajectories_internal
