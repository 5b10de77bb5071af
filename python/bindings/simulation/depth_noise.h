#pragma once

#include "kinegraph/rendering/depth_image.h"

namespace kinegraph::python {

/// The noise of depth images that the parameters `DepthNoise/...` ask for. Throws ValueError for one that cannot be.
DepthNoise depthNoise();

}  // namespace kinegraph::python
