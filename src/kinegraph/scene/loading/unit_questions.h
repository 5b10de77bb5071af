#pragma once

#include <vector>

#include "kinegraph/scene/loading/scene_source.h"
#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph {

/// Warns of numbers in a file that seem to be in other units: joint limits, joint values and rotations in degrees,
/// sizes, meshes and positions in millimeters. `frames` are those that the entries of `source` made.
void askAboutUnits(const SceneSource& source, const std::vector<FrameData*>& frames, SceneDiagnostics& diagnostics);

}  // namespace kinegraph
