#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Returns the pose of an upright camera at `position` that faces `target`: x right, y down, z forward.
Pose lookAt(const Vector3d& position, const Vector3d& target);

}  // namespace kinegraph
