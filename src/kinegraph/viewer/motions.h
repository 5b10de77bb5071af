#pragma once

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/messages/shown_motion.h"

namespace kinegraph {

/// Samples joint values uniformly within the limits, without limits within .5 of the present; quaternions have norm
/// one.
VectorXd randomJointState(const Config& config, Rng& rng);

/// Returns the motion through the rows of `path` (T x n) with equal time steps. Throws ValueError for another width.
ShownMotion motionAlong(const Config& config, const MatrixXd& path, double seconds);

/// Returns a motion that sweeps every dof, from the last to the first, through its limits and back in one second; dofs
/// without limits by .5 around their present value. Texts name the dof.
ShownMotion jointSweep(const Config& config);

/// Returns a smooth motion of points + 1 seconds that starts and ends at the present q: a cubic B-spline whose control
/// points are `points` random joint states. It stays within the limits, because it stays in the hull of its control
/// points.
ShownMotion randomSpline(const Config& config, int points, Rng& rng);

}  // namespace kinegraph
