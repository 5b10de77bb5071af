#pragma once

#include "arguments.h"
#include "kinegraph/tool_paths/tool_path.h"

namespace kinegraph::python {

/// A waypoint from a pose (7,) or a position (3,). Throws ValueError, with the name of the call, for another length.
ToolWaypoint waypointOf(const char* call, const VectorXd& numbers);

}  // namespace kinegraph::python
