#include "kinegraph/planning/pair_choice.h"

#include <algorithm>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline planning_internal {

Config onlyPairs(const Config& config, const std::vector<std::pair<std::string, std::string>>& pairs, const char* who) {
  Config copy(config);
  SceneTree& scene = *copy.scene();
  std::set<std::pair<int, int>> wanted;
  std::set<int> bodies;
  for (const auto& [a, b] : pairs) {
    const int ids[] = {scene.get(a, who).id, scene.get(b, who).id};
    for (const int id : ids) {
      if (!scene.frames()[std::size_t(id)]->shape)
        throw ValueError(cat(who, ": frame '", scene.frames()[std::size_t(id)]->name, "' has no shape"));
      bodies.insert(id);
    }
    wanted.insert(std::minmax(ids[0], ids[1]));
  }
  for (const auto& frame : scene.frames()) {
    frame->no_contact.clear();
    if (frame->shape) copy.getFrame(frame->id).setContact(bodies.count(frame->id) > 0);
  }
  for (const int a : bodies) {
    for (const int b : bodies)
      if (a < b && !wanted.count({a, b}))
        scene.frames()[std::size_t(a)]->no_contact.push_back(scene.frames()[std::size_t(b)].get());
  }
  scene.structureChanged();
  return copy;
}

Config withoutPairs(const Config& config, const std::vector<std::pair<int, int>>& pairs) {
  Config copy(config);
  SceneTree& scene = *copy.scene();
  for (const auto& [a, b] : pairs)
    scene.frames()[std::size_t(a)]->no_contact.push_back(scene.frames()[std::size_t(b)].get());
  scene.structureChanged();
  return copy;
}

}  // namespace kinegraph::inline planning_internal
