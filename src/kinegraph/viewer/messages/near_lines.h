#pragma once

#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline viewer_internal {

/// Returns the line of two frames at their poses in `state`. A frame without a shape counts as a point.
NearLine nearLine(const State& state, int a, int b);

/// Returns the lines of all pairs of `config` within `margin`, m; at most the first 500.
std::vector<NearLine> nearLines(const Config& config, double margin);

}  // namespace kinegraph::inline viewer_internal
