#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A camera at `position` that looks at `target` and stands upright: x to the right of the picture, y down, z forward.
Pose lookAt(const Vector3d& position, const Vector3d& target);

}  // namespace kinegraph
