#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/loading/scene_source.h"
#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph::inline scene_internal {

/// Asks whether the shape of a frame is in mm; "" without a strong reason. Large shapes alone are none: floors, halls
/// and terrains are large. Reasons: it is a link of an arm, but many times larger than the offsets between the joints;
/// or it can move, but is lighter than air.
std::string askAboutSize(const FrameData& frame);

/// Warns of numbers in a file that seem to be in other units: joint limits, joint values and rotations in degrees,
/// sizes, meshes and positions of links in millimeters. `frames` are those that the entries of `source` made.
void askAboutUnits(const SceneSource& source, const std::vector<FrameData*>& frames, SceneDiagnostics& diagnostics);

}  // namespace kinegraph::inline scene_internal
