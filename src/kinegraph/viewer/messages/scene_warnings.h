#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline viewer_internal {

/// A warning about unexpected collision settings: a sentence of Config::contactWarnings.
struct SceneWarning {
  std::string text;
  std::vector<int> frames;  ///< the frames concerned
  bool ignored = false;     ///< moving shapes pass through these frames
  bool operator==(const SceneWarning&) const = default;
};

std::vector<SceneWarning> sceneWarnings(const Config& config);

}  // namespace kinegraph::inline viewer_internal
