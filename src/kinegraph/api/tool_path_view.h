#pragma once

#include <vector>

#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/viewer/messages/shown.h"
#include "kinegraph/viewer/programmable_viewer.h"

namespace kinegraph::inline api_internal {

/// Draws the paths of a plan: the curve that is asked (gray), the way of the tool, green at its largest speed, yellow
/// at half of it, red at rest; axes at both ends, the cone of free axes, and the place of a failure with its message.
/// Drawings of earlier calls are replaced.
void drawToolPaths(ProgrammableViewer& viewer, const Config& config, const std::vector<ToolPath>& paths,
                   const ToolPathPlan& plan);

/// Returns the motion of a plan at its times; without a motion, the configurations up to the place of the failure. It
/// plays at once. Empty if there are none.
ShownMotion shownToolPath(const ToolPathPlan& plan, const Config& config);

}  // namespace kinegraph::inline api_internal
