#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph::inline rendering_internal {

/// Returns the projection of OpenGL, from the world: x and y of the image in -1..1, y up, and the depth in -1..1.
Eigen::Matrix4d projection(const Camera& camera);

/// Converts values of a depth buffer in 0..1 to m along the camera's z; -1 for the background.
void depthToMeters(std::vector<float>& depth, const Camera& camera);

}  // namespace kinegraph::inline rendering_internal
