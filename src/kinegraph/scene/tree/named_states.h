#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

// Joint states that have a name, and groups of joints. They stand at the joints' frames, as attributes, so that they
// are copied, saved and deleted with them:
//     joint_groups: [arm hand]                          the groups that the joint belongs to
//     joint_states: { home: .3, arm: { ready: -1 } }    its value in states, and in the states of a group
// SRDF files bring them along.

/// The names of all states, or of those of a group, in the order in which they first appear.
std::vector<std::string> stateNames(const SceneTree& scene, const std::string& group = {});

/// The present q with the values of a state; joints that it does not name keep theirs. Without a group, states of that
/// name of all groups are taken together. Throws NameError for a name that is not there, and ValueError if values do
/// not fit.
VectorXd namedState(SceneTree& scene, const std::string& name, const std::string& group = {});

/// Names of groups, in the order in which they first appear, and of the frames of their joints.
std::vector<std::pair<std::string, std::vector<std::string>>> jointGroups(const SceneTree& scene);

}  // namespace kinegraph
