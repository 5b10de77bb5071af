#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

// What scripts of earlier years call, and newer ones write with other methods.

/// Makes active exactly the joints at frames that have one of these attributes, or with `not_those` all others. Throws
/// ValueError for an attribute that no frame with a joint has.
void selectJointsByTag(Config& config, const std::vector<std::string>& attributes, bool not_those = false);

/// Lets objects move freely: the nearest joint at or above each of these frames becomes a free one, where it is; a root
/// is attached to the first frame of the configuration. Throws FrameNotFound, and ValueError for that first frame
/// itself.
void makeObjectsFree(Config& config, const std::vector<std::string>& names);

/// Moves q by the time `tau` (s) under the forces `u` (N m, N), from the velocity `velocity`; returns the velocity
/// then. One step of the classical Runge-Kutta method. `noise` is the deviation of accelerations that are added. Throws
/// ValueError.
VectorXd stepDynamics(Config& config, const VectorXd& velocity, const VectorXd& u, double tau, double noise,
                      bool gravity, Rng& rng);

}  // namespace kinegraph
