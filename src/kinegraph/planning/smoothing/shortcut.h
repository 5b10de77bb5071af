#pragma once

#include "kinegraph/planning/steering/steering.h"
#include "kinegraph/rrt/shortcutter.h"

namespace kinegraph::inline planning_internal {

/// Shortens a path whose edges are continuously collision-free; so are those of the path that it returns (Shortcutter).
std::vector<VectorXd> shortcutPath(Steering& steering, std::vector<VectorXd> path, const ShortcutOptions& options = {});

}  // namespace kinegraph::inline planning_internal
