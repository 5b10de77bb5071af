#pragma once

#include "kinegraph/planning/endpoints.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A posture near a start or goal that touches something, or overlaps it slightly, from where all is free: pairs are
/// pushed apart along their normals. The straight motion between the two is free at all times for all other pairs, and
/// the pairs in contact never overlap more than at the end itself. None if there is no such posture.
std::optional<VectorXd> retreatFromContact(const Config& config, Steering& steering, const Endpoint& end,
                                           double margin);

}  // namespace kinegraph
