#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A copy of a scene in which only these pairs of frames may collide, whatever their contact flags say. Throws
/// FrameNotFound, and ValueError for frames without a shape; `who` is what asks.
Config onlyPairs(const Config& config, const std::vector<std::pair<std::string, std::string>>& pairs, const char* who);

/// A copy of a scene in which these pairs of frames (ids) do not collide.
Config withoutPairs(const Config& config, const std::vector<std::pair<int, int>>& pairs);

}  // namespace kinegraph
