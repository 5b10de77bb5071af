#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph::inline task_planning_internal {

/// Returns sentences about hands whose frame cannot serve for grasps. It lies inside a colliding shape of the hand, its
/// x axis is not the direction in which the fingers move, or its z axis does not point back into the hand. The axes are
/// known of hands whose fingers are modeled, see handFingersOf. Each sentence says how to mend the frame. Empty if all
/// hands are as expected.
std::vector<std::string> gripperFrameFlaws(const Config& C, const std::vector<std::string>& hands);

}  // namespace kinegraph::inline task_planning_internal
