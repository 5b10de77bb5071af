#pragma once

#include <optional>

#include "kinegraph/rendering/camera.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Is a shape there for collisions and not for the eye? It counts in collisions, and its alpha is at most 0.25. The page
/// has a switch for these; pictures leave them out.
bool servesCollisionsOnly(const Shape& shape);

struct ShownBall {
  Vector3d center;  ///< m, in the world
  double radius;    ///< m
};

/// A ball around all surfaces that pictures show; none if there are none.
std::optional<ShownBall> shownBall(const Config& config);

/// The camera, moved along its line of sight so that all that pictures show just fills the image, with a range that holds
/// it. As it was if there is nothing to see.
Camera fitted(Camera camera, const Config& config);

}  // namespace kinegraph
