#pragma once

#include <vector>

#include "kinegraph/logic/domain.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What a scene says in logic, in the order of its frames:
///
/// - a frame with `logical: { is_gripper, ... }`: each of these words of it, `(is_gripper hand)`;
/// - another frame with a joint of type rigid: `(is_object cup)`, and is_box, is_sphere, is_capsule or is_cylinder by its
///   shape;
/// - of these frames: `(on table cup)` where the first frame with a joint, from cup upwards, hangs below the table, and
///   `(partOf cup handle)` for what hangs at another of them without a joint.
std::vector<Literal> sceneFacts(const Config& C);

}  // namespace kinegraph
