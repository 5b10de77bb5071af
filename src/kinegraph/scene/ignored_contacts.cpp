#include "kinegraph/scene/collisions.h"

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

std::vector<Config::NearPair> ignoreCollisionsNow(Config& config, double margin) {
  const std::vector<Config::NearPair> pairs = config.getCollisions(margin);
  SceneTree& scene = *config.scene();
  for (const Config::NearPair& pair : pairs)
    scene.frames()[std::size_t(pair.a)]->no_contact.push_back(scene.frames()[std::size_t(pair.b)].get());
  if (!pairs.empty()) scene.structureChanged();
  return pairs;
}

}  // namespace kinegraph
