#pragma once

#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Excludes all pairs closer than `margin` (m) at the current q from collision, as `contact_exclude` of a scene file
/// does, and returns them with their distances. Useful for models with overlapping parts at their joints. A shape that
/// is fixed to its parent excludes the parent's shapes, too.
std::vector<Config::NearPair> ignoreCollisionsNow(Config& config, double margin = 0.);

}  // namespace kinegraph
