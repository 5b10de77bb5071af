#pragma once

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/messages/shown_motion.h"

namespace kinegraph {

/// Uniform within the limits; dofs without limits within .5 of where they are; quaternions of norm one.
VectorXd randomJointState(const Config& config, Rng& rng);

/// The motion through the rows of `path` (T x n), evenly in time. Throws ValueError for another width.
ShownMotion motionAlong(const Config& config, const MatrixXd& path, double seconds);

/// Every dof, from the last to the first, sweeps through its limits and back, in a second; dofs without limits by .5
/// about where they are. Texts name the dof.
ShownMotion jointSweep(const Config& config);

/// A smooth motion that begins and ends at the present q and is drawn towards `points` random joint states within the
/// limits, in points + 1 seconds: a cubic B-spline, which stays in the hull of its control points.
ShownMotion randomSpline(const Config& config, int points, Rng& rng);

}  // namespace kinegraph
