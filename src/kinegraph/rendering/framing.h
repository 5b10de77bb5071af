#pragma once

#include <optional>

#include "kinegraph/rendering/camera.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

struct ShownBall {
  Vector3d center;  ///< m, in the world
  double radius;    ///< m
};

/// Returns a ball around all visible surfaces, or nothing without any.
std::optional<ShownBall> shownBall(const Config& config);

/// Returns the camera, moved along its line of sight so that the visible scene just fills the image, with a suitable
/// range. Returns it unchanged for an empty scene.
Camera fitted(Camera camera, const Config& config);

}  // namespace kinegraph
