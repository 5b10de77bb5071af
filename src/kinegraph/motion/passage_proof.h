#pragma once

#include <string>
#include <vector>

#include "kinegraph/motion/clearance_check.h"

namespace kinegraph {

/// Whether it can be proven that there is no way, in words; "" if not, which says nothing.
///
/// Of each body that moves, the largest ball around its center that is inside of it has to get from its place at the
/// start to one of those at the goals. A grid covers all places that its joints can bring the center to (interval
/// arithmetic). A cell is closed if each point of it is nearer to an obstacle that never moves than the ball's radius
/// and the margin allow. Where no path of open cells, corners included, joins the places, there is no way.
std::string proveNoWay(const State& scene, const VectorXd& start, const std::vector<VectorXd>& goals, double margin);

}  // namespace kinegraph
