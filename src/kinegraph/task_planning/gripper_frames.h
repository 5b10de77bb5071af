#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Returns sentences about hands whose frame cannot serve for grasps: its x axis is not the direction in which the
/// fingers move (only hands whose fingers are modeled, see handFingersOf), or it lies inside a colliding shape of the
/// hand. Each says how to mend the frame. Empty if all hands are as expected.
std::vector<std::string> gripperFrameFlaws(const Config& C, const std::vector<std::string>& hands);

}  // namespace kinegraph
