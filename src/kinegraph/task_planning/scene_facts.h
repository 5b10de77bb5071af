#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/logic/domain.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Returns the facts of a scene, in the order of its frames:
///
/// - a frame with `logical: { is_gripper, ... }`: a fact per label, `(is_gripper hand)`;
/// - another frame with a joint of type rigid and a shape: `(is_object cup)`, and is_box, is_sphere, is_capsule or
///   is_cylinder by its shape;
/// - among these frames: `(on table cup)` if the first frame with a joint, from cup upwards, is a child of the table,
/// and `(partOf cup handle)` for a frame that hangs below another of them without a joint.
std::vector<Literal> sceneFacts(const Config& C);

/// Returns the states of doors and drawers by name: "opened" (from 80 % of the joint's range on), "closed" (up to 5 %),
/// or "ajar". A door or drawer is a frame labeled is_door or is_drawer with an active joint of one dof with limits; it
/// is closed at the limit that is closer to zero.
std::map<std::string, std::string> doorStates(const Config& C);

}  // namespace kinegraph
