#pragma once

#include "kinegraph/geometry/distance/box_distance.h"

namespace kinegraph {

/// Of two boxes a and b. Exact: the separating axis with the widest gap is the normal where the boxes overlap, and
/// where it meets a face, or an edge of each; boxes that are apart otherwise are nearest at a corner of one of them.
/// Source: Gottschalk, Lin & Manocha, OBBTree, 1996, for the axes.
NearestPoints boxToBox(const BoxCore& a, const BoxCore& b);

}  // namespace kinegraph
