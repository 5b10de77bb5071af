#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Excludes all pairs closer than `margin` (m) at the current q from collision, as `contact_exclude` of a scene file
/// does, and returns them with their distances. Useful for models with overlapping parts at their joints. A shape that
/// is fixed to its parent excludes the parent's shapes, too.
inline std::vector<Config::NearPair> ignoreCollisionsNow(Config& config, double margin = 0.) {
  const std::vector<Config::NearPair> pairs = config.getCollisions(margin);
  SceneTree& scene = *config.scene();
  for (const Config::NearPair& pair : pairs)
    scene.frames()[std::size_t(pair.a)]->no_contact.push_back(scene.frames()[std::size_t(pair.b)].get());
  if (!pairs.empty()) scene.structureChanged();
  return pairs;
}

}  // namespace kinegraph
