#pragma once

#include "kinegraph/parsers/srdf_reader.h"
#include "kinegraph/scene/tree/diagnostics.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// Enters what an SRDF file says into the frames: `contact_exclude`, and the attributes `joint_groups` and
/// `joint_states` of joints. Where it names pairs that do or do not collide, no others are left out: flags of contact of
/// the robot's shapes that are negative become 1. Names that are not there are warnings, and an error if none is.
void applySemantics(const RobotSemantics& semantics, SceneTree& scene, SceneDiagnostics& diagnostics);

}  // namespace kinegraph
