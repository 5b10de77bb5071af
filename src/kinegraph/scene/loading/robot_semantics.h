#pragma once

#include "kinegraph/parsers/urdf/srdf_reader.h"
#include "kinegraph/scene/tree/diagnostics.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Applies an SRDF file to the frames: `contact_exclude`, and the attributes `joint_groups` and `joint_states` of
/// joints.
/// If the file lists collision pairs, negative contact flags of the robot's shapes become 1, so no other pairs are
/// excluded. Unknown names cause warnings, and an error if no name is known.
void applySemantics(const RobotSemantics& semantics, SceneTree& scene, SceneDiagnostics& diagnostics);

}  // namespace kinegraph::inline scene_internal
