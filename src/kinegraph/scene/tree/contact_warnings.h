#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// What people may not expect about which shapes of a scene collide, at its present q.
struct ContactWarnings {
  /// Pairs of frames that may collide and overlap by more than 1 mm, but no joint moves them apart: they do not count
  /// where it is asked whether a q is free.
  std::vector<std::pair<int, int>> resting;

  /// Frames at rest whose shape has neither `contact` nor `simulate`, within 5 cm of something that moves and collides:
  /// it goes through them. What is drawn around a shape that collides, or is transparent, is not meant.
  std::vector<int> passed_through;
};

ContactWarnings contactWarnings(SceneTree& scene);

/// A sentence for each of the two that there is anything to say about.
std::vector<std::string> describe(const ContactWarnings& notes, const SceneTree& scene);

}  // namespace kinegraph
