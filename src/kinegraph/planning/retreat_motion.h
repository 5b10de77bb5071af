#pragma once

#include "kinegraph/planning/endpoints.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// Finds a collision-free configuration near a start or goal in slight contact, by pushing pairs apart along their
/// normals. On the straight edge between the two, all other pairs stay collision-free, and the pairs in contact never
/// penetrate more than at the endpoint. None if there is no such configuration.
std::optional<VectorXd> retreatFromContact(const Config& config, Steering& steering, const Endpoint& end,
                                           double margin);

}  // namespace kinegraph::inline planning_internal
