#pragma once

#include <set>
#include <vector>

#include "kinegraph/perception/visible_shape.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline perception_internal {

/// The shapes of a frame without the things on it: its children, if it has a shape itself. A robot may be fixed to a
/// table.
VisibleShape placeOf(const Frame& frame);

/// The height of the top of a frame's shapes in the world, m.
double heightOf(const Frame& frame, const VisibleShape& place);

/// The heights at which a thing may rest, m, without repetitions: on the support, whose top is at `height`; on the
/// frame below which the thing hangs in the scene; on level boxes below the support, such as trays, that come
/// within `reach` (m) of the thing; and on what it stood on in its last pose. Only there `things` (ids) are places.
std::vector<double> heightsUnder(const Config& config, const Frame& thing, const VisibleShape& shape,
                                 const Frame& support, double height, double reach, const std::set<int>& things);

/// The one of the heights at which a thing rests in its last pose, m.
double heightOfPlace(const VisibleShape& shape, const RigidTransform& last, const std::vector<double>& heights);

}  // namespace kinegraph::inline perception_internal
