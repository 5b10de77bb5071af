#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What people may not expect about which shapes collide: a sentence of Config::contactWarnings.
struct SceneNote {
  std::string text;
  std::vector<int> frames;  ///< that it is about
  bool ignored = false;     ///< what moves goes through them
  bool operator==(const SceneNote&) const = default;
};

std::vector<SceneNote> sceneNotes(const Config& config);

}  // namespace kinegraph
