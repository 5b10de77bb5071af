#pragma once

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline viewer_internal {

/// Returns lines between consecutive pairs of vertices, after the ends of one color in each cube of width `cell` (m)
/// have been merged to their mean. Lines without a length and repeated lines are omitted.
Mesh mergedLines(const Mesh& lines, double cell);

}  // namespace kinegraph::inline viewer_internal
