#pragma once

#include "kinegraph/math/pose.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph::python {

/// Warns of a quaternion w x y z, or a pose x y z qw qx qy qz, that was probably meant otherwise: 0 0 0 1, a pose whose
/// first four numbers are the unit quaternion, and a norm that only an angle in degrees or a length in mm has. Other
/// norms are normalized in silence. The texts are constant, so that Python shows them once.
void warnOfOrder(const VectorXd& numbers);

/// Warns if a joint's dofs do not express the pose that a call asked for: `pose` is what became of it.
void warnOfLostPose(const Frame& frame, const Pose& pose, const Pose& wanted, const char* call);

}  // namespace kinegraph::python
