#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

// Named joint states and groups of joints. They are attributes of the joints' frames, so they are copied, saved and
// deleted with them:
//     joint_groups: [arm hand]                          groups of the joint
//     joint_states: { home: .3, arm: { ready: -1 } }    its value in states, and in the states of a group
// SRDF files provide them, too.

/// Names of all states, or of those of a group, in order of first appearance.
std::vector<std::string> stateNames(const SceneTree& scene, const std::string& group = {});

/// Returns the current q with the values of a state; joints not named by the state keep theirs. Without a group, merges
/// the states of that name of all groups. Throws NameError for an unknown name, and ValueError for values that do not
/// fit or contradict.
VectorXd namedState(SceneTree& scene, const std::string& name, const std::string& group = {});

/// Names of groups, in order of first appearance, and the names of their joints' frames.
std::vector<std::pair<std::string, std::vector<std::string>>> jointGroups(const SceneTree& scene);

}  // namespace kinegraph::inline scene_internal
