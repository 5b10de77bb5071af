#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Unexpected collision settings of a scene at its current q.
struct ContactWarnings {
  /// Pairs of frames that may collide and overlap by more than 1 mm at a constant relative pose. They are ignored when
  /// a configuration is checked for collisions.
  std::vector<std::pair<int, int>> resting;

  /// Static frames whose shape has neither `contact` nor `simulate`, within 5 cm of a moving shape that collides: the
  /// robot passes through them. Excludes transparent shapes, and shapes drawn around a colliding one that stops the
  /// robot there.
  std::vector<int> passed_through;

  /// Roots of robots (trees with at least two moving links that carry opaque shapes) of which no moving shape collides:
  /// all of their configurations count as free.
  std::vector<int> without_contact = {};
};

ContactWarnings contactWarnings(SceneTree& scene);

/// Describes the warnings: one sentence per nonempty list.
std::vector<std::string> describe(const ContactWarnings& warnings, const SceneTree& scene);

}  // namespace kinegraph::inline scene_internal
