#pragma once

#include "kinegraph/geometry/distance/closed_form/box_distance.h"

namespace kinegraph::inline geometry_internal {

/// Nearest points of two boxes a and b, exact. The separating axis with the widest gap is the normal if the boxes
/// overlap, or if it meets a face or an edge of each box. Otherwise a corner of one box is a nearest point. Source for
/// the axes: Gottschalk, Lin & Manocha, OBBTree, 1996.
NearestPoints boxToBox(const BoxCore& a, const BoxCore& b);

}  // namespace kinegraph::inline geometry_internal
