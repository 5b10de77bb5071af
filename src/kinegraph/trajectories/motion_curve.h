#pragma once

#include "kinegraph/common/cancellation.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline trajectories_internal {

/// Returns the curve along which a motion leads, without its times: that of a TimedPath to the bit; else cubic splines
/// through samples of the motion, at most 1e-6 rad or m from the other samples in every dof. They are 5 ms apart, and
/// at least 1000 and at most 200000. Where the direction jumps, the curve has a corner (`stopsAt`). Rests take no part
/// of the curve. Throws ValueError if there is no motion, or for numbers that are not finite.
PathCurve curveOf(const Trajectory& motion, const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline trajectories_internal
