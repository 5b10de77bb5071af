#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// Copies a scene so that only these pairs of frames may collide, whatever their contact flags are. Throws
/// FrameNotFound, and ValueError for frames without a shape; `who` names the caller.
Config onlyPairs(const Config& config, const std::vector<std::pair<std::string, std::string>>& pairs, const char* who);

/// Copies a scene so that these pairs of frames (ids) do not collide.
Config withoutPairs(const Config& config, const std::vector<std::pair<int, int>>& pairs);

}  // namespace kinegraph::inline planning_internal
