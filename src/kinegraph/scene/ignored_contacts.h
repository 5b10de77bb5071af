#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Lets the pairs that are nearer than `margin` (m) at the present q never collide from now on, as `contact_exclude` of a
/// scene file does, and returns them with their distances. For models of which parts overlap where they are joined. Of a
/// frame that carries shapes of frames fixed to it, these are meant, too.
inline std::vector<Config::NearPair> ignoreCollisionsNow(Config& config, double margin = 0.) {
  const std::vector<Config::NearPair> pairs = config.getCollisions(margin);
  SceneTree& scene = *config.scene();
  for (const Config::NearPair& pair : pairs)
    scene.frames()[std::size_t(pair.a)]->no_contact.push_back(scene.frames()[std::size_t(pair.b)].get());
  if (!pairs.empty()) scene.structureChanged();
  return pairs;
}

}  // namespace kinegraph
