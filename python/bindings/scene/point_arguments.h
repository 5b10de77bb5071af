#pragma once

#include <optional>
#include <vector>

#include "bindings.h"
#include "kinegraph/scene/frame_setters.h"

namespace kinegraph::python {

/// Reads n x 3 finite numbers; `what` names them in errors.
std::vector<Vector3d> pointList(const Numbers& numbers, const char* what);

/// Reads the colors of n points, 0..255: 3 or 4 numbers per point, an image with as many pixels, or one color for all.
PointColors colorsOf(const std::optional<Numbers>& numbers, std::size_t n);

}  // namespace kinegraph::python
