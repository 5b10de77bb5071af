#pragma once

#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph::python {

/// Returns the noise of depth images from the parameters `DepthNoise/...`. Throws ValueError for invalid ones.
DepthNoise depthNoise();

}  // namespace kinegraph::python
