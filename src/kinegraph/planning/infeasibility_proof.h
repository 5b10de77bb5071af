#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/steering/clearance_check.h"

namespace kinegraph::inline planning_internal {

/// Tries to prove that there is no path from the start to a goal. Returns the proof as a sentence, or "" if there is
/// none, which does not mean that there is a path.
///
/// A path moves the core of every moving body from its place at the start to its place at a goal. The core is the
/// largest ball around the body's center inside of it. It is larger if joints rotate the body about one direction of
/// the world only, as on a mobile base: the whole body if it is round about that direction or does not rotate, and the
/// inscribed upright cylinder of a box. A grid covers all places to which the joints can bring the center (interval
/// arithmetic). A cell is closed if, for every center in it, the core comes closer than the margin to one static
/// obstacle. If open cells, connected also at corners, do not connect start and goals, no path exists. The cancellation
/// token ends the search.
std::string proveInfeasible(const State& scene, const VectorXd& start, const std::vector<VectorXd>& goals,
                            double margin, const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline planning_internal
