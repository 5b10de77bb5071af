#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/steering/clearance_check.h"

namespace kinegraph {

/// Whether it can be proven that there is no way, in words; "" if not, which says nothing.
///
/// Of each body that moves, the largest ball around its center that is inside of it has to get from its place at the
/// start to one of those at the goals. Where joints turn a body about one direction of the world alone, as those of a mobile
/// base, more of it is known to be there: all of it if it is round about that direction, the upright cylinder inside of a box
/// if it is not, and all of a convex body that does not turn. A grid covers all places that its joints can bring the center to (interval
/// arithmetic). A cell is closed if the ball, or what else is there, comes nearer than the margin to one obstacle that never
/// moves wherever in the cell its center is. Where no path of open cells, corners included, joins the places, there is no way.
/// The watch may end it.
std::string proveInfeasible(const State& scene, const VectorXd& start, const std::vector<VectorXd>& goals,
                            double margin, const CancellationToken& cancellation = {});

}  // namespace kinegraph
