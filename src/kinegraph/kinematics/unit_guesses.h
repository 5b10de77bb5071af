#pragma once

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph::inline kinematics_internal {

/// Tells whether q seems to be in degrees: some angle is beyond its limits, or beyond two turns, all are multiples
/// of 0.5 or one is beyond both, and all times pi/180 are within their limits.
bool looksLikeDegrees(const KinematicModel& model, const VectorXd& q);

}  // namespace kinegraph::inline kinematics_internal
